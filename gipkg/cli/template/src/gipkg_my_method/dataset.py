"""The dataset my-method: long and flat ellipsoids, generated."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np
import trimesh
from pydantic import Field

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.errors import DatasetNotFound

_AXES = {"flat": (1.0, 1.0, 0.3), "long": (0.5, 0.5, 2.0)}
_PER_CLASS = 10


class MyMethod(Dataset):
    """Ellipsoids of two classes, each with axes of its own.

    A database of files sets ``generated=False`` and names its files with their checksums;
    ``gipkg.datasets.shrec11`` is an example.
    """

    summary: ClassVar[str] = "long and flat ellipsoids"
    citation: ClassVar[str] = "Author, Title, Venue, Year"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True,
        shapes=len(_AXES) * _PER_CLASS,
        classes=len(_AXES),
        licence="CC0-1.0",
        source="generated from a seed",
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"MyMethod": Protocol(train_per_class=5)}

    seed: int = Field(0, ge=0, description="another seed gives other ellipsoids")

    def available(self, root: Path) -> bool:
        """Return True: nothing is read from files."""
        return True

    def fetch(self, root: Path) -> None:
        """Do nothing."""

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        """List the shapes, sorted by id."""
        return tuple(
            Shape(id=f"{label}-{number:02d}", label=label)
            for label in sorted(_AXES)
            for number in range(_PER_CLASS)
        )

    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh:
        """Make one ellipsoid (see :class:`gipkg.api.Dataset`)."""
        labels = {shape.id: shape.label for shape in self.shapes(root)}
        if shape_id not in labels:
            raise DatasetNotFound(f"my-method has no shape {shape_id!r}")
        # A generator of its own for each shape: they do not depend on the order of loading.
        rng = np.random.default_rng([self.seed, sorted(labels).index(shape_id)])
        ball = trimesh.creation.icosphere(subdivisions=2)
        axes = np.array(_AXES[labels[shape_id]]) * rng.uniform(0.8, 1.25, size=3)
        return trimesh.Trimesh(ball.vertices * axes, ball.faces, process=False)
