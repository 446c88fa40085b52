"""Any mesh file to one triangle mesh as it stands in the file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from gipkg.errors import MeshFormatError
from gipkg.formats.array_faults import array_fault
from gipkg.formats.off import parse_off


def load_mesh(path: Path | str) -> trimesh.Trimesh:
    """Read a mesh file without changing what it says.

    All formats that trimesh reads (obj, ply, stl, glb …) and all variants of OFF. Polygons
    are triangulated; the parts of a scene are concatenated in its coordinates.

    Parameters
    ----------
    path : Path or str
        The file; its suffix names the format.

    Returns
    -------
    trimesh.Trimesh
        Unprocessed: vertices are not merged and faces are not removed. The file's name
        stands in ``metadata["file_name"]``.

    Raises
    ------
    MeshFormatError
        There is no such file, or it is no triangle mesh with finite vertices.
    """
    path = Path(path)
    _check_file(path)
    if path.suffix.lower() == ".off":
        return load_off(path.read_bytes(), path)
    return _mesh(*_read_by_trimesh(path), path)


def load_off(data: bytes, path: Path) -> trimesh.Trimesh:
    """Read the content of an OFF file, as :func:`load_mesh` does a file.

    Parameters
    ----------
    data : bytes
        All of it.
    path : Path
        What to call it, such as its place in an archive.

    Raises
    ------
    MeshFormatError
        It is no OFF file with a triangle mesh of finite vertices.
    """
    return _mesh(*parse_off(data, path), path)


def _mesh(vertices: np.ndarray, faces: np.ndarray, path: Path) -> trimesh.Trimesh:
    if fault := array_fault(vertices, faces):
        raise MeshFormatError(path, f"not a triangle mesh: {fault}")
    return trimesh.Trimesh(vertices, faces, process=False, metadata={"file_name": path.name})


def _check_file(path: Path) -> None:
    if path.is_dir():
        raise MeshFormatError(path, "this is a folder; name one mesh file in it")
    if not path.is_file():
        raise MeshFormatError(path, "there is no such file")
    if path.stat().st_size == 0:
        raise MeshFormatError(path, "the file is empty")


def _read_by_trimesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    if path.suffix.lower().lstrip(".") not in trimesh.available_formats():
        known = ", ".join(sorted(trimesh.available_formats()))
        raise MeshFormatError(path, f"the suffix {path.suffix!r} is none of {known}")
    try:
        mesh = trimesh.load(path, process=False, force="mesh")
    except Exception as error:  # readers of damaged files raise whatever they stumble over
        raise MeshFormatError(path, f"not readable as {path.suffix}: {error!r}") from error
    if not isinstance(mesh, trimesh.Trimesh):
        raise MeshFormatError(path, f"holds a {type(mesh).__name__}, not a triangle mesh")
    return np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int64)
