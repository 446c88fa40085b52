"""Möbius transformations of the sphere, and the one that centres a map.

A hyperbolic translation of the ball moves the point `c` to the origin and acts on the sphere as a
conformal map. With rotations these are all orientation-preserving conformal maps of the sphere to
itself, so that asking for the mass centre at the origin picks one conformal map of a surface, up
to a rotation (Gu, Wang, Chan, Thompson & Yau 2004, Section III).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.parametrizers.sphere.areas import flipped_faces

_ITERATIONS = 100
_ROUND_OFF = 1e-15
"""Distance of the mass centre from the origin that double precision cannot tell from 0."""
_LARGEST_STEP = 0.5
"""Of the Newton steps, as a Euclidean distance in the unit ball."""
_LEAST_SHARE = 2.0**-6


def translate(points: NDArray[np.float64], c: NDArray[np.float64]) -> NDArray[np.float64]:
    """Apply the hyperbolic translation of the unit ball that moves `c` to the origin.

    Parameters
    ----------
    points : (..., 3) float64 array
        Points of the closed unit ball.
    c : (3,) float64 array
        Inside the ball.

    Returns
    -------
    (..., 3) float64 array
    """
    apart = points - c
    squared = (apart**2).sum(axis=-1, keepdims=True)
    shrink = 1 - c @ c
    inside = 1 - (points**2).sum(axis=-1, keepdims=True)
    moved: NDArray[np.float64] = (shrink * apart - squared * c) / (squared + shrink * inside)
    return moved


def conformal_centre(
    sphere: NDArray[np.float64], masses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Find the point whose translation to the origin brings the mass centre there.

    It minimises a function that is convex along hyperbolic lines, by Newton's method.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors.
    masses : (V,) float64 array
        Positive, and none of them half of the sum, else there is no such point.

    Returns
    -------
    (3,) float64 array
        Inside the unit ball.

    References
    ----------
    Douady & Earle, Conformally natural extension of homeomorphisms of the circle, Acta Math.
    1986.
    """
    shares = masses / masses.sum()
    centre = np.zeros(3)
    moved = sphere
    for _ in range(_ITERATIONS):
        mean = shares @ moved
        if np.linalg.norm(mean) < _ROUND_OFF:
            break
        spread = np.eye(3) - np.einsum("v,vi,vj->ij", shares, moved, moved)
        step = np.linalg.solve(2 * spread, mean)
        step *= min(1.0, _LARGEST_STEP / np.linalg.norm(step))
        if np.linalg.norm(step) < _ROUND_OFF:
            break
        # The translation after the next one is, up to a rotation, that of this point.
        centre = translate(step, -centre)
        moved = translate(sphere, centre)
    return centre


def centred(
    sphere: NDArray[np.float64], faces: NDArray[np.integer], masses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Centre a map without flips: its mass centre moves to the origin.

    Angles at the vertices stay, but edges do not remain great circles. Where a thin face would
    flip by that, the map stops half, a quarter, … of the way.

    Parameters
    ----------
    sphere : (V, 3) float64 array
        Unit vectors; no flipped face.
    faces : (F, 3) integer array
    masses : (V,) float64 array
        Of the vertices, such as the areas around them on the surface.

    Returns
    -------
    (V, 3) float64 array
        Unit vectors; no flipped face.
    """
    centre = conformal_centre(sphere, masses)
    share = 1.0
    while share >= _LEAST_SHARE:
        moved = translate(sphere, share * centre)
        moved /= np.linalg.norm(moved, axis=1, keepdims=True)
        if not flipped_faces(moved, faces).any():
            return moved
        share /= 2
    return sphere
