import numpy as np
import pytest

from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers import parametrize
from tests.support.shapes import ellipsoid, icosphere, urchin


def test_a_sphere_stays_a_sphere() -> None:
    assert distortion(parametrize(icosphere(3), "optimal-transport")).face_std < 0.05


@pytest.mark.parametrize("mesh", [ellipsoid(1, 1, 4), urchin(12, 3.0, subdivisions=3)])
def test_cells_get_their_areas_and_faces_come_nearer_to_theirs(mesh) -> None:
    told = []
    transported = parametrize(mesh, "optimal-transport", callback=told.append)
    conformal = parametrize(mesh, "conformal")
    np.testing.assert_array_equal(told[0].sphere, conformal.sphere)
    assert told[-1].objective <= 1e-6
    before, after = distortion(conformal), distortion(transported)
    assert after.vertex_std < before.vertex_std / 3
    assert after.degree == pytest.approx(1, abs=1e-9)


def test_it_stops_after_the_iterations_allowed() -> None:
    told = []
    parametrize(ellipsoid(1, 1, 4), "optimal-transport", max_iterations=2, callback=told.append)
    assert [iteration.number for iteration in told] == [0, 1, 2]
