"""CALD as a whole: what it lowers, and what it does not promise."""

import numpy as np
import pytest

from gipkg.api import SphericalMap
from gipkg.datasets.shrec11 import Shrec11
from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers import parametrize
from gipkg.surfaces.validation import genus_zero_faults
from tests.support.shapes import ellipsoid, needle, urchin


@pytest.mark.parametrize("mesh", [ellipsoid(1, 1, 4), urchin(12, 2.0, 3), needle()])
def test_areas_even_out_on_the_way(mesh) -> None:
    told = []
    parametrize(mesh, "spharm", callback=told.append, iterations=30)
    assert [one.number for one in told] == list(range(31))
    assert told[0].step == 0
    assert told[-1].objective < told[0].objective / 10
    assert {one.step for one in told} <= {0, 0.25, 0.5, 1}


def test_the_objective_is_the_area_error_of_the_map_told() -> None:
    mesh = urchin(6, 1.0, 3)
    told = []
    parametrize(mesh, "spharm", iterations=3, callback=told.append)
    for one in told:
        measured = distortion(SphericalMap(mesh, one.sphere))
        ratio = measured.spherical_areas / measured.mesh_areas
        expected = np.average((ratio - 1) ** 2, weights=measured.mesh_areas)
        assert one.objective == pytest.approx(expected)


def test_a_higher_limit_of_lengths_leaves_less_area_error() -> None:
    errors = [
        distortion(parametrize(urchin(12, 2.0, 3), "spharm", length_limit=limit)).face_std
        for limit in (1.0, 3.0, 1e6)
    ]
    assert errors[0] > 1.5 * errors[1] > 1.5 * errors[2]


def test_from_the_bijective_start_nothing_flips_on_an_urchin() -> None:
    spherical_map = parametrize(urchin(12, 4.0), "spharm", start="hierarchy", iterations=30)
    assert distortion(spherical_map).flips == 0


def test_few_faces_flip_on_real_articulated_shapes(data_root) -> None:
    database = Shrec11()
    meshes = [database.load(data_root, shape.id) for shape in database.shapes(data_root)[::60]]
    measured = [
        distortion(parametrize(mesh, "spharm"))
        for mesh in meshes
        if not list(genus_zero_faults(mesh.vertices, mesh.faces))
    ]
    assert len(measured) >= 9
    assert all(one.degree == pytest.approx(1) for one in measured)
    assert max(one.flips for one in measured) < 0.03 * 500
    assert sum(one.flips for one in measured) < 0.005 * 500 * len(measured)
    assert np.median([one.face_std for one in measured]) < 0.6
