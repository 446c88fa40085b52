"""The ways to sample the sphere; the command line names them without importing NumPy."""

from __future__ import annotations

from typing import Literal, get_args

Sampling = Literal["equal-area", "authors"]
"""How an octant is laid on its triangle.

``equal-area``
    Areas in the square are areas on the sphere times 1/π, exactly and everywhere.
``authors``
    Barycentric coordinates in the triangle are the shares that the spherical triangles
    between a point and the octant's sides have in the octant's area, as the paper's authors
    sample (section 4.1). That is not equal-area: pixels per area on the sphere vary from
    0.886 (octant centres) to 4/π = 1.273 (octahedron vertices) of their mean, with a standard
    deviation of 0.078.
"""

SAMPLINGS: tuple[Sampling, ...] = get_args(Sampling)
