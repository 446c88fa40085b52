"""Reader of Object File Format meshes: text and binary, any polygons, extra columns ignored.

The libraries' readers refuse some of the files of the field: polygons of mixed size, the binary
form, a header that runs into the counts. Format: Geomview manual, section OFF; the binary
form also as other writers have it, without a colour count after each face.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gipkg.errors import MeshFormatError
from gipkg.formats.polygons import triangulate_polygons

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]

_HEADER = re.compile(rb"(?:\s|#[^\r\n]*)*(?:ST)?C?N?(4?)(n?)OFF[ \t]*(BINARY)?[ \t]*\r?\n?")
_COMMENT = re.compile(rb"#[^\r\n]*")


def parse_off(data: bytes, path: Path) -> Arrays:
    """Read the vertices and the triangulated faces of an OFF file's content.

    Parameters
    ----------
    data : bytes
        All of it.
    path : Path
        What to call it in an error.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array

    Raises
    ------
    MeshFormatError
        The file is not OFF in three dimensions, or ends early, or counts wrongly.
    """
    header = _HEADER.match(data)
    if header is None:
        raise MeshFormatError(path, "the header OFF is missing")
    if header[1] or header[2]:
        raise MeshFormatError(path, "only OFF files in three dimensions are read")
    body = data[header.end() :]
    try:
        vertices, polygons = _binary(body) if header[3] else _text(_COMMENT.sub(b"", body))
        outside = [p for p in polygons if ((p < 0) | (p >= len(vertices))).any()]
        if outside:
            raise ValueError(f"{len(outside)} faces name a vertex that does not exist")
        return vertices, triangulate_polygons(vertices, polygons)
    except (ValueError, OverflowError) as error:
        raise MeshFormatError(path, f"not a well-formed OFF file: {error}") from error


def _text(body: bytes) -> tuple[NDArray[np.float64], list[NDArray[np.int64]]]:
    lines = [line for line in body.splitlines() if line.strip()]
    counts = lines[0].split() if lines else []
    if len(counts) < 2:
        raise ValueError("the line of vertex and face counts is missing")
    vertex_count, face_count = int(counts[0]), int(counts[1])
    _check_counts(vertex_count, face_count, len(lines) - 1, "lines")
    rows = [line.split()[:3] for line in lines[1 : 1 + vertex_count]]
    if any(len(row) < 3 for row in rows):
        raise ValueError("a vertex has fewer than three coordinates")
    vertices = np.array(rows, dtype=np.float64).reshape(-1, 3)
    polygons = []
    for line in lines[1 + vertex_count : 1 + vertex_count + face_count]:
        count, *rest = line.split()
        corners = np.array(rest[: int(count)], dtype=np.int64)
        if len(corners) != int(count):
            raise ValueError(f"a face of {int(count)} corners names {len(corners)}")
        polygons.append(corners)
    return vertices, polygons


def _binary(body: bytes) -> tuple[NDArray[np.float64], list[NDArray[np.int64]]]:
    if len(body) < 12:
        raise ValueError("it ends before the counts")
    vertex_count, face_count, _ = (int(n) for n in np.frombuffer(body, ">i4", 3))
    _check_counts(3 * vertex_count, 2 * face_count, len(body) // 4 - 3, "numbers")
    vertices = np.frombuffer(body, ">f4", 3 * vertex_count, 12).astype(np.float64)
    words = np.frombuffer(body[12 + 12 * vertex_count :][: len(body) // 4 * 4], ">i4")
    for colours in (True, False):
        polygons, end = _binary_faces(words.astype(np.int64), face_count, colours)
        if end == len(words):
            return vertices.reshape(-1, 3), polygons
    raise ValueError("the faces do not end where the file ends")


def _binary_faces(
    words: NDArray[np.int64], count: int, colours: bool
) -> tuple[list[NDArray[np.int64]], int]:
    """Split the words into faces; the position after the last, -1 where they do not fit."""
    polygons: list[NDArray[np.int64]] = []
    at = 0
    for _ in range(count):
        if at >= len(words) or words[at] < 0:
            return polygons, -1
        end = at + 1 + int(words[at])
        polygons.append(words[at + 1 : end])
        if colours:
            if end >= len(words) or words[end] < 0:
                return polygons, -1
            end += 1 + int(words[end])
        at = end
    return polygons, at


def _check_counts(vertices: int, faces: int, available: int, unit: str) -> None:
    """Refuse counts that the file cannot hold before anything is allocated for them."""
    if min(vertices, faces) < 0 or vertices + faces > available:
        raise ValueError(f"the header asks for {vertices + faces} {unit}, the file has {available}")
