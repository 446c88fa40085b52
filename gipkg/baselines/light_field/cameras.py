"""Where the silhouettes are taken from: vertices of dodecahedra, in ten attitudes."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

SYSTEMS = 10
VIEWS = 10
"""Of the 20 vertices of a dodecahedron, one of each opposite pair: its silhouette is the mirror
image of the other's, and no feature tells mirror images apart."""

_GOLDEN = (1 + 5**0.5) / 2


@cache
def axes() -> NDArray[np.float64]:
    """Return the (10, 3) unit vectors to the vertices of a dodecahedron, up to sign."""
    cube = np.array([[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]], dtype=np.float64)
    a, b = _GOLDEN, 1 / _GOLDEN
    planes = np.array([[0, a, b], [0, a, -b], [a, b, 0], [a, -b, 0], [b, 0, a], [b, 0, -a]])
    return np.concatenate([cube, planes]) / np.sqrt(3)


@cache
def alignments() -> NDArray[np.int64]:
    """Return the (60, 10) permutations of the axes by the rotations of the dodecahedron.

    Axis v of one shape meets axis ``alignments()[g, v]`` of the other.
    """
    turned = np.einsum("gij,vj->gvi", Rotation.create_group("I").as_matrix(), axes())
    return np.abs(turned @ axes().T).argmax(axis=2)


@cache
def attitudes() -> NDArray[np.float64]:
    """Return the (10, 3, 3) rotations of the dodecahedra, spread evenly.

    They lie on a spiral through all rotations (Alexa, "Super-Fibonacci Spirals", CVPR 2022). An
    attitude of one shape's cameras, an alignment and an attitude of the other's make 5,460
    different rotations; any rotation is 7.4° away from the nearest on average.
    """
    steps = np.arange(SYSTEMS) + 0.5
    inner, outer = np.sqrt(steps / SYSTEMS), np.sqrt(1 - steps / SYSTEMS)
    one = 2 * np.pi * steps / np.sqrt(2)
    other = 2 * np.pi * steps / 1.5337511687552043  # the root of x⁴ = x + 4
    quaternions = [inner * np.sin(one), inner * np.cos(one)]
    quaternions += [outer * np.sin(other), outer * np.cos(other)]
    return Rotation.from_quat(np.stack(quaternions, axis=1)).as_matrix()


@cache
def directions() -> NDArray[np.float64]:
    """Return the (10, 10, 3) unit vectors towards the cameras of every system."""
    return np.einsum("sij,vj->svi", attitudes(), axes())
