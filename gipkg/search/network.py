"""A trained network, from a mesh to its signature."""

from __future__ import annotations

import tempfile
from collections.abc import Collection
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.errors import DamagedFileError
from gipkg.fingerprints import fingerprint_module
from gipkg.learning.model import Model, load_model
from gipkg.search.recipe import ImageMaker, Recipe
from gipkg.shards import content_key


@dataclass(frozen=True)
class Signature:
    """What a network makes of a shape.

    Attributes
    ----------
    embedding : (d,) float32 array
        Activations of the fully connected layer, mean of all cuts; near for similar shapes.
    label : str
        The class that the network takes it for, of those it has learned.
    """

    embedding: NDArray[np.float32]
    label: str


@dataclass(frozen=True)
class SignatureNetwork:
    """A trained network and the maker of the images that it is shown.

    Attributes
    ----------
    content : bytes
        Of the file that the workflow wrote.
    key : str
        Of all that a signature depends on but the mesh: network, recipe and code.
    """

    content: bytes
    key: str
    model: Model
    maker: ImageMaker

    @classmethod
    def read(
        cls, path: Path, allowed: Collection[str] = (), device: str = "cpu"
    ) -> SignatureNetwork:
        """Read a network that rule ``learn`` kept.

        Parameters
        ----------
        path : Path
            ``results/learning/…/….model.npz``.
        allowed : collection of str
            Plugins in files that may be loaded; see :meth:`ImageMaker.of`.
        device : str

        Raises
        ------
        DamagedFileError
            It is no network of ours, or does not say how its images are made.
        LearningError
            The device is absent.
        PluginError
            Its images need a plugin that is not there or not allowed.
        """
        content = path.read_bytes()
        model = load_model(path, device)
        maker = ImageMaker.of(Recipe.of(model.about, path), allowed)
        code = [fingerprint_module("gipkg.search.network"), *maker.code()]
        key = content_key({"network": sha256(content).hexdigest(), "code": code})
        return cls(content, key, model, maker)

    @classmethod
    def of(cls, content: bytes, allowed: Collection[str] = ()) -> SignatureNetwork:
        """Make a network of the bytes of its file, as an index holds them.

        Raises
        ------
        DamagedFileError
            This version of gipkg does not read them.
        PluginError
            Its images need a plugin that is not there or not allowed.
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "network.npz"
            path.write_bytes(content)
            try:
                return cls.read(path, allowed)
            except DamagedFileError as error:
                raise DamagedFileError(
                    "the network in the index is none that this version of gipkg reads; train it "
                    "again and make the index anew: gipkg index FOLDER --network "
                    "results/learning/.../*.model.npz --force"
                ) from error

    def signature(self, source: trimesh.Trimesh | Path) -> Signature:
        """Show a mesh to the network.

        Raises
        ------
        MeshFormatError, UnsupportedMesh, ParametrizationError
            As the stages do.
        """
        said = self.model.predict({"it": self.maker.images(source)}, ["it"])
        return Signature(said.embeddings[0], said.classes[int(said.scores[0].argmax())])
