"""The McGill 3D shape benchmark: solids as volumes of 128³ voxels, and what takes part."""

from __future__ import annotations

import gzip
import struct
import zlib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path, PurePosixPath
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gipkg.api import Dataset, DatasetTags, Protocol, Shape, Volume
from gipkg.datasets.downloads import is_intact
from gipkg.datasets.tar_archives import read_tar_members
from gipkg.errors import DatasetNotFound, MeshFormatError

ARCHIVE = "mcgill/mcgill_im.tar.gz"
SHA256 = "c9d321a3b804ab10f2097c839faf096f77653ffde6aaf34551e28b5a4ab9376c"
HOME = "http://www.cim.mcgill.ca/~shape/benchMark/"
COPY = "https://github.com/ninek190/project_mapper_tap/tree/f1929b2"

ARTICULATED = (
    "ants",
    "crabs",
    "hands",
    "humans",
    "octopuses",
    "pliers",
    "snakes",
    "spectacles",
    "spiders",
    "teddy",
)
MIXED = (
    "ants",
    "crabs",
    "hands",
    "octopuses",
    "spectacles",
    "airplanes",
    "chairs",
    "fishes",
    "four",
    "tables",
)
"""Five articulated classes and five others."""

PER_CLASS = 20
"""Shapes that take part of each of ten classes, as in the paper."""

DUPLICATES: Mapping[str, str] = MappingProxyType(
    {
        "birds-b18": "birds-b12",
        "birds-b20": "birds-b15",
        "dolphins-b4": "dolphins-b3",
        "four-b7": "four-b3",
        "tables-b14": "tables-14",
    }
)
"""Left out -> kept: the same voxel by voxel."""

SUFFIX = ".im.gz"
HEADER = 1024
VOXELS: Mapping[int, np.dtype[Any]] = MappingProxyType({1: np.dtype("u1"), 4: np.dtype("<f4")})
"""Number of a type in the header -> how a voxel is stored."""


class McGill(Dataset):
    """All 19 classes of the benchmark, 452 distinct volumes.

    Members of the archive are ``{articulated,non-articulated}/<class>/<name>.im.gz``; an
    identifier is class and name, such as ``ants-b13``. Duplicates are left out. The paper takes
    20 shapes of each of ten classes and names none of them: here they are a mix of articulated
    classes and others, and a second time the articulated ones alone.
    """

    summary: ClassVar[str] = "McGill benchmark: 452 volumes in 19 classes, articulated and not"
    citation: ClassVar[str] = (
        "K. Siddiqi, J. Zhang, D. Macrini, A. Shokoufandeh, S. Bouix, S. Dickinson, Retrieving "
        "Articulated 3-D Models Using Medial Surfaces, Machine Vision and Applications 19(4) 2008"
    )
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=452,
        classes=19,
        licence="none stated",
        source=HOME,
        files={ARCHIVE: SHA256},
        excluded={one: f"the same as {other}" for one, other in DUPLICATES.items()},
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {
        "McGill1": Protocol(10, MIXED, PER_CLASS),
        "McGill2": Protocol(16, MIXED, PER_CLASS),
        "McGillArticulated1": Protocol(10, ARTICULATED, PER_CLASS),
        "McGillArticulated2": Protocol(16, ARTICULATED, PER_CLASS),
        "McGill19": Protocol(0.5),
    }

    def available(self, root: Path) -> bool:
        """Whether the archive lies under the data root, with the right checksum."""
        return is_intact(root / ARCHIVE, SHA256)

    def fetch(self, root: Path) -> None:
        """Say where the volumes are published; no address has the archive itself.

        Raises
        ------
        DatasetNotFound
            The archive is not there.
        """
        path = root / ARCHIVE
        if not is_intact(path, SHA256):
            raise DatasetNotFound(
                f"{path.name} cannot be downloaded as one file. Its volumes are at {HOME}, whose "
                f"authors ask for a mail first, and at {COPY}; put the archive of them with the "
                f"SHA-256 {SHA256} in {path.parent}"
            )

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All distinct shapes; the class is the name of the folder."""
        distinct = sorted(_members(root).keys() - DUPLICATES.keys())
        return tuple(Shape(shape_id, shape_id.partition("-")[0]) for shape_id in distinct)

    def load(self, root: Path, shape_id: str) -> Volume:
        """Read one volume, 1 inside and 0 outside.

        Raises
        ------
        DatasetNotFound
            No shape has that identifier, or the archive is missing.
        DamagedFileError
            The archive is not the one that was published.
        MeshFormatError
            The archive's member is no volume.
        """
        member = _members(root).get(shape_id)
        if member is None or shape_id in DUPLICATES:
            raise DatasetNotFound(f"McGill has no shape {shape_id!r}; it has such as ants-b1")
        content = read_tar_members(root / ARCHIVE, SHA256, SUFFIX)[member]
        try:
            return Volume(_read_voxels(gzip.decompress(content)))
        except (OSError, EOFError, zlib.error, struct.error, ValueError, KeyError) as error:
            raise MeshFormatError(root / ARCHIVE / member, f"not a volume ({error!r})") from error


def _members(root: Path) -> Mapping[str, str]:
    """Find the archive's member of every identifier."""
    return _by_id(tuple(read_tar_members(root / ARCHIVE, SHA256, SUFFIX)))


@lru_cache(maxsize=2)
def _by_id(members: tuple[str, ...]) -> Mapping[str, str]:
    paths = {PurePosixPath(name.removesuffix(SUFFIX)): name for name in members}
    return {f"{path.parent.name}-{path.name}": name for path, name in paths.items()}


def _read_voxels(content: bytes) -> NDArray[np.uint8]:
    """Read a volume in KUIM's format: a header of 1024 bytes, then the voxels, x fastest.

    Byte 4 of the header is the type of the voxels, bytes 6 to 11 are the three dimensions.
    """
    kind, x, y, z = struct.unpack_from("<Bx3h", content, 4)
    voxels = np.frombuffer(content, VOXELS[kind], offset=HEADER)
    return (voxels.reshape((x, y, z), order="F") > 0).astype(np.uint8)
