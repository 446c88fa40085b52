"""What the paper's flow and Lie advection do to whole meshes."""

import numpy as np
import pytest

from gipkg.datasets.tosca import Tosca
from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers import parametrize
from gipkg.surfaces import prepare
from gipkg.testing import meshes
from tests.support.shapes import needle, urchin


@pytest.mark.parametrize("start", ["hierarchy", "uniform", "squeezed", "conformal"])
def test_the_flow_ends_near_equal_areas_from_any_start(start: str) -> None:
    measured = distortion(parametrize(meshes.limbed(), "authalic-flow", start=start))
    assert measured.flips == 0
    assert measured.vertex_std < 0.05
    assert measured.face_std < 0.15


@pytest.mark.parametrize("mesh", [urchin(12, 6.0), needle()], ids=["urchin", "needle"])
def test_the_guard_lowers_distortion_in_every_iteration_without_a_flip(mesh) -> None:
    seen = []
    spherical_map = parametrize(
        mesh, "authalic-flow", start="uniform", iterations=30, callback=seen.append
    )
    assert distortion(spherical_map).flips == 0
    assert [one.number for one in seen] == list(range(len(seen)))
    assert np.all(np.diff([one.objective for one in seen]) < 0)
    assert all(0 < one.step <= 1 for one in seen[1:])


def test_the_printed_step_depends_on_the_resolution_and_the_consistent_one_does_not() -> None:
    def course(subdivisions: int, **parameters) -> tuple[np.ndarray, int]:
        seen = []
        mesh = meshes.ellipsoid((1.0, 1.0, 2.0), subdivisions)
        spherical_map = parametrize(
            mesh, "authalic-flow", start="squeezed", guard=False, step=0.01, callback=seen.append,
            **parameters,
        )  # fmt: skip
        objectives = np.array([one.objective for one in seen])
        return objectives / objectives[0], distortion(spherical_map).flips

    (few, no_flips), (many, flips) = (course(n, right_hand_side="ratio") for n in (3, 4))
    assert no_flips == 0 < flips
    assert few[-1] < few[10] < 0.01 < many[10] < many[-1]
    (few, _), (many, flips) = (course(n) for n in (3, 4))
    assert flips == 0
    # A hundred steps of 0.01 are one unit of time: the mean square falls by e² and more.
    assert max(few[-1], many[-1]) < np.exp(-2)
    np.testing.assert_allclose(few, many, atol=0.02)


def test_without_the_guard_faces_flip_and_are_returned() -> None:
    spherical_map = parametrize(
        urchin(12, 6.0), "authalic-flow", start="squeezed", step=0.05, guard=False
    )
    assert distortion(spherical_map).flips > 0


def test_a_pseudo_inverse_of_low_rank_still_evens_out_what_is_smooth() -> None:
    mesh = meshes.limbed()
    exact, low = (
        distortion(parametrize(mesh, "authalic-flow", start="squeezed", rank=rank)).vertex_std
        for rank in (None, 50)
    )
    assert exact < low < 0.5


def test_lie_advection_evens_out_what_its_triangulation_resolves() -> None:
    mesh = meshes.ellipsoid(subdivisions=4)
    seen = []
    start = parametrize(mesh, "authalic-flow", start="squeezed", iterations=0)
    measured = distortion(
        parametrize(mesh, "lie-advection", start="squeezed", callback=seen.append)
    )
    assert measured.vertex_std < 0.1 * distortion(start).vertex_std
    assert len(seen) == 101
    assert seen[-1].objective < 0.05 * seen[0].objective


def test_lie_advection_flips_faces_on_limbs_and_returns_them() -> None:
    measured = distortion(parametrize(urchin(12, 6.0), "lie-advection", start="conformal"))
    assert measured.flips > 0
    assert measured.degree == pytest.approx(1, abs=1e-9)


def test_the_flow_on_real_articulated_shapes(data_root) -> None:
    database = Tosca()
    for shape in ("wolf0", "david0"):
        mesh = prepare(database.load(data_root, shape)).mesh
        start = distortion(parametrize(mesh, "authalic-flow", iterations=0))
        measured = distortion(parametrize(mesh, "authalic-flow"))
        assert measured.flips == 0
        assert measured.face_std < 0.85 * start.face_std
        assert measured.variance < start.variance
