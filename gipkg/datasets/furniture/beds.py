"""Beds."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import loft, tube, turned_profile
from gipkg.datasets.furniture.supports import bun_feet
from gipkg.datasets.proportions import vary


def beds(rng: np.random.Generator) -> Model:
    """Make a bed: a mattress on a frame, a head of many kinds, often a foot, pillows, a canopy."""
    model = Model()
    width, length = rng.choice([0.95, 1.45, 1.8]) * rng.uniform(0.93, 1.07), vary(rng, 2.0, 0.07)
    low, frame, mattress = rng.uniform(0.0, 0.3), vary(rng, 0.12, 0.4), vary(rng, 0.2, 0.35)
    half, head, foot = width / 2, length / 2, -length / 2
    if low > 0.05:
        bun_feet(model, width, length, low, vary(rng, 0.09, 0.3))
    else:
        low = 0.0
    deck = low + frame
    top = deck + mattress
    model.box((-half, half), (foot, head), (low, deck))
    model.box((0.03 - half, half - 0.03), (foot + 0.03, head - 0.03), (deck, top))
    board = vary(rng, 0.06, 0.4)
    _end(model, rng, half, head + board / 2, top + vary(rng, 0.45, 0.4), board)
    if rng.random() < 0.5:
        _end(model, rng, half, foot - board / 2, top + rng.uniform(-0.1, 0.25), board)
    if rng.random() < 0.75:
        _pillows(model, rng, width, head, top)
    if rng.random() < 0.12:
        _canopy(model, rng, half, head, vary(rng, 2.0, 0.1), board)
    return model


def _end(
    model: Model, rng: np.random.Generator, half: float, y: float, top: float, board: float
) -> None:
    """Add a head or a foot: a board, an arched one, or bars between two posts."""
    kind = rng.choice(["board", "arch", "bars"], p=[0.5, 0.25, 0.25])
    if kind == "board":
        model.box((-half, half), (y - board / 2, y + board / 2), (0.0, top))
        return
    if kind == "arch":
        across = np.linspace(-half, half, 13)
        heights = top * (1 - rng.uniform(0.1, 0.35) * (across / half) ** 2)
        front, back = y - board / 2, y + board / 2
        model.add(
            loft(
                [
                    np.array([[x, front, 0.0], [x, back, 0.0], [x, back, z], [x, front, z]])
                    for x, z in zip(across, heights, strict=True)
                ]
            )
        )
        return
    for side in (-1, 1):
        x = side * (half - board / 2)
        model.add(tube([[x, y, 0.0], [x, y, top]], 1.3 * board))
    levels = (0.45 * top, top - board)
    for level in levels:
        model.add(tube([[-half, y, level], [half, y, level]], board))
    for x in np.linspace(-half, half, int(rng.integers(3, 8)) + 2)[1:-1]:
        model.add(tube([[x, y, levels[0]], [x, y, levels[1]]], 0.7 * board))


def _pillows(model: Model, rng: np.random.Generator, width: float, head: float, top: float) -> None:
    number = 1 if width < 1.2 else 2
    size, thickness = 0.8 * width / number, vary(rng, 0.12, 0.3)
    profile = [(0.5 * size, 0.0), (size, thickness / 2), (0.5 * size, thickness)]
    pillow = turned_profile(profile, 0.6, min(1.0, 0.45 / size))
    for place in range(number):
        x = width * ((place + 0.5) / number - 0.5)
        model.add(pillow.moved([x, head - 0.32, top - 0.02]))


def _canopy(
    model: Model, rng: np.random.Generator, half: float, head: float, top: float, post: float
) -> None:
    """Add four posts and what joins their ends: bars, or a roof."""
    corners = [(-half, -head), (half, -head), (half, head), (-half, head)]
    for number, (x, y) in enumerate(corners):
        model.add(tube([[x, y, 0.0], [x, y, top]], 1.2 * post))
        following = corners[(number + 1) % 4]
        model.add(tube([[x, y, top], [*following, top]], post))
    if rng.random() < 0.4:
        model.box((-half, half), (-head, head), (top, top + post))
