"""Chairs and sofas."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from gipkg.datasets.furniture.model import Model
from gipkg.datasets.furniture.parts import (
    Part,
    Points,
    sheet,
    slab,
    tube,
    turned_profile,
)
from gipkg.datasets.furniture.supports import bun_feet, column, four_legs
from gipkg.datasets.proportions import vary


def chairs(rng: np.random.Generator) -> Model:
    """Make a chair: a seat on legs, runners or a star, a back of many kinds, often arms."""
    model = Model()
    width, depth = vary(rng, 0.46, 0.2), vary(rng, 0.45, 0.15)
    seat = vary(rng, 0.45, 0.12) * rng.choice([1.0, 1.0, 1.0, 1.5])
    cushion, leg = vary(rng, 0.05, 0.6), vary(rng, 0.045, 0.3)
    under = seat - cushion
    kind = rng.choice(["legs", "star", "runners"], p=[0.6, 0.2, 0.2])
    if kind == "legs":
        four_legs(model, rng, width, depth, under, leg, rungs=0.55)
    elif kind == "star":
        column(model, rng, 1.2 * width, under)
    else:
        _runners(model, rng, width, depth, under, leg)
    if rng.random() < 0.7:
        model.box((-width / 2, width / 2), (-depth / 2, depth / 2), (under, seat))
    else:
        round_seat = turned_profile([(width, under), (width, seat)], rng.choice([0.0, 0.5]))
        model.add(round_seat)
    back = _back_curve(rng, depth, under, vary(rng, 0.5, 0.3))
    _back(model, rng, back, width, leg)
    if rng.random() < 0.4:
        _arms(model, rng, width + leg, depth, seat, leg)
    return model


def sofas(rng: np.random.Generator) -> Model:
    """Make a sofa: a base, a back, arms and cushions for one to four, some with a long end."""
    model = Model()
    places = int(rng.choice([1, 2, 3, 4], p=[0.25, 0.35, 0.3, 0.1]))
    width, depth = places * vary(rng, 0.65, 0.15), vary(rng, 0.85, 0.15)
    foot, seat = rng.uniform(0.0, 0.16), vary(rng, 0.42, 0.12)
    arm, rest = vary(rng, 0.17, 0.5), seat + vary(rng, 0.2, 0.5)
    cushion, thick = vary(rng, 0.14, 0.3), vary(rng, 0.22, 0.3)
    half, front, back = width / 2, -depth / 2, depth / 2
    if foot > 0.03:
        bun_feet(model, width, depth, foot, vary(rng, 0.07, 0.3))
    else:
        foot = 0.0
    model.box((-half, half), (front, back), (foot, seat - cushion))
    for place in range(places):
        x = -half + width * place / places + 0.01, -half + width * (place + 1) / places - 0.01
        model.box(x, (front - 0.02, back - thick), (seat - cushion, seat))
    lean = rng.uniform(0.0, 0.25)
    top = seat + vary(rng, 0.42, 0.25)
    curve = [(back - thick / 2, foot), (back - thick / 2, seat), (back - thick / 2 + lean, top)]
    model.add(slab(curve, thick, (-half, half)))
    if rng.random() < 0.85:
        rolled = rng.random() < 0.35
        for side in (-1, 1):
            if side > 0 and rng.random() < 0.08:
                continue
            model.box((side * half, side * (half + arm)), (front, back), (foot, rest))
            if rolled:
                middle = side * (half + arm / 2)
                roll = [[middle, front - 0.02, rest], [middle, back, rest]]
                model.add(tube(roll, 1.4 * arm, corners=14))
    if places > 1 and rng.random() < 0.25:
        side = rng.choice([-1, 1])
        x = side * half, side * (half - width / places)
        model.box(x, (front - vary(rng, 0.7, 0.2), front), (foot, seat))
    return model


def _back_curve(rng: np.random.Generator, depth: float, seat: float, rise: float) -> Points:
    """Return the side view of a back, from below the seat, as y and z: raked and bent."""
    along = np.linspace(0.0, 1.0, 6)
    rake, bend = rng.uniform(0.0, 0.3), rng.uniform(-0.05, 0.1)
    y = depth / 2 - 0.02 + rise * (rake * along + bend * np.sin(np.pi * along))
    return np.stack([y, seat + rise * along], axis=1)


def _back(model: Model, rng: np.random.Generator, curve: Points, width: float, post: float) -> None:
    """Add a back: a board, a bare sheet, upright or level bars in a frame, or a hoop."""
    kind = rng.choice(
        ["board", "sheet", "spindles", "ladder", "hoop"], p=[0.3, 0.12, 0.24, 0.22, 0.12]
    )
    half, thin = width / 2 - post / 2, 0.6 * post

    def at(x: float, share: float) -> list[float]:
        along = np.linspace(0.0, 1.0, len(curve))
        return [x, *(float(np.interp(share, along, one)) for one in curve.T)]

    if kind == "board":
        model.add(slab(curve[rng.integers(0, 3) :], post, (-half, half)))
        model.add(*(_post(curve, x, thin) for x in (-half / 2, half / 2)))
        return
    if kind == "hoop":
        angle = np.linspace(0.0, np.pi, 15)
        model.add(tube([at(half * np.cos(one), np.sin(one)) for one in angle], post))
    else:
        model.add(*(_post(curve, x, post) for x in (-half, half)))
    if kind == "sheet":
        model.add(
            sheet([[at(x, share) for x in (-half, half)] for share in np.linspace(0.2, 1, 6)])
        )
    elif kind == "ladder":
        for share in np.linspace(0.3, 1.0, int(rng.integers(2, 6))):
            low, high = at(0.0, share - 0.06), at(0.0, share)
            model.add(slab([low[1:], high[1:]], thin, (-half, half)))
    else:
        for x in np.linspace(-half, half, int(rng.integers(3, 7)) + 2)[1:-1]:
            top = np.sqrt(1 - (x / half) ** 2) if kind == "hoop" else 1.0
            model.add(tube([at(x, share * top) for share in (0.0, 0.5, 1.0)], thin))
    if kind in ("spindles", "sheet"):
        model.add(tube([at(-half, 1.0), at(half, 1.0)], 1.3 * post))


def _post(curve: Points, x: float, thickness: float) -> Part:
    return tube(np.column_stack([np.full(len(curve), x), curve]), thickness)


def _arms(
    model: Model, rng: np.random.Generator, width: float, depth: float, seat: float, post: float
) -> None:
    """Add a level bar on an upright on either side."""
    rise, reach = vary(rng, 0.22, 0.2), depth * rng.uniform(0.3, 0.5)
    for side in (-1, 1):
        x = side * width / 2
        knee = [x, -reach, seat + rise]
        model.add(tube([[x, -reach, seat - post], knee], post))
        model.add(tube([knee, [x, depth / 2 + 0.03, seat + rise]], 1.2 * post))


def _runners(
    model: Model, rng: np.random.Generator, width: float, depth: float, seat: float, bar: float
) -> None:
    """Add two bent tubes that lie on the floor: closed loops, or open behind as a cantilever."""
    closed = rng.random() < 0.5
    for side in (-1, 1):
        x, front, back = side * (width / 2 - bar), -depth / 2 + bar, depth / 2 - bar
        path = [[x, back, seat], [x, front, seat], [x, front, bar / 2], [x, back, bar / 2]]
        if closed:
            path.append([x, back, seat])
        for first, second in pairwise(path):
            model.add(tube([first, second], bar))
    across = [
        [-width / 2 + bar, depth / 2 - bar, bar / 2],
        [width / 2 - bar, depth / 2 - bar, bar / 2],
    ]
    model.add(tube(across, bar))
