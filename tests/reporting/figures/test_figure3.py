"""Figure 3 follows a method from its start to its end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
import trimesh
from PIL import Image

from gipkg.api import Callback, Iteration, Parametrizer, ParametrizerTags, SphericalMap
from gipkg.errors import InvalidParameterError
from gipkg.evaluation.distortion import distortion
from gipkg.reporting.figures import figure3
from gipkg.reporting.figures.layout import write_png

LAST = 12


class Shrinking(Parametrizer):
    """Moves an uneven map of an ellipsoid in equal steps to the one it was made of."""

    summary: ClassVar[str] = "steps between two maps"
    citation: ClassVar[str] = "none"
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    def parametrize(self, mesh: trimesh.Trimesh, callback: Callback | None = None) -> np.ndarray:
        end = np.asarray(mesh.vertices) / [1, 1, 2]
        sphere = end.copy()
        for number in range(LAST + 1):
            # One buffer for all iterations: who keeps a sphere has to copy it.
            sphere[:] = end + np.array([0, 0, 0.7 * (LAST - number) / LAST])
            sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
            if callback:
                callback(Iteration(number, sphere, objective=LAST - number, step=number / LAST))
        return sphere


@pytest.fixture(scope="module")
def body() -> trimesh.Trimesh:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    return trimesh.Trimesh(sphere.vertices * [1, 1, 2], sphere.faces, process=False)


@pytest.fixture(scope="module")
def progress(body: trimesh.Trimesh) -> figure3.Progress:
    return figure3.record("shrinking", Shrinking(), body, shown=4)


def test_every_iteration_is_a_row(body: trimesh.Trimesh, progress: figure3.Progress) -> None:
    assert [step.iteration for step in progress.steps] == list(range(LAST + 1))
    assert [step.objective for step in progress.steps] == list(range(LAST, -1, -1))
    assert [step.step for step in progress.steps] == [k / LAST for k in range(LAST + 1)]
    for index, sphere in progress.spheres.items():
        measured = asdict(distortion(SphericalMap(body, sphere)))
        for name in ("variance", "face_std", "vertex_std", "flips"):
            assert getattr(progress.steps[index], name) == measured[name]
    variances = [step.variance for step in progress.steps]
    assert variances == sorted(variances, reverse=True)


def test_the_first_the_last_and_some_between_are_shown(progress: figure3.Progress) -> None:
    assert list(progress.spheres) == [0, 1, 3, 12]


@pytest.mark.parametrize(
    ("shown", "expected"), [(2, [0, 12]), (13, list(range(13))), (99, list(range(13)))]
)
def test_as_many_are_shown_as_asked_for(
    body: trimesh.Trimesh, shown: int, expected: Sequence[int]
) -> None:
    assert list(figure3.record("x", Shrinking(), body, shown).spheres) == expected


def test_a_method_that_reports_nothing_is_refused(body: trimesh.Trimesh) -> None:
    class Silent(Shrinking):
        def parametrize(
            self, mesh: trimesh.Trimesh, callback: Callback | None = None
        ) -> np.ndarray:
            return super().parametrize(mesh)

    with pytest.raises(InvalidParameterError, match=r"quiet.*iterative"):
        figure3.record("quiet", Silent(), body, shown=3)


def test_spheres_fade_as_areas_become_even(
    body: trimesh.Trimesh, progress: figure3.Progress, tmp_path: Path
) -> None:
    write_png(tmp_path / "figure.png", figure3.draw(body, [progress], size=24))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(float)
    height, width = drawn.shape[:2]
    pictures = round(width * 4 * 1.7 / (4 * 1.7 + 4))
    upper = np.ptp(drawn, axis=2)[: height // 2, :pictures]
    colourful = [part.mean() for part in np.array_split(upper, 4, axis=1)]
    assert colourful == sorted(colourful, reverse=True)
    assert colourful[0] > 2 * colourful[-1]
