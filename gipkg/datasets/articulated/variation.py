"""Random proportions and joint angles, shared by all classes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.datasets.proportions import vary

STUNTED = 0.06
"""Share of limbs that are much shorter than their fellows."""


def limb_lengths(
    rng: np.random.Generator, length: float, shares: tuple[float, ...], spread: float = 0.12
) -> NDArray[np.float64]:
    """Lengths of a limb's bones, from its whole length and their shares in it.

    Fellow limbs differ by `spread`; a few are stunted, which breaks the symmetry of the body.
    """
    if rng.random() < STUNTED:
        length *= rng.uniform(0.45, 0.75)
    factors = np.exp(rng.uniform(-spread, spread, len(shares)))
    return vary(rng, length, spread / 2) * np.array(shares) / sum(shares) * factors


def taper(first: float, last: float, bones: int) -> NDArray[np.float64]:
    """Radii at the ends of a limb's bones, running linearly from `first` to `last`."""
    return np.linspace(first, last, bones + 1)[1:]


def joint(
    rng: np.random.Generator, pitch: float, play: float, yaw: float = 0.0, side: float = 0.0
) -> Rotation:
    """Rotate by `pitch` (down, about y) +- `play` and `yaw` (left, about z) +- `side`, radians."""
    angles = [yaw + rng.uniform(-side, side), pitch + rng.uniform(-play, play)]
    return Rotation.from_euler("ZY", angles)


def meander(rng: np.random.Generator, bones: int, amplitude: float) -> list[Rotation]:
    """Smoothly changing bends in all directions, for limbs without joints.

    Each angle is a wave along the limb with random phase, of at most one and a half periods.
    """
    position = np.arange(bones - 1) / bones
    phase = rng.uniform(0.0, 2 * np.pi, 2)
    periods = rng.uniform(0.3, 1.5, 2)
    angles = amplitude * np.sin(2 * np.pi * periods * position[:, None] + phase)
    return [Rotation.from_euler("ZY", pair) for pair in angles]
