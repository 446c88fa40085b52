"""A piece of furniture in the making, and the two ways it is finished: as a solid or as a soup."""

from __future__ import annotations

import numpy as np

from gipkg.datasets.furniture.parts import Box, Part, Span, box, unite

OPENED, DOUBLED, TURNED = 0.15, 0.1, 0.1
"""Share of the parts of a soup that lack a side, are there twice, or are inside out."""
FLIPPED = 0.03
"""Largest share of single faces that are flipped in a soup."""


class Model:
    """Boxes and other parts, in metres, the z axis upright and the front towards -y."""

    def __init__(self) -> None:
        self.boxes: list[Box] = []
        self.parts: list[Part] = []

    def box(self, x: Span, y: Span, z: Span) -> None:
        """Add a box, given by its two ends along each axis, in any order."""
        (x0, x1), (y0, y1), (z0, z1) = sorted(x), sorted(y), sorted(z)
        self.boxes.append(((x0, x1), (y0, y1), (z0, z1)))

    def add(self, *parts: Part) -> None:
        """Add parts of any other form."""
        self.parts += parts

    def solid(self) -> Part:
        """Return the model with its boxes united to one solid; other parts overlap it."""
        return _joined([*([unite(self.boxes)] if self.boxes else []), *self.parts])

    def soup(self, rng: np.random.Generator) -> Part:
        """Return the model as modellers leave it: parts that overlap, some open or inside out."""
        parts = []
        for part in [*map(box, self.boxes), *self.parts]:
            faces = part.faces
            if rng.random() < OPENED:
                side = 2 * rng.integers(len(faces) // 2)
                faces = np.delete(faces, [side, side + 1], axis=0)
            if rng.random() < TURNED:
                faces = faces[:, ::-1]
            if rng.random() < DOUBLED:
                faces = np.concatenate([faces, faces[:, ::-1]])
            parts.append(Part(part.vertices, faces))
        soup = _joined(parts)
        flipped = rng.random(len(soup.faces)) < rng.uniform(0.0, FLIPPED)
        return Part(soup.vertices, np.where(flipped[:, None], soup.faces[:, ::-1], soup.faces))


def _joined(parts: list[Part]) -> Part:
    first = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, first[:-1], strict=True)]
    return Part(np.concatenate([part.vertices for part in parts]), np.concatenate(faces))
