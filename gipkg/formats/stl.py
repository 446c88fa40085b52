"""Reader of STL meshes, binary and text: triangles without shared vertices.

Format: 3D Systems, StereoLithography Interface Specification.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

_HEADER = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)
_END = re.compile(rb"\bendsolid\b", re.IGNORECASE)


def parse_stl(data: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read the corners of the triangles of an STL file's content, and their numbers in threes.

    Returns
    -------
    vertices : (3F, 3) float64 array
    faces : (F, 3) int64 array

    Raises
    ------
    ValueError
        It is neither text that comes to its end nor as long as its header says.
    """
    count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    if len(data) >= _HEADER and len(data) == _HEADER + count * _TRIANGLE.itemsize:
        with np.errstate(invalid="ignore"):  # array_fault finds what is no number
            corners = np.frombuffer(data, _TRIANGLE, count, _HEADER)["corners"].astype(np.float64)
    elif data.lstrip()[:5].lower() == b"solid":
        if not _END.search(data):
            raise ValueError("it ends before endsolid")
        corners = np.array(_VERTEX.findall(data), dtype=np.float64)
        if len(corners) % 3:
            raise ValueError(f"{len(corners)} vertices do not make triangles")
    else:
        held = max(0, len(data) - _HEADER) // _TRIANGLE.itemsize
        raise ValueError(f"the header asks for {count} triangles, the file has {held}")
    vertices = corners.reshape(-1, 3)
    return vertices, np.arange(len(vertices)).reshape(-1, 3)
