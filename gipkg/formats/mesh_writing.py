"""Triangle meshes to the files that people use."""

from __future__ import annotations

from pathlib import Path
from typing import IO

import numpy as np
import trimesh

from gipkg.files import atomic
from gipkg.formats import MESH_SUFFIXES
from gipkg.formats.ply_writing import write_ply


def write_mesh(path: Path, mesh: trimesh.Trimesh) -> None:
    """Write a mesh in the format that the suffix names, atomically.

    Parameters
    ----------
    path : Path
        Ends in one of `MESH_SUFFIXES`, in small letters or capitals.
    mesh : trimesh.Trimesh
        Its vertices and faces are written, nothing else.

    Raises
    ------
    ValueError
        The suffix is none of them.
    """
    suffix = path.suffix.lower()
    if suffix not in MESH_SUFFIXES:
        raise ValueError(f"{path}: a mesh is written as {', '.join(MESH_SUFFIXES)}")
    bare = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    with atomic(path) as stream:
        if suffix == ".ply":
            properties = dict(zip("xyz", np.asarray(bare.vertices).T, strict=True))
            write_ply(stream, properties, np.asarray(bare.faces), "a mesh by gipkg")
        elif suffix in (".off", ".obj"):
            _write_text(stream, bare, suffix)
        else:
            bare.export(stream, file_type=suffix[1:])


def _write_text(stream: IO[bytes], mesh: trimesh.Trimesh, suffix: str) -> None:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if suffix == ".off":
        stream.write(f"OFF\n{len(vertices)} {len(faces)} 0\n".encode())
        np.savetxt(stream, vertices, "%.17g")
        np.savetxt(stream, faces, "3 %d %d %d")
    else:
        np.savetxt(stream, vertices, "v %.17g %.17g %.17g")
        np.savetxt(stream, faces + 1, "f %d %d %d")
