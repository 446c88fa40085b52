"""TOSCA, non-rigid shapes in many poses: the low-resolution set and the high-resolution one."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.datasets.downloads import is_intact
from gipkg.datasets.tar_archives import read_tar_members
from gipkg.errors import DatasetNotFound, MeshFormatError, did_you_mean

if TYPE_CHECKING:
    import trimesh

CITATION = (
    "A. M. Bronstein, M. M. Bronstein, R. Kimmel, Numerical Geometry of Non-Rigid Shapes, "
    "Springer 2008"
)
LICENCE = "academic use; cite the book"
PACK = "tar --format=gnu --sort=name --owner=root:0 --group=root:0 --mtime=2026-01-01T00:00:00Z"
"""How single files become the archive with the checksum below, bit by bit (GNU tar)."""
CLASSES = ("cat", "centaur", "david", "dog", "gorilla", "horse", "michael", "victoria", "wolf")
"""The classes that both sets have."""


class Tosca(Dataset):
    """148 shapes of about 3,400 vertices: the ones that the paper's Figure 7 counts.

    Members of the archive are ``<class><number>.mat``, each with the struct ``surface`` of
    coordinates ``X``, ``Y``, ``Z`` and triangles ``TRIV`` that count from 1. An identifier is the
    name of the file, such as ``cat0``. Only 22 shapes are closed and manifold; lionesses and
    gorillas are badly broken. There is no protocol: the shapes are not classified, but mapped.
    """

    summary: ClassVar[str] = "TOSCA non-rigid world: 148 low-resolution shapes in 12 classes"
    citation: ClassVar[str] = CITATION
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=148,
        classes=12,
        licence=LICENCE,
        source="https://github.com/solevillar/GHMatch/tree/dbadc03/nonrigid3d",
        files={
            "tosca/nonrigid3d_mat.tar.gz": (
                "545e5856ad82f95f8af8769c7a04b2d78e8edc3e4cba520a4fcfbbcee6291196"
            )
        },
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {}
    names: ClassVar[tuple[str, ...]] = (*CLASSES, "lioness", "seahorse", "shark")
    packing: ClassVar[str] = (
        f"{PACK} --mode=u=rwX,go=rX -cf - nonrigid3d/*.mat README_TOSCA_licence.txt | gzip -n"
    )

    classes: tuple[str, ...] = Field((), description="Only these classes; all if none is named.")

    @field_validator("classes")
    @classmethod
    def _classes_exist(cls, classes: tuple[str, ...]) -> tuple[str, ...]:
        for name in classes:
            if name not in cls.names:
                hint = did_you_mean(name, cls.names)
                raise ValueError(f"no class is named {name!r}{hint} ({', '.join(cls.names)})")
        return classes

    def available(self, root: Path) -> bool:
        """Whether the archive lies under the data root, with the right checksum."""
        path, sha256 = self._archive(root)
        return is_intact(path, sha256)

    def fetch(self, root: Path) -> None:
        """Say where the shapes are published, one by one; no address has the archive itself.

        Raises
        ------
        DatasetNotFound
            The archive is not there.
        """
        path, sha256 = self._archive(root)
        if not is_intact(path, sha256):
            raise DatasetNotFound(
                f"{path.name} cannot be downloaded as one file. Its shapes are at "
                f"{self.tags.source}. Packed by\n  {self.packing} > {path.name}\nthey give the "
                f"SHA-256 {sha256}; put the archive in {path.parent}"
            )

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """All shapes of the chosen classes; the class is the name without its number."""
        wanted = self.classes or self.names
        found = (Shape(name, name.rstrip("0123456789")) for name in sorted(self._members(root)))
        return tuple(shape for shape in found if shape.label in wanted)

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
        import trimesh

        content = self._members(root).get(shape_id)
        if content is None:
            raise DatasetNotFound(f"{self.summary}: there is no shape {shape_id!r}")
        try:
            vertices, faces = _read_surface(content)
        except Exception as error:  # SciPy's reader raises whatever the bytes lead it to.
            path, _ = self._archive(root)
            fault = f"not a TOSCA surface ({type(error).__name__}: {error})"
            raise MeshFormatError(path / f"{shape_id}.mat", fault) from error
        return trimesh.Trimesh(vertices, faces, process=False)

    def _archive(self, root: Path) -> tuple[Path, str]:
        ((name, sha256),) = self.tags.files.items()
        return root / name, sha256

    def _members(self, root: Path) -> dict[str, bytes]:
        members = read_tar_members(*self._archive(root), ".mat")
        return {PurePosixPath(name).stem: content for name, content in members.items()}


class ToscaHighResolution(Tosca):
    """80 shapes of 4,344 to 52,565 vertices; all but centaurs, horses and wolves have holes."""

    summary: ClassVar[str] = "TOSCA high resolution: 80 shapes in 9 classes, to 52,565 vertices"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False,
        shapes=80,
        classes=9,
        licence=LICENCE,
        source="https://github.com/peekxc/pbsig/tree/ba4ee2b",
        files={
            "tosca/toscahires_mat.tar": (
                "90c6c6be0ee43b4b10eda8997b68bc31f447bd5b426bf2b50851e3f5206a20f2"
            )
        },
    )
    names: ClassVar[tuple[str, ...]] = CLASSES
    packing: ClassVar[str] = f"{PACK} -cf - *.mat"


def _read_surface(content: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read (V, 3) vertices and (F, 3) faces that count from 0."""
    from scipy.io import loadmat

    variables = loadmat(
        io.BytesIO(content), variable_names=("surface",), appendmat=False, simplify_cells=True
    )
    surface = variables["surface"]
    vertices = np.stack([surface[axis] for axis in "XYZ"], axis=1).astype(np.float64)
    faces = np.asarray(surface["TRIV"], dtype=np.int64) - 1
    if faces.ndim != 2 or faces.shape[1] != 3 or not len(faces):
        raise ValueError(f"TRIV is {faces.shape}, it must be (F, 3)")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise ValueError("TRIV names a vertex that does not exist")
    return vertices, faces
