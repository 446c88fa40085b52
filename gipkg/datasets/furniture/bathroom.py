"""Bathtubs and toilets: basins."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import Part, loft, ring, tube, turned_profile
from gipkg.datasets.furniture.supports import bun_feet
from gipkg.datasets.proportions import vary


def bathtubs(rng: np.random.Generator) -> Model:
    """Make a bathtub: an oval or square basin, free on feet or in a block, some with a tap."""
    model = Model()
    length, width = vary(rng, 1.65, 0.15), vary(rng, 0.75, 0.15)
    height, wall = vary(rng, 0.55, 0.2), vary(rng, 0.06, 0.4)
    squareness = rng.uniform(0.0, 0.8)
    deep = height * rng.uniform(0.2, 0.35)
    foot = 0.0
    if rng.random() < 0.4:
        foot = rng.uniform(0.06, 0.15)
        bun_feet(model, 0.7 * length, 0.8 * width, foot + 0.05, vary(rng, 0.08, 0.2))
    taper = rng.uniform(0.6, 0.95) if rng.random() < 0.65 else 1.0
    levels = [
        (taper, foot, 0.0),
        (1.0, height, 0.0),
        (1.0, height, wall),
        (0.5 + taper / 2, foot + deep, 1.4 * wall),
    ]
    rise = rng.uniform(0.1, 0.4) * height if rng.random() < 0.3 else 0.0
    outlines = []
    for share, level, inset in levels:
        size = share * length - 2 * inset, share * width - 2 * inset
        outline = ring(*size, level, squareness, 28)
        outline[:, 2] += rise * (level == height) * np.abs(2 * outline[:, 0] / length) ** 2
        outlines.append(outline)
    model.add(loft(outlines))
    if taper == 1.0 and rng.random() < 0.5:
        x, y, skirt = length / 2 + wall, width / 2 + wall, 0.5 * wall
        for side in (-1, 1):
            model.box((-x, x), (side * y, side * (y - skirt)), (0.0, height))
            model.box((side * x, side * (x - skirt)), (-y, y), (0.0, height))
    if rng.random() < 0.4:
        x, reach = length / 2 - wall / 2, vary(rng, 0.12, 0.3)
        top = height + rise + vary(rng, 0.18, 0.3)
        spout = [[x, 0.0, height - wall], [x, 0.0, top], [x - reach, 0.0, top]]
        model.add(tube(spout[:2], 0.045), tube(spout[1:], 0.045))
    return model


def toilets(rng: np.random.Generator) -> Model:
    """Make a toilet: a bowl on a foot or a wall, a seat, a lid that is up or down, a tank."""
    model = Model()
    width, length = vary(rng, 0.37, 0.1), vary(rng, 0.5, 0.15)
    rim, foot = vary(rng, 0.4, 0.1), rng.uniform(0.45, 0.7)
    hung = rng.random() < 0.15
    base = 0.3 * rim if hung else 0.0
    squareness = rng.uniform(0.0, 0.4)
    stretch = length / width
    profile = [
        (foot * width, base),
        (foot * rng.uniform(0.7, 1.0) * width, base + 0.4 * (rim - base)),
        (width, rim),
        (0.75 * width, rim),
        (0.4 * width, rim - 0.15),
    ]
    model.add(turned_profile(profile, squareness, stretch))
    back, top = length / 2, rim + 0.03
    model.add(_ring_seat(width, stretch, rim, top, squareness))
    lid = turned_profile([(width, 0.0), (width, 0.025)], squareness, stretch)
    if rng.random() < 0.6:
        angle = np.pi / 2 + rng.uniform(-0.1, 0.15)
        model.add(
            lid.moved([0.0, -back, 0.0]).turned(-angle, axis=0).moved([0.0, back - 0.04, top])
        )
    elif rng.random() < 0.6:
        model.add(lid.moved([0.0, 0.0, top]))
    _tank(model, rng, back, rim, 0.0 if hung else 0.5 * foot * width)
    return model


def _ring_seat(width: float, stretch: float, low: float, high: float, squareness: float) -> Part:
    """Return a flat ring: its outline runs up outside, across, down inside and meets itself."""
    depth = width * stretch
    outline = [(1.0, low), (1.0, high), (0.65, high), (0.65, low)]
    rings = [ring(share * width, share * depth, level, squareness) for share, level in outline]
    return loft(np.stack(rings, axis=1)[[*range(20), 0]])


def _tank(
    model: Model, rng: np.random.Generator, back: float, rim: float, half_foot: float
) -> None:
    """Add what is behind the bowl: a tank low or high, or only the wall that it hangs on."""
    half, depth = vary(rng, 0.2, 0.2), vary(rng, 0.17, 0.2)
    kind = rng.random()
    if kind < 0.75 and half_foot:
        high = rim + vary(rng, 0.36, 0.2)
        low = rim * rng.uniform(0.7, 1.0)
        model.box((-half, half), (back - 0.05, back + depth), (low, high))
        model.box(
            (-half - 0.01, half + 0.01), (back - 0.06, back + depth + 0.01), (high, high + 0.03)
        )
        model.box((-half_foot, half_foot), (0.0, back + depth / 2), (0.0, low))
        if rng.random() < 0.5:
            button = turned_profile([(0.06, 0.0), (0.06, 0.02)], corners=10)
            model.add(button.moved([0.0, back + depth / 2, high + 0.03]))
    elif kind < 0.9 and half_foot:
        high = rim + vary(rng, 1.1, 0.2)
        model.box((-half, half), (back, back + depth), (high, high + 0.35))
        model.add(tube([[0.0, back + 0.06, 0.4 * rim], [0.0, back + 0.06, high]], 0.06))
        model.box((-half_foot, half_foot), (0.0, back + 0.08), (0.0, 0.6 * rim))
    else:
        model.box((-half, half), (back - 0.03, back + 0.05), (0.0, rim + vary(rng, 0.4, 0.3)))
