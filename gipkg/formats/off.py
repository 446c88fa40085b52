"""Reader of Object File Format meshes: text and binary, any polygons, extra columns ignored.

The libraries' readers refuse some of the files of the field: polygons of mixed size, the binary
form, a header that runs into the counts. Format: Geomview manual, section OFF; the binary
form also as other writers have it, without a colour count after each face.
"""

from __future__ import annotations

import re
from array import array
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from gipkg.formats.limits import check_counts
from gipkg.formats.lines import words_of_lines
from gipkg.formats.polygons import Polygons

_HEADER = re.compile(rb"(?:\s|#[^\r\n]*)*(?:ST)?C?N?(4?)(n?)OFF[ \t]*(BINARY)?[ \t]*\r?\n?")


def parse_off(data: bytes) -> tuple[NDArray[np.float64], Polygons]:
    """Read the vertices and the polygons of an OFF file's content.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : Polygons
        Nothing is said of whether their corners exist.

    Raises
    ------
    ValueError
        It is no OFF file in three dimensions, ends early, is too large, or counts wrongly.
    """
    header = _HEADER.match(data)
    if header is None:
        raise ValueError("it does not begin with the header of an OFF file")
    if header[1] or header[2]:
        raise ValueError("only OFF files in three dimensions are read")
    body = data[header.end() :]
    return _binary(body) if header[3] else _text(body)


def _text(body: bytes) -> tuple[NDArray[np.float64], Polygons]:
    lines = words_of_lines(body)
    counts = next(lines, [])
    if len(counts) < 2:
        raise ValueError("the line of vertex and face counts is missing")
    vertex_count, face_count = int(counts[0]), int(counts[1])
    available = sum(1 for _ in words_of_lines(body)) - 1
    _check_counts(vertex_count, face_count, available, "lines")
    check_counts(vertex_count, face_count)
    coordinates, corners, lengths = array("d"), array("q"), array("q")
    for row in islice(lines, vertex_count):
        if len(row) < 3:
            raise ValueError("a vertex has fewer than three coordinates")
        coordinates.extend(map(float, row[:3]))
    for length, *rest in islice(lines, face_count):
        named = rest[: int(length)]
        if len(named) != int(length):
            raise ValueError(f"a face of {int(length)} corners names {len(named)}")
        corners.extend(map(int, named))
        lengths.append(len(named))
    vertices = np.array(coordinates).reshape(-1, 3)
    return vertices, Polygons(np.array(corners), np.array(lengths))


def _binary(body: bytes) -> tuple[NDArray[np.float64], Polygons]:
    if len(body) < 12:
        raise ValueError("it ends before the counts")
    vertex_count, face_count, _ = (int(n) for n in np.frombuffer(body, ">i4", 3))
    _check_counts(3 * vertex_count, 2 * face_count, len(body) // 4 - 3, "numbers")
    check_counts(vertex_count, face_count)
    with np.errstate(invalid="ignore"):  # array_fault finds what is no number
        vertices = np.frombuffer(body, ">f4", 3 * vertex_count, 12).astype(np.float64)
    words = np.frombuffer(body[12 + 12 * vertex_count :][: len(body) // 4 * 4], ">i4")
    for colours in (True, False):
        faces = _binary_faces(words.astype(np.int64), face_count, colours)
        if faces is not None:
            return vertices.reshape(-1, 3), faces
    raise ValueError("the faces do not end where the file ends")


def _binary_faces(words: NDArray[np.int64], count: int, colours: bool) -> Polygons | None:
    """Split the words into faces; None where they do not end with the last word."""
    is_corner = np.zeros(len(words), bool)
    lengths = array("q")
    at = 0
    for _ in range(count):
        if at >= len(words) or words[at] < 0:
            return None
        end = at + 1 + int(words[at])
        is_corner[at + 1 : end] = True
        lengths.append(end - at - 1)
        if colours:
            if end >= len(words) or words[end] < 0:
                return None
            end += 1 + int(words[end])
        at = end
    return Polygons(words[is_corner], np.array(lengths)) if at == len(words) else None


def _check_counts(vertices: int, faces: int, available: int, unit: str) -> None:
    """Refuse counts that the file cannot hold before anything is allocated for them."""
    if min(vertices, faces) < 0 or vertices + faces > available:
        raise ValueError(f"the header asks for {vertices + faces} {unit}, the file has {available}")
