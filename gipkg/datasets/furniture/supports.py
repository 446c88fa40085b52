"""What furniture stands on: legs, rungs between them, and a column with a foot."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import tube, turned_profile
from gipkg.datasets.proportions import vary


def four_legs(
    model: Model,
    rng: np.random.Generator,
    width: float,
    depth: float,
    height: float,
    thickness: float,
    rungs: float = 0.0,
) -> None:
    """Add legs below a rectangle around the z axis.

    They are square, turned or raked; with the probability `rungs` there are bars between them.
    """
    kind = rng.choice(["square", "round", "raked"])
    x, y = width / 2 - thickness, depth / 2 - thickness
    splay = rng.uniform(0.05, 0.2) * height if kind == "raked" else 0.0
    taper = rng.uniform(0.5, 1.0)
    for side in (-1, 1):
        for end in (-1, 1):
            if kind == "square":
                across, along, half = side * x, end * y, thickness / 2
                model.box(
                    (across - half, across + half), (along - half, along + half), (0.0, height)
                )
            else:
                foot = [side * (x + splay), end * (y + splay), 0.0]
                top = [side * x, end * y, height + thickness / 4]
                model.add(tube([foot, top], [taper * thickness, thickness]))
    if rng.random() < rungs:
        _rungs(model, rng, x + splay / 2, y + splay / 2, height, thickness)


def _rungs(
    model: Model, rng: np.random.Generator, x: float, y: float, height: float, thickness: float
) -> None:
    """Add bars between neighbouring legs, or an H of three."""
    level, bar = height * rng.uniform(0.2, 0.6), thickness * rng.uniform(0.5, 0.8)
    for side in (-1, 1):
        model.add(tube([[side * x, -y, level], [side * x, y, level]], bar))
    if rng.random() < 0.5:
        model.add(tube([[-x, 0.0, level], [x, 0.0, level]], bar))
    else:
        for end in (-1, 1):
            model.add(tube([[-x, end * y, level + bar], [x, end * y, level + bar]], bar))


def column(model: Model, rng: np.random.Generator, width: float, height: float) -> None:
    """Add a column on a foot as wide as `width`: a disc, or a star of four or five arms."""
    stem = vary(rng, 0.12, 0.3) * width
    bulge = stem * rng.uniform(0.8, 1.8)
    profile = [(stem, 0.02), (stem, 0.3 * height), (bulge, 0.5 * height), (stem, height)]
    model.add(turned_profile(profile, corners=12))
    if rng.random() < 0.5:
        rim = vary(rng, 0.06, 0.3) * height
        model.add(turned_profile([(width, 0.0), (width, rim / 2), (1.2 * stem, rim)]))
        return
    arms = int(rng.integers(4, 6))
    for angle in 2 * np.pi * np.arange(arms) / arms:
        tip = [width / 2 * np.cos(angle), width / 2 * np.sin(angle), stem / 3]
        model.add(tube([[0.0, 0.0, 0.25 * height], tip], [0.7 * stem, 0.5 * stem]))


def bun_feet(model: Model, width: float, depth: float, height: float, thickness: float) -> None:
    """Add four short blocks below a rectangle around the z axis."""
    for side in (-1, 1):
        for end in (-1, 1):
            x, y = side * (width / 2 - thickness), end * (depth / 2 - thickness)
            half = thickness / 2
            model.box((x - half, x + half), (y - half, y + half), (0.0, height))
