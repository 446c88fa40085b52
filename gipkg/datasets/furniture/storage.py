"""Dressers and night stands: blocks of drawers and shelves."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import Span, sheet, slab, turned_profile
from gipkg.datasets.furniture.supports import bun_feet, four_legs
from gipkg.datasets.proportions import vary


def dressers(rng: np.random.Generator) -> Model:
    """Make a dresser: many drawers in rows and columns, on feet, often with a mirror."""
    model = Model()
    width, depth, height = vary(rng, 1.2, 0.35), vary(rng, 0.5, 0.15), vary(rng, 0.95, 0.3)
    foot = _base(model, rng, width, depth, rng.uniform(0.0, 0.18))
    columns = int(rng.integers(1, 4)) if width > 0.9 * height else int(rng.integers(1, 3))
    half, y = width / 2, (-depth / 2, depth / 2)
    drawers(
        model, rng, (-half, half), y, (foot, height), rows=int(rng.integers(3, 6)), columns=columns
    )
    _top(model, rng, width, depth, height)
    if rng.random() < 0.35:
        _mirror(model, rng, width, depth / 2, height)
    return model


def night_stands(rng: np.random.Generator) -> Model:
    """Make a night stand: one to three drawers, or a shelf below one, on legs or on the floor."""
    model = Model()
    width, depth = vary(rng, 0.5, 0.25), vary(rng, 0.42, 0.15)
    height = width * rng.uniform(0.9, 1.5)
    half, y = width / 2, (-depth / 2, depth / 2)
    kind = rng.random()
    if kind < 0.35:
        low = height * rng.uniform(0.3, 0.7)
        four_legs(model, rng, width, depth, low, vary(rng, 0.045, 0.3), rungs=0.3)
        drawers(model, rng, (-half, half), y, (low, height), rows=int(rng.integers(1, 3)))
    elif kind < 0.65:
        foot = _base(model, rng, width, depth, rng.uniform(0.0, 0.15))
        middle = foot + (height - foot) * rng.uniform(0.4, 0.65)
        shelves(model, (-half, half), y, (foot, middle), 1, vary(rng, 0.03, 0.2))
        drawers(model, rng, (-half, half), y, (middle, height), rows=1)
    else:
        foot = _base(model, rng, width, depth, rng.uniform(0.0, 0.2))
        drawers(model, rng, (-half, half), y, (foot, height), rows=int(rng.integers(1, 4)))
    _top(model, rng, width, depth, height)
    return model


def drawers(
    model: Model,
    rng: np.random.Generator,
    x: Span,
    y: Span,
    z: Span,
    rows: int,
    columns: int = 1,
) -> None:
    """Add a block with the fronts of drawers on it; a front may be pulled out."""
    model.box(x, y, z)
    gap = 0.06 * (z[1] - z[0]) / rows
    proud = vary(rng, 0.02, 0.5)
    across, up = np.linspace(*x, columns + 1), np.linspace(*z, rows + 1)
    knob = rng.choice(["none", "round", "bar"])
    for row in range(rows):
        for column in range(columns):
            span = across[column] + gap, across[column + 1] - gap
            levels = up[row] + gap, up[row + 1] - gap
            out = rng.uniform(0.1, 0.4) * (y[1] - y[0]) if rng.random() < 0.04 else proud
            model.box(span, (y[0] - out, y[0]), levels)
            _handle(model, knob, span, y[0] - out, levels)


def _handle(model: Model, kind: str, x: Span, front: float, z: Span) -> None:
    middle, level = sum(x) / 2, sum(z) / 2
    size = 0.12 * min(x[1] - x[0], z[1] - z[0])
    if kind == "round":
        ball = turned_profile(
            [(0.5 * size, 0.0), (1.5 * size, size), (0.5 * size, 2 * size)], 0, 1, 8
        )
        model.add(ball.turned(np.pi / 2, axis=0).moved([middle, front, level]))
    elif kind == "bar":
        model.box(
            (middle - 3 * size, middle + 3 * size), (front - size, front), (level, level + size)
        )


def shelves(model: Model, x: Span, y: Span, z: Span, number: int, board: float) -> None:
    """Add a case that is open in front: two walls, a back, a top, and shelves at even heights."""
    for wall in ((x[0], x[0] + board), (x[1] - board, x[1])):
        model.box(wall, y, z)
    model.box(x, (y[1] - board / 2, y[1]), z)
    for level in np.linspace(*z, number + 1):
        low = min(level, z[1] - board)
        model.box(x, y, (low, low + board))


def _base(
    model: Model, rng: np.random.Generator, width: float, depth: float, height: float
) -> float:
    """Add feet or a plinth; return how high they are."""
    if height < 0.03:
        return 0.0
    if rng.random() < 0.6:
        bun_feet(model, width, depth, height, vary(rng, 0.07, 0.3))
    else:
        x, y = 0.47 * width, 0.45 * depth
        model.box((-x, x), (-y, y), (0.0, height))
    return height


def _top(model: Model, rng: np.random.Generator, width: float, depth: float, height: float) -> None:
    """Add a board that juts out a little."""
    over, board = rng.uniform(0.0, 0.03), vary(rng, 0.025, 0.3)
    x, y = width / 2 + over, depth / 2 + over
    model.box((-x, x), (-y, depth / 2), (height, height + board))


def _mirror(
    model: Model, rng: np.random.Generator, width: float, back: float, height: float
) -> None:
    """Add a mirror at the back: framed, or a bare sheet, or round."""
    half, rise, board = width * rng.uniform(0.3, 0.48), vary(rng, 0.8, 0.25), 0.04
    kind = rng.random()
    if kind < 0.4:
        bent = [(back - board, height), (back - board, height + rise)]
        model.add(slab(bent, board, (-half, half)))
    elif kind < 0.75:
        disc = turned_profile([(2 * half, 0.0), (2 * half, board)], 0.0, rise / (2 * half), 24)
        upright = disc.turned(np.pi / 2, axis=0)
        model.add(upright.moved([0.0, back, height + 0.49 * rise]))
    else:
        y, top = back - board / 2, height + rise
        frame = ((-half, half), (top - board, top)), ((-half, board - half), (height, top))
        for x, z in (*frame, ((half - board, half), (height, top))):
            model.box(x, (back - board, back), z)
        model.add(sheet([[[x, y, z] for x in (-half, half)] for z in (height, top)]))
