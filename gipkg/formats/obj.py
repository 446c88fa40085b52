"""Reader of Wavefront OBJ meshes: vertices and faces, in the file's order.

Materials, textures and normals are left alone, so that no other file is opened, and a vertex that
has several of them stays one vertex. Format: Wavefront, Advanced Visualizer manual, appendix B1.
"""

from __future__ import annotations

import re
from array import array

import numpy as np
from numpy.typing import NDArray

from gipkg.formats.limits import check_counts
from gipkg.formats.lines import words_of_lines
from gipkg.formats.polygons import Polygons

_CONTINUED = re.compile(rb"\\[ \t]*\r?\n")


def parse_obj(data: bytes) -> tuple[NDArray[np.float64], Polygons]:
    """Read the vertices and the polygons of an OBJ file's content.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : Polygons
        Nothing is said of whether their corners exist.

    Raises
    ------
    ValueError
        A line is not well formed, or there are too many.
    """
    coordinates, corners, lengths = array("d"), array("q"), array("q")
    for keyword, *values in words_of_lines(_CONTINUED.sub(b" ", data)):
        if keyword == b"v":
            if len(values) < 3:
                raise ValueError("a vertex has fewer than three coordinates")
            coordinates.extend(map(float, values[:3]))
        elif keyword == b"f":
            numbers = [int(value.partition(b"/")[0]) for value in values]
            if 0 in numbers:
                raise ValueError("a face has a corner 0; they count from 1")
            # Negative numbers count back from the vertex that was last named.
            count = len(coordinates) // 3
            corners.extend(one - 1 if one > 0 else one + count for one in numbers)
            lengths.append(len(numbers))
            check_counts(count, len(lengths))
    check_counts(len(coordinates) // 3, len(lengths))
    vertices = np.array(coordinates).reshape(-1, 3)
    return vertices, Polygons(np.array(corners), np.array(lengths))
