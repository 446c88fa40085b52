"""Desks, tables and monitors: a plane, and what holds it up."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import box, loft, ring, slab, tube, turned_profile
from gipkg.datasets.furniture.storage import drawers, shelves
from gipkg.datasets.furniture.supports import column, four_legs
from gipkg.datasets.proportions import vary


def tables(rng: np.random.Generator) -> Model:
    """Make a table: a round or square top on legs, a column or two walls; low, usual or high."""
    model = Model()
    width = vary(rng, 1.3, 0.4)
    depth = width * rng.uniform(0.45, 1.0)
    height = rng.choice([0.42, 0.74, 1.05]) * rng.uniform(0.9, 1.1)
    board, leg = vary(rng, 0.045, 0.4), vary(rng, 0.07, 0.35)
    under = height - board
    if rng.random() < 0.4:
        squareness = rng.choice([0.0, 0.0, 0.5])
        profile = [(width, under), (width, height)]
        model.add(turned_profile(profile, squareness, depth / width, corners=24))
        inner = 0.68
    else:
        model.box((-width / 2, width / 2), (-depth / 2, depth / 2), (under, height))
        inner = 0.97
    kind = rng.random()
    if kind < 0.6:
        four_legs(model, rng, inner * width, inner * depth, under, leg, rungs=0.35)
        if rng.random() < 0.4:
            _apron(model, inner * width - leg, inner * depth - leg, under, vary(rng, 0.08, 0.3))
    elif kind < 0.85:
        column(model, rng, 0.6 * depth, under)
    else:
        half = inner * width / 2 - leg
        for side in (-1, 1):
            wall = side * half, side * (half - leg / 2)
            model.box(wall, (-0.4 * depth, 0.4 * depth), (0.0, under))
        model.add(tube([[-half, 0.0, 0.4 * under], [half, 0.0, 0.4 * under]], 0.7 * leg))
    if rng.random() < 0.2:
        level = under * rng.uniform(0.2, 0.4)
        x, y = inner * width / 2 - leg / 2, inner * depth / 2 - leg / 2
        model.box((-x, x), (-y, y), (level, level + board))
    return model


def desks(rng: np.random.Generator) -> Model:
    """Make a desk: a top with drawers under it, or a wall at its back, or shelves on it."""
    model = Model()
    width, depth, height = vary(rng, 1.45, 0.25), vary(rng, 0.7, 0.2), vary(rng, 0.75, 0.1)
    board = vary(rng, 0.04, 0.3)
    under, half = height - board, width / 2
    model.box((-half, half), (-depth / 2, depth / 2), (under, height))
    sides = rng.choice(["left", "right", "both", "none"], p=[0.25, 0.25, 0.35, 0.15])
    block = width * rng.uniform(0.22, 0.32)
    back = depth / 2 - 0.03
    for side, name in ((-1, "left"), (1, "right")):
        if sides in (name, "both"):
            x = (0.02 - half, block - half) if side < 0 else (half - block, half - 0.02)
            gap = float(rng.choice([0.0, 0.05]))
            drawers(model, rng, x, (-back, back), (gap, under), rows=int(rng.integers(2, 5)))
        elif rng.random() < 0.6:
            model.box((side * half, side * (half - board)), (-back, back), (0.0, under))
        else:
            leg = vary(rng, 0.06, 0.3)
            for end in (-1, 1):
                at = [side * (half - leg), end * (depth / 2 - leg)]
                model.add(tube([[*at, 0.0], [*at, under + board / 2]], leg))
    if sides == "none" or rng.random() < 0.5:
        low = under * rng.uniform(0.2, 0.6)
        model.box((-half + 0.02, half - 0.02), (back - board, back), (low, under))
    if rng.random() < 0.25:
        reach = half + vary(rng, 0.8, 0.2)
        side = rng.choice([-1, 1])
        x = side * half, side * (half - depth)
        model.box(x, (-reach, -depth / 2), (under, height))
        model.box(x, (-reach, -reach + board), (0.0, under))
    if rng.random() < 0.35:
        top = height + vary(rng, 0.45, 0.3)
        span = (-half, half) if rng.random() < 0.6 else (-half, rng.uniform(-0.3, 0.3) * width)
        shelves(model, span, (depth / 6, depth / 2), (height, top), int(rng.integers(1, 3)), board)
    return model


def monitors(rng: np.random.Generator) -> Model:
    """Make a monitor: a flat, bent or deep screen, tilted, on a column, two feet or a wedge."""
    model = Model()
    width = vary(rng, 0.55, 0.25)
    height = width * rng.uniform(0.52, 0.85)
    low, thickness = vary(rng, 0.11, 0.5), vary(rng, 0.05, 0.4)
    tilt, centre = rng.uniform(-0.05, 0.2), [0.0, 0.0, low + height / 2]
    kind = rng.choice(["flat", "bent", "deep"], p=[0.5, 0.15, 0.35])
    depth = 0.0
    if kind == "bent":
        angle = np.linspace(-1.0, 1.0, 9) * rng.uniform(0.3, 0.6)
        curve = np.stack([1 - np.cos(angle), np.sin(angle)], axis=1) * width / 2 / np.sin(angle[-1])
        lying = slab(curve, thickness, (-height / 2, height / 2))
        screen = [lying.turned(np.pi / 2, axis=1).moved([0.0, 0.0, low + height / 2])]
    else:
        bezel = thickness * rng.uniform(0.2, 0.5)
        frame = (-width / 2, width / 2), (-thickness / 2, thickness / 2), (low, low + height)
        glass = tuple((a + bezel, b - bezel) for a, b in (frame[0], frame[2]))
        screen = [box(frame), box((glass[0], (-0.7 * thickness, 0.0), glass[1]))]
    if kind == "deep":
        depth = width * rng.uniform(0.5, 0.9)
        front, share = (0.98 * width, 0.98 * height), rng.uniform(0.4, 0.7)
        back = ring(share * width, share * height, depth, 0.8)
        tube_of_rays = loft([ring(*front, 0.0, 0.9), ring(*front, 0.4 * depth, 0.9), back])
        screen.append(tube_of_rays.turned(-np.pi / 2, axis=0).moved(centre))
    model.add(*(part.turned(-tilt, axis=0, pivot=centre) for part in screen))
    foot, rim = width * rng.uniform(0.4, 0.7), vary(rng, 0.03, 0.3)
    y = 0.4 * depth
    stand = rng.random()
    if kind == "deep" or stand < 0.6:
        round_foot = turned_profile([(foot, 0.0), (foot, rim)], rng.choice([0.0, 0.7]), 0.7)
        stem = [[0.0, y, rim / 2], [0.0, y + 0.03 * (depth == 0.0), low + 0.25 * height]]
        model.add(round_foot.moved([0.0, y, 0.0]), tube(stem, 0.2 * foot))
    elif stand < 0.8:
        for side in (-1, 1):
            feet = [[side * foot / 2, end * 0.3 * foot, 0.0] for end in (-1, 1)]
            model.add(tube([feet[0], [side * foot / 2, 0.0, low + 0.05], feet[1]], rim))
    else:
        wedge = [(0.6 * foot, rim / 2), (0.1 * foot, rim), (0.0, low + 0.3 * height)]
        model.add(slab(wedge, rim, (-foot / 3, foot / 3)))
    return model


def _apron(model: Model, width: float, depth: float, top: float, height: float) -> None:
    """Add four boards upright below a top."""
    x, y, board = width / 2, depth / 2, 0.025
    for side in (-1, 1):
        model.box((-x, x), (side * y, side * (y - board)), (top - height, top))
        model.box((side * x, side * (x - board)), (-y, y), (top - height, top))
