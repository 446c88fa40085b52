"""SHREC'11 non-rigid watertight, in the simplified version used since MeshCNN."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, ClassVar

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.datasets.downloads import fetch_archive, is_intact
from gipkg.datasets.tar_archives import read_tar_members
from gipkg.errors import DatasetNotFound
from gipkg.formats.mesh_reading import parse_mesh

if TYPE_CHECKING:
    import trimesh

ARCHIVE = "shrec11/shrec_16.tar.gz"
SHA256 = "fed18e701e1d3b4e7882b6eaca8640421e23e3ef9443fa6058dfaf9d704f18ae"
SOURCES = (
    "https://www.dropbox.com/s/w16st84r6wc57u7/shrec_16.tar.gz?dl=1",
    "https://raw.githubusercontent.com/mtembel/geo/52b25e3e36a52783ec5a372af01bfc37b8ca37f6/shrec_16.tar.gz",
)


class Shrec11(Dataset):
    """30 classes of 20 articulated shapes, simplified to 500 faces.

    Members of the archive are ``shrec_16/<class>/<train or test>/T<number>.obj``. The
    folders' fixed split is not used: both parts belong to the database, and an identifier
    is the contest's own, ``T0`` to ``T599``.
    """

    summary: ClassVar[str] = "SHREC'11 non-rigid: 30 classes x 20, simplified to 500 faces"
    citation: ClassVar[str] = (
        "Z. Lian et al., SHREC '11 Track: Shape Retrieval on Non-rigid 3D Watertight Meshes, "
        "Eurographics Workshop on 3D Object Retrieval 2011; simplified meshes: R. Hanocka, "
        "A. Hertz, N. Fish, R. Giryes, S. Fleishman, D. Cohen-Or, MeshCNN: A Network with an "
        "Edge, ACM Transactions on Graphics 38(4) 2019"
    )
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=600,
        classes=30,
        licence="none stated",
        source=SOURCES[0],
        files={ARCHIVE: SHA256},
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"SHREC1": Protocol(10), "SHREC2": Protocol(16)}

    def available(self, root: Path) -> bool:
        """Whether the archive lies under the data root, with the right checksum."""
        return is_intact(root / ARCHIVE, SHA256)

    def fetch(self, root: Path) -> None:
        """Download the archive into ``<root>/shrec11``, from the authors or from a copy."""
        fetch_archive(root / ARCHIVE, SHA256, SOURCES)

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All 600 shapes; the class is the name of the folder."""
        members = sorted(self._members(root).items())
        return tuple(Shape(id=shape_id, label=member.parts[1]) for shape_id, member in members)

    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh:
        """Read one shape, with the vertices and faces of the file in its order.

        Raises
        ------
        DatasetNotFound
            No shape has that identifier, or the archive is missing.
        DamagedFileError
            The archive is not the one that was published.
        MeshFormatError
            The archive's member is no triangle mesh.
        """
        member = self._members(root).get(shape_id)
        if member is None:
            raise DatasetNotFound(f"shrec11 has no shape {shape_id!r}; it has T0 to T599")
        content = read_tar_members(root / ARCHIVE, SHA256, ".obj")[str(member)]
        return parse_mesh(content, root / ARCHIVE / member)

    @staticmethod
    def _members(root: Path) -> dict[str, PurePosixPath]:
        """Find the archive's member of every identifier."""
        names = map(PurePosixPath, read_tar_members(root / ARCHIVE, SHA256, ".obj"))
        return {name.stem: name for name in names}
