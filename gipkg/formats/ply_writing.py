"""Binary PLY files in double precision: what is read again is what was written, bit by bit.

The usual writers store single precision, which can flatten the thin triangles of a surface.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import IO

import numpy as np
from numpy.typing import NDArray

FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
"""A triangle as it stands in the file."""


def header(names: tuple[str, ...], vertices: int | str, faces: int | str, comment: str) -> str:
    """Return the header of a file whose vertices have those properties.

    The counts may be patterns: the result is then one too, since nothing else in it is special.
    """
    return "\n".join(
        (
            "ply",
            "format binary_little_endian 1.0",
            f"comment {comment}",
            f"element vertex {vertices}",
            *(f"property double {name}" for name in names),
            f"element face {faces}",
            "property list uchar int vertex_indices",
            "end_header",
            "",
        )
    )


def write_ply(
    stream: IO[bytes],
    properties: Mapping[str, NDArray[np.float64]],
    faces: NDArray[np.integer],
    comment: str,
) -> None:
    """Write V vertices and F triangles.

    Parameters
    ----------
    stream : binary file
    properties : mapping
        Name -> (V,) array; ``x``, ``y`` and ``z`` are the place of a vertex.
    faces : (F, 3) integer array
    comment : str
        One line that says what the file is.
    """
    vertices = np.column_stack(list(properties.values())).astype("<f8")
    triangles = np.empty(len(faces), FACE)
    triangles["count"] = 3
    triangles["corners"] = faces
    stream.write(header(tuple(properties), len(vertices), len(faces), comment).encode("ascii"))
    stream.write(vertices.tobytes())
    stream.write(triangles.tobytes())
