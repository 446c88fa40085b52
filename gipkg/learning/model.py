"""Networks on geometry images: trained on one part of a split, kept, and asked about any shape."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from gipkg.errors import DamagedFileError, LearningError
from gipkg.files import write_arrays
from gipkg.formats.arrays import read_arrays
from gipkg.learning.classifier import Classifier, train_classifier
from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.device import choose_device, computes_in_bfloat16, reproducible
from gipkg.learning.feature_maps import feature_map_size, padded_size
from gipkg.learning.network import ImageNetwork
from gipkg.learning.prediction import Prediction
from gipkg.learning.views import Layout, Scale, fit_scale, stack, views_of

WEIGHTS = "weights/"
"""What the names of the network's own arrays begin with in a file."""


@dataclass(frozen=True)
class Model:
    """A trained network with all that it takes to show it geometry images.

    Attributes
    ----------
    classifier : Classifier
    layout : Layout
    scale : Scale
        Of the training part.
    size, channels : int
        It takes images of C channels, n pixels a side, unpadded.
    network : NetworkConfig
    about : mapping
        What else its file says of it: JSON, such as how the images are made.
    """

    classifier: Classifier
    layout: Layout
    scale: Scale
    size: int
    channels: int
    network: NetworkConfig
    about: Mapping[str, Any] = field(default_factory=dict)

    @property
    def classes(self) -> tuple[str, ...]:
        """The k classes it tells apart, sorted."""
        return self.classifier.classes

    def predict(self, images: Mapping[str, NDArray[np.float32]], ids: Sequence[str]) -> Prediction:
        """Predict shapes from their geometry images.

        Parameters
        ----------
        images : mapping of shape id to (V, C, n, n) float32 array
            Any number V of views, unpadded. Read shape by shape.
        ids : sequence of str
            The shapes asked for.

        Returns
        -------
        Prediction
            Scores are the softmax averaged over the views of a shape, embeddings the activations
            of the fully connected layer averaged likewise, of length 1 where the network is
            configured so. What is said of a shape depends on no other one, and is the same bit by
            bit for a model read from its file.

        Raises
        ------
        LearningError
            The images have other channels or another size than those learned from.
        """
        takes = (self.channels, self.size, self.size)

        def prepared(shape_id: str) -> torch.Tensor:
            shown = images[shape_id]
            if shown.shape[1:] != takes:
                raise LearningError(
                    f"{shape_id}: images are {shown.shape[1:]}, the network learned from "
                    f"{takes} (channels, rows, columns): take the same descriptors and size"
                )
            return views_of(shown, self.layout, self.scale)

        found = self.classifier.predict(prepared, ids)
        if not self.network.unit_signatures:
            return found
        lengths = np.linalg.norm(found.embeddings, axis=1, keepdims=True)
        # A signature of zeros, where no feature is active, stays as it is.
        unit = found.embeddings / np.where(lengths > 0, lengths, 1)
        return replace(found, embeddings=unit.astype(np.float32))

    def save(self, path: Path, about: Mapping[str, Any] | None = None) -> None:
        """Write an ``.npz`` without pickles, from which :func:`load_model` reads the model."""
        state = self.classifier.network.state_dict()
        header = {
            "classes": self.classes,
            "size": self.size,
            "channels": self.channels,
            "network": self.network.model_dump(mode="json"),
            "about": dict(self.about if about is None else about),
        }
        arrays = {WEIGHTS + name: tensor.cpu().numpy() for name, tensor in state.items()}
        arrays |= {"mean": self.scale.mean.numpy(), "deviation": self.scale.deviation.numpy()}
        if self.layout.permutation is not None:
            arrays["permutation"] = self.layout.permutation
        write_arrays(path, {"header": np.array(json.dumps(header)), **arrays})


def train_model(
    images: Mapping[str, NDArray[np.float32]],
    labels: Mapping[str, str],
    ids: Sequence[str],
    *,
    network: NetworkConfig | None = None,
    training: TrainingConfig | None = None,
    seed: int = 0,
    device: str = "auto",
    checkpoint: Path | None = None,
) -> Model:
    """Train a network on the geometry images of some shapes.

    Parameters
    ----------
    images : mapping of shape id to (V, C, n, n) float32 array
        The V geometry images of each shape, unpadded. Those of `ids` are read twice, shape by
        shape, and then held in memory in half precision.
    labels : mapping of shape id to class
    ids : sequence of str
        The training part; its order is part of the result. Nothing is read of other shapes.
    network, training : optional
        By default the network and training of today.
    seed : int
        Of the weights, the order of the views, dropout and the shuffled layout.
    device : str
        ``auto``, ``cpu``, ``cuda``, ``cuda:1``, …
    checkpoint : Path, optional
        Where the state of the training is kept. A killed training goes on from there and ends
        equal to an undisturbed one; a finished one is not repeated.

    Raises
    ------
    LearningError
        The images are too small for the network, there are fewer of a shape than it pools, the
        device is absent, or the training diverged.
    DamagedFileError
        The checkpoint cannot be read.
    """
    network, training = network or NetworkConfig(), training or TrainingConfig()
    size = images[ids[0]].shape[-1]
    feature_map_size(network, padded_size(network, size))  # before anything is laid out
    layout = Layout(network.margin, permutation(size, seed) if training.shuffle_pixels else None)
    chosen = choose_device(device)
    # As the network computes, so that no step has to convert them.
    half = computes_in_bfloat16(chosen, training.precision)
    precision = torch.bfloat16 if half else torch.float16
    with reproducible(chosen, training.threads):
        scale = fit_scale(images, ids, layout, jointly=training.scaling == "joint")
        views = stack(images, ids, layout, scale, precision)
    *_, padded, channels = views.shape
    classifier = train_classifier(
        lambda classes: ImageNetwork(network, channels, padded, classes),
        views,
        [labels[i] for i in ids],
        training=training,
        seed=seed,
        device=device,
        checkpoint=checkpoint,
    )
    return Model(classifier, layout, scale, size, channels, network)


def permutation(size: int, seed: int) -> NDArray[np.int64]:
    """Return the one random order of the pixels of all images of a shuffled layout."""
    return np.random.default_rng(seed).permutation(size**2)


def load_model(path: Path, device: str = "auto") -> Model:
    """Read a model from a file that :meth:`Model.save` wrote; nothing in it is executed.

    Raises
    ------
    DamagedFileError
        The file is not a whole model.
    LearningError
        The device is absent.
    """
    chosen = choose_device(device)
    try:
        arrays = read_arrays(path)
        header = json.loads(str(arrays["header"]))
        config = NetworkConfig.model_validate(header["network"])
        size, channels = header["size"], header["channels"]
        classes = tuple(header["classes"])
        weights = {
            name.removeprefix(WEIGHTS): torch.from_numpy(array)
            for name, array in arrays.items()
            if name.startswith(WEIGHTS)
        }
        shape = channels, padded_size(config, size), len(classes)
        with torch.device("meta"):  # takes no memory, until the weights are known to be as many
            ImageNetwork(config, *shape).load_state_dict(weights, assign=True)
        network = ImageNetwork(config, *shape)
        network.load_state_dict(weights)
        layout = Layout(config.margin, arrays.get("permutation"))
        scale = Scale(*(torch.from_numpy(arrays[name]) for name in ("mean", "deviation")))
        about = header["about"]
    # Of the file, json and pydantic (a ValueError), and of torch in turn.
    except (ValueError, KeyError, TypeError, RuntimeError, LearningError) as error:
        raise DamagedFileError(f"{path}: not a whole trained network; train it again") from error
    classifier = Classifier(network.to(chosen), classes)
    return Model(classifier, layout, scale, size, channels, config, about)
