"""Starts are bijective, and differ as they say."""

from typing import get_args

import numpy as np
import pytest

from gipkg.api import SphericalMap
from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers.flow.starts import Start, start_map
from tests.support.shapes import needle, urchin

MESHES = {"urchin": urchin(12, 3.0, 3), "needle": needle()}


@pytest.mark.parametrize("start", get_args(Start))
@pytest.mark.parametrize("name", MESHES)
def test_every_start_is_bijective(name: str, start: Start) -> None:
    measured = distortion(SphericalMap(MESHES[name], start_map(MESHES[name], start)))
    assert measured.flips == 0
    assert measured.spherical_areas.sum() == pytest.approx(4 * np.pi, abs=1e-9)


def test_starts_differ_in_the_areas_they_aim_at() -> None:
    mesh = MESHES["urchin"]
    measured = {s: distortion(SphericalMap(mesh, start_map(mesh, s))) for s in get_args(Start)}
    uniform = measured["uniform"].spherical_areas * len(mesh.faces) / (4 * np.pi)
    assert np.std(uniform) < 0.3 < 3 * measured["hierarchy"].face_std
    for start in ("uniform", "squeezed", "conformal"):
        assert measured[start].vertex_std > 3 * measured["hierarchy"].vertex_std
