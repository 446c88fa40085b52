import numpy as np
import pytest

from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers import parametrize
from gipkg.testing.parametrizers import stretch_ratios
from tests.support.shapes import ellipsoid, icosphere, needle, urchin


def test_a_sphere_stays_a_sphere() -> None:
    mapped = parametrize(icosphere(3), "penalty")
    assert distortion(mapped).face_std < 0.02
    assert np.median(stretch_ratios(mapped.sphere, mapped.mesh)) < 1.05


def test_the_weight_trades_angles_for_areas() -> None:
    mesh = ellipsoid(1, 1, 2)
    maps = [parametrize(mesh, "penalty", area_weight=weight) for weight in (0.0, 0.5, 0.99)]
    areas = [distortion(mapped).face_std for mapped in maps]
    angles = [np.average(stretch_ratios(m.sphere, mesh), weights=mesh.area_faces) for m in maps]
    assert areas[0] > 2 * areas[1] > 8 * areas[2]
    assert angles[0] < angles[1] < angles[2]


@pytest.mark.parametrize("mesh", [ellipsoid(1, 1, 20), urchin(12, 6.0), needle()])
def test_the_degree_stays_1_on_hard_shapes(mesh) -> None:
    told = []
    measured = distortion(parametrize(mesh, "penalty", callback=told.append))
    assert measured.degree == pytest.approx(1, abs=1e-9)
    assert told[-1].objective < told[0].objective
    assert len(told) <= 101
