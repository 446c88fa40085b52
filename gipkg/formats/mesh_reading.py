"""Any mesh file to one triangle mesh as it stands in the file."""

from __future__ import annotations

import stat
from pathlib import Path

import numpy as np
import trimesh

from gipkg.errors import MeshFormatError
from gipkg.formats import MESH_SUFFIXES
from gipkg.formats.array_faults import array_fault
from gipkg.formats.glb import parse_glb
from gipkg.formats.limits import LARGEST_FILE
from gipkg.formats.obj import parse_obj
from gipkg.formats.off import parse_off
from gipkg.formats.ply_reading import parse_ply
from gipkg.formats.polygons import triangulate_polygons
from gipkg.formats.stl import parse_stl


def read_mesh(path: Path | str) -> trimesh.Trimesh:
    """Read a mesh file without changing what it says.

    The formats are ``.ply``, ``.off``, ``.obj``, ``.stl`` and ``.glb``. Polygons are
    triangulated; the parts of a scene are concatenated in its coordinates. No other file is
    opened, whatever this one names.

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
        There is no such file, it cannot be opened or is larger than `LARGEST_FILE`, or it is no
        triangle mesh with finite vertices.
    """
    path = Path(path)
    return parse_mesh(_read(path), path)


def parse_mesh(data: bytes, path: Path) -> trimesh.Trimesh:
    """Read the content of a mesh file, as :func:`read_mesh` does a file.

    Parameters
    ----------
    data : bytes
        All of it.
    path : Path
        What to call it, such as its place in an archive; the suffix names the format.

    Raises
    ------
    MeshFormatError
        It is no triangle mesh with finite vertices.
    """
    vertices, faces = _parse(data, path)
    if fault := array_fault(vertices, faces):
        raise MeshFormatError(path, f"not a triangle mesh: {fault}")
    return trimesh.Trimesh(vertices, faces, process=False, metadata={"file_name": path.name})


def _read(path: Path) -> bytes:
    try:
        status = path.stat()
        if stat.S_ISDIR(status.st_mode):
            raise MeshFormatError(path, "this is a folder; name one mesh file in it")
        if path.suffix.lower() not in MESH_SUFFIXES:
            known = ", ".join(MESH_SUFFIXES)
            raise MeshFormatError(path, f"the suffix {path.suffix!r} is none of {known}")
        if not stat.S_ISREG(status.st_mode):
            raise MeshFormatError(path, "this is no regular file")
        if status.st_size == 0:
            raise MeshFormatError(path, "the file is empty")
        if status.st_size > LARGEST_FILE:
            raise MeshFormatError(
                path,
                f"it has {status.st_size} bytes, more than {LARGEST_FILE}; decimate the mesh",
            )
        return path.read_bytes()
    except (FileNotFoundError, NotADirectoryError) as error:
        raise MeshFormatError(path, "there is no such file") from error
    except (OSError, ValueError) as error:  # a name with a zero in it is a ValueError
        raise MeshFormatError(path, f"cannot be opened: {error}") from error


def _parse(data: bytes, path: Path) -> tuple[np.ndarray, np.ndarray]:
    try:
        match path.suffix.lower():
            case ".glb":
                return parse_glb(data)
            case ".stl":
                return parse_stl(data)
            case ".obj":
                vertices, faces = parse_obj(data)
            case ".off":
                vertices, faces = parse_off(data)
            case _:
                vertices, faces = parse_ply(data)
        return vertices, triangulate_polygons(vertices, faces)
    except (ValueError, OverflowError) as error:
        raise MeshFormatError(path, f"not readable as {path.suffix}: {error}") from error
