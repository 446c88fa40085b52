"""ModelNet10 as solid grids of 30³ voxels: what was made of the models, not the models."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api import DatasetTags, Protocol, Shape, Volume
from gipkg.api.dataset import Part
from gipkg.datasets.downloads import is_intact, require_intact
from gipkg.datasets.modelnet import LICENCE, PARTS, ModelNet
from gipkg.errors import DatasetNotFound

ARCHIVE = "modelnet10/modelnet10_voxel30.npz"
SHA256 = "85fb9d01bbaa1913cde8cd385557b31e05cb179585c572298151f54f1e1373fb"
HOME = "http://aguo.us/writings/classify-modelnet.html"
LABELS = (
    "bathtub",
    "bed",
    "chair",
    "desk",
    "dresser",
    "monitor",
    "night_stand",
    "sofa",
    "table",
    "toilet",
)
"""Class of each number in the files."""

EMPTY = (
    "bathtub-train-0006",
    "bathtub-train-0015",
    "bathtub-train-0021",
    "bathtub-train-0024",
    "bathtub-train-0060",
    "table-train-3392",
    "toilet-train-3857",
    "desk-test-0304",
)
"""Left out: the model's name stands over a grid without a single voxel."""

GRID = (30, 30, 30)
VOXELS = 30**3
AT_ONCE = 64
"""Grids unpacked together: in the file a voxel takes 4 bytes, and all of them half a gigabyte."""


class ModelNet10Voxels(ModelNet):
    """ModelNet10 as solid grids of 30³ voxels, the last axis upright.

    Results on them are voxel-derived: thin parts of the models are one voxel thick or gone. An
    identifier is the class, the part and the number of the grid in that part's array, such as
    ``chair-test-0150``.
    """

    summary: ClassVar[str] = "ModelNet10 voxel-derived: 4,891 solid grids of 30³, not the meshes"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=4891,
        classes=10,
        licence=LICENCE,
        source=HOME,
        files={ARCHIVE: SHA256},
        excluded=dict.fromkeys(EMPTY, "an empty grid"),
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"ModelNet10Voxels": Protocol("official")}

    def available(self, root: Path) -> bool:
        """Whether the file lies under the data root, with the right checksum."""
        return is_intact(root / ARCHIVE, SHA256)

    def fetch(self, root: Path) -> None:
        """Say where the grids were published; no address has the file itself.

        Raises
        ------
        DatasetNotFound
            The file is not there.
        """
        path = root / ARCHIVE
        if not self.available(root):
            raise DatasetNotFound(
                f"{path.name} cannot be downloaded. The grids are described at {HOME}; put the "
                f"file with the SHA-256 {SHA256} in {path.parent}"
            )

    def load(self, root: Path, shape_id: str) -> Volume:
        """Read one grid, 1 inside and 0 outside; all are unpacked once a process.

        Raises
        ------
        DatasetNotFound
            No shape has that identifier, or the file is missing.
        DamagedFileError
            The file is not the one that was published.
        """
        path = _verified(root)
        if shape_id not in _places(path):
            raise DatasetNotFound(f"no grid is named {shape_id!r}; one is {max(_places(path))}")
        part, number = _places(path)[shape_id]
        grid = np.unpackbits(_packed_grids(path, f"X_{part}.npy")[number], count=VOXELS)
        return Volume(grid.reshape(GRID))

    def _listing(self, root: Path) -> list[Shape]:
        places = _places(_verified(root))
        return [Shape(one, one.split("-")[0], part) for one, (part, _) in places.items()]


def _verified(root: Path) -> Path:
    path = root / ARCHIVE
    require_intact(path, SHA256)
    return path


@lru_cache(maxsize=1)
def _places(path: Path) -> Mapping[str, tuple[Part, int]]:
    """Find the array and the number in it of every grid that is not empty."""
    with np.load(path, allow_pickle=False) as arrays:
        labels = {part: arrays[f"y_{part}"].tolist() for part in PARTS}
    places = {
        f"{LABELS[label]}-{part}-{number:04d}": (part, number)
        for part in PARTS
        for number, label in enumerate(labels[part])
    }
    return MappingProxyType({one: place for one, place in places.items() if one not in EMPTY})


@lru_cache(maxsize=2)
def _packed_grids(path: Path, member: str) -> NDArray[np.uint8]:
    """Read an array of N grids as (N, 3375) bytes, a bit a voxel."""
    with zipfile.ZipFile(path) as archive, archive.open(member) as stream:
        np.lib.format.read_magic(stream)
        (count, *_), _, dtype = np.lib.format.read_array_header_1_0(stream)
        chunks = []
        for start in range(0, count, AT_ONCE):
            grids = min(AT_ONCE, count - start)
            content = stream.read(grids * VOXELS * dtype.itemsize)
            chunks.append(np.packbits(np.frombuffer(content, dtype).reshape(grids, -1) > 0, axis=1))
    return np.concatenate(chunks)
