"""Spherical maps in one file: the mesh and the place of each of its vertices on the sphere."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import SphericalMap
from gipkg.errors import MeshFormatError
from gipkg.files import atomic, write_arrays
from gipkg.formats import MAP_SUFFIXES
from gipkg.formats.array_faults import array_fault
from gipkg.formats.arrays import read_arrays
from gipkg.formats.ply_writing import FACE, header, write_ply

_PROPERTIES = ("x", "y", "z", "mesh_x", "mesh_y", "mesh_z")
_COMMENT = "a spherical map by gipkg, x y z on the unit sphere"
_HEADER = re.compile(header(_PROPERTIES, r"(\d{1,10})", r"(\d{1,10})", _COMMENT).encode("ascii"))
_ROUNDING = 1e-6
"""How far a length may be from 1: single precision is enough."""


def write_map(path: Path, spherical_map: SphericalMap) -> None:
    """Write a spherical map in the format that the suffix names, atomically and exactly.

    Parameters
    ----------
    path : Path
        Ends in one of `MAP_SUFFIXES`. An ``.npz`` holds ``vertices`` (V, 3), ``faces`` (F, 3)
        and ``sphere`` (V, 3).
    spherical_map : SphericalMap

    Raises
    ------
    ValueError
        The suffix is none of them.
    """
    vertices = np.asarray(spherical_map.mesh.vertices, np.float64)
    faces, sphere = np.asarray(spherical_map.mesh.faces), spherical_map.sphere
    match path.suffix.lower():
        case ".npz":
            write_arrays(path, {"vertices": vertices, "faces": faces, "sphere": sphere})
        case ".ply":
            columns = np.hstack([sphere, vertices]).T
            with atomic(path) as stream:
                write_ply(stream, dict(zip(_PROPERTIES, columns, strict=True)), faces, _COMMENT)
        case _:
            raise ValueError(f"{path}: a spherical map is written as {', '.join(MAP_SUFFIXES)}")


def is_map(path: Path) -> bool:
    """Tell whether a file says that it is a spherical map of ours and not any mesh."""
    if path.suffix.lower() == ".npz":
        return True
    if path.suffix.lower() != ".ply" or not path.is_file():
        return False
    with path.open("rb") as stream:
        return _HEADER.match(stream.read(1024)) is not None


def read_map(path: Path) -> SphericalMap:
    """Read what :func:`write_map` wrote.

    Raises
    ------
    MeshFormatError
        There is no such file, or it holds no mesh with a unit vector for every vertex.
    """
    if not path.is_file():
        raise MeshFormatError(path, "there is no such file")
    try:
        read = _read_npz if path.suffix.lower() == ".npz" else _read_ply
        vertices, faces, sphere = read(path)
        _check(vertices, faces, sphere)
    except ValueError as error:
        way_out = "gipkg parametrize makes one of a mesh"
        raise MeshFormatError(path, f"not a spherical map: {error}; {way_out}") from error
    mesh = trimesh.Trimesh(vertices, faces, process=False, metadata={"file_name": path.name})
    return SphericalMap(mesh, sphere)


def _read_npz(path: Path) -> tuple[NDArray, NDArray, NDArray]:
    arrays = read_arrays(path)
    if missing := {"vertices", "faces", "sphere"} - set(arrays):
        raise ValueError(f"it has no array {', '.join(sorted(missing))}")
    faces = arrays["faces"]
    if faces.dtype.kind not in "iu":
        raise ValueError(f"its faces are {faces.dtype}, not whole numbers")
    vertices, sphere = (arrays[name].astype(np.float64) for name in ("vertices", "sphere"))
    return vertices, faces.astype(np.int64), sphere


def _read_ply(path: Path) -> tuple[NDArray, NDArray, NDArray]:
    content = path.read_bytes()
    head = _HEADER.match(content)
    if head is None:
        raise ValueError("its header is not that of gipkg's maps")
    vertices, faces = int(head[1]), int(head[2])
    middle = head.end() + 8 * len(_PROPERTIES) * vertices
    if len(content) != middle + FACE.itemsize * faces:
        raise ValueError("it is longer or shorter than its header says")
    places = np.frombuffer(content[head.end() : middle], "<f8").reshape(-1, len(_PROPERTIES))
    triangles = np.frombuffer(content[middle:], FACE)
    if (triangles["count"] != 3).any():
        raise ValueError("not all of its faces are triangles")
    return places[:, 3:].copy(), triangles["corners"].astype(np.int64), places[:, :3].copy()


def _check(vertices: NDArray, faces: NDArray, sphere: NDArray) -> None:
    for name, array in (("vertices", vertices), ("faces", faces), ("sphere", sphere)):
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"its {name} are {array.shape}, not three numbers a row")
    if fault := array_fault(vertices, faces):
        raise ValueError(fault)
    if sphere.shape != vertices.shape:
        raise ValueError(f"{len(vertices)} vertices, but {len(sphere)} places on the sphere")
    if not (np.abs(np.linalg.norm(sphere, axis=1) - 1) < _ROUNDING).all():
        raise ValueError("not all places on the sphere are unit vectors")
