"""A network trained in a second on two kinds of ellipsoids, and a folder of such meshes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import trimesh

from gipkg.learning.config import TrainingConfig
from gipkg.learning.model import train_model
from gipkg.search.recipe import ImageMaker, Recipe
from tests.support.shapes import ellipsoid

SHAPES = {
    "needles/1": (1.0, 1.0, 3.0),
    "needles/2": (1.1, 1.0, 3.2),
    "plates/1": (2.0, 2.1, 0.7),
    "plates/2": (2.2, 2.0, 0.8),
}

RECIPE: dict[str, Any] = {
    "parametrizer": {"plugin": "authalic", "target": None, "parameters": {}},
    "descriptors": [
        {"plugin": "hks", "target": None, "parameters": {"times": 2}},
        {"plugin": "curvature", "target": None, "parameters": {"quantity": "mean"}},
    ],
    "eigenpairs": 30,
    "size": 40,
    "sampling": "equal-area",
}


def mesh(name: str) -> trimesh.Trimesh:
    """Return one of the shapes."""
    return ellipsoid(*SHAPES[name], subdivisions=2)


def write_meshes(folder: Path) -> None:
    """Write all shapes, as ``needles/1.off`` and so on."""
    for name in SHAPES:
        path = folder / f"{name}.off"
        path.parent.mkdir(parents=True, exist_ok=True)
        mesh(name).export(path, digits=17)


def write_network(path: Path, recipe: dict[str, Any] = RECIPE, seed: int = 0) -> None:
    """Train a network on all shapes and write it as rule ``learn`` does."""
    maker = ImageMaker.of(Recipe.model_validate(RECIPE))
    images = {name: maker.images(mesh(name)) for name in SHAPES}
    labels = {name: name.partition("/")[0] for name in SHAPES}
    training = TrainingConfig(minimum_steps=20, epochs=1, batch_size=16)
    model = train_model(images, labels, tuple(SHAPES), training=training, seed=seed, device="cpu")
    model.save(path, about={"images": recipe})
