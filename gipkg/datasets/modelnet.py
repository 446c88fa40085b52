"""ModelNet10 and ModelNet40: CAD models as polygon soups, from the official archive or folder."""

from __future__ import annotations

import re
import zlib
from abc import abstractmethod
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, cast

import numpy as np
from pydantic import Field

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.api.dataset import Axis, Part
from gipkg.datasets.downloads import fetch_archive, require_intact
from gipkg.datasets.zip_archives import read_zip_member, zip_names
from gipkg.errors import DamagedFileError, DatasetNotFound
from gipkg.formats.mesh_reading import parse_mesh

if TYPE_CHECKING:
    import trimesh

LICENCE = "academic use; the models keep their own copyrights"
PARTS: tuple[Part, ...] = ("train", "test")
_MODEL = re.compile(
    r"ModelNet[14]0/(?P<label>[a-z_]+)/(?P<part>train|test)/(?P<id>(?P=label)_\d{4})\.off"
)


class ModelNet(Dataset):
    """What all forms of ModelNet share: the official split, an upright axis, a choice of shapes."""

    citation: ClassVar[str] = (
        "Z. Wu, S. Song, A. Khosla, F. Yu, L. Zhang, X. Tang, J. Xiao, 3D ShapeNets: A Deep "
        "Representation for Volumetric Shapes, CVPR 2015"
    )

    max_train: int | None = Field(
        None, ge=1, description="Most training shapes of a class; all if it is not given."
    )
    max_test: int | None = Field(
        None, ge=1, description="Most test shapes of a class; all if it is not given."
    )
    seed: int = Field(0, ge=0, description="Seed of the choice where there are more.")

    @property
    def upright(self) -> Axis:
        """The z axis; shapes may stand at any azimuth."""
        return "z"

    @abstractmethod
    def _listing(self, root: Path) -> Iterable[Shape]:
        """List the whole database."""

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All shapes, or the chosen ones; the parts are those of the official split."""
        groups: dict[tuple[str, Part | None], list[Shape]] = defaultdict(list)
        for shape in sorted(self._listing(root), key=lambda shape: shape.id):
            groups[shape.label, shape.part].append(shape)
        chosen = []
        for (label, part), shapes in groups.items():
            rng = np.random.default_rng([self.seed, zlib.crc32(f"{label} {part}".encode())])
            most = self.max_train if part == "train" else self.max_test
            chosen += [shapes[number] for number in rng.permutation(len(shapes))[:most]]
        return tuple(sorted(chosen, key=lambda shape: shape.id))


class ModelNetMeshes(ModelNet):
    """Models as in the official archive, or in the folder that it holds.

    Their names are ``<archive>/<class>/<train or test>/<class>_<number>.off``; an identifier is
    the name of the file, such as ``night_stand_0201``. A folder has to be whole: some models of
    a database are not the database.
    """

    archive: ClassVar[str]
    """Path of the zip archive under the data root; the folder lies beside it."""
    sources: ClassVar[tuple[str, ...]]
    sizes: ClassVar[Mapping[Part, int]]
    """Models in each part of the official split."""

    def available(self, root: Path) -> bool:
        """Whether the archive or the folder is there and lists all models.

        The checksum of the archive is verified when it is fetched and when its shapes are
        listed; that of a model, when it is read from the archive.
        """
        try:
            return self._is_whole(self._models(root))
        except DamagedFileError:  # An archive that cannot be listed is to be fetched again.
            return False

    def fetch(self, root: Path) -> None:
        """Download the archive, unless it or its folder is there."""
        if not self.available(root):
            fetch_archive(root / self.archive, self.tags.files[self.archive], self.sources)

    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh:
        """Read one model as it stands in its file: a polygon soup.

        Raises
        ------
        DatasetNotFound
            No shape has that identifier.
        MeshFormatError
            The file is no triangle mesh.
        DamagedFileError
            The archive is damaged.
        """
        path = root / self.archive
        for part in PARTS:
            name = f"{path.stem}/{shape_id.rpartition('_')[0]}/{part}/{shape_id}.off"
            content = self._read(root, name) if _MODEL.fullmatch(name) else None
            if content is not None:
                return parse_mesh(content, path.parent / name)
        self._require_intact(root)  # a damaged archive may have lost the shape's name
        raise DatasetNotFound(f"{path.stem} has no shape {shape_id!r}; it has such as chair_0001")

    def _listing(self, root: Path) -> list[Shape]:
        self._require_intact(root)
        path = root / self.archive
        models = self._models(root)
        if not self._is_whole(models):
            raise DatasetNotFound(
                f"{path.stem} has {' + '.join(map(str, self.sizes.values()))} models to train and "
                f"test, and {len(models)} are in {path.parent}; put {path.name} or its whole "
                f"folder {path.stem} there"
            )
        return models

    def _require_intact(self, root: Path) -> None:
        """Refuse an archive with another checksum; a folder has none."""
        path = root / self.archive
        if path.is_file():
            require_intact(path, self.tags.files[self.archive])

    def _models(self, root: Path) -> list[Shape]:
        """List what is there, which need not be everything."""
        path = root / self.archive
        folder = path.with_suffix("")
        if path.is_file():
            names: Iterable[str] = zip_names(path)
        else:
            files = folder.glob("*/*/*.off")
            names = (file.relative_to(folder.parent).as_posix() for file in files)
        found = filter(None, map(_MODEL.fullmatch, names))
        return [Shape(one["id"], one["label"], cast(Part, one["part"])) for one in found]

    def _is_whole(self, models: Iterable[Shape]) -> bool:
        return Counter(model.part for model in models) == self.sizes

    def _read(self, root: Path, name: str) -> bytes | None:
        path = root / self.archive
        try:
            if path.is_file():
                return read_zip_member(path, name)
            return (path.parent / name).read_bytes()
        except (KeyError, FileNotFoundError):
            return None


class ModelNet10(ModelNetMeshes):
    """Ten classes of furniture, aligned by hand: 3,991 models to train and 908 to test."""

    summary: ClassVar[str] = "ModelNet10: 10 classes, 4,899 upright and aligned CAD models"
    archive: ClassVar[str] = "modelnet10/ModelNet10.zip"
    sources: ClassVar[tuple[str, ...]] = (
        "http://3dvision.princeton.edu/projects/2014/3DShapeNets/ModelNet10.zip",
    )
    sizes: ClassVar[Mapping[Part, int]] = {"train": 3991, "test": 908}
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=4899,
        classes=10,
        licence=LICENCE,
        source=sources[0],
        files={archive: "9d8679435fc07d1d26f13009878db164a7aa8ea5e7ea3c8880e42794b7307d51"},
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"ModelNet10": Protocol("official")}


class ModelNet40(ModelNetMeshes):
    """Forty classes, upright and at any azimuth: 9,843 models to train and 2,468 to test."""

    summary: ClassVar[str] = "ModelNet40: 40 classes, 12,311 upright CAD models"
    archive: ClassVar[str] = "modelnet40/ModelNet40.zip"
    sources: ClassVar[tuple[str, ...]] = ("http://modelnet.cs.princeton.edu/ModelNet40.zip",)
    sizes: ClassVar[Mapping[Part, int]] = {"train": 9843, "test": 2468}
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=12311,
        classes=40,
        licence=LICENCE,
        source=sources[0],
        files={archive: "42dc3e656932e387f554e25a4eb2cc0e1a1bd3ab54606e2a9eae444c60e536ac"},
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"ModelNet40": Protocol("official")}
