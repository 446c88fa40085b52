"""Every perturbation does what it says, and its surface can be prepared again."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces.perturbations import PERTURBATIONS, perturb
from gipkg.surfaces.report import count
from tests.support.shapes import icosphere, urchin
from tests.surfaces.solids import assert_genus_zero

STRENGTHS = {
    "noise": (0.1, 0.4),
    "remesh": (0.25, 0.5, 2.0),
    "holes": (0.02, 0.1),
    "shortcut": (1, 4),
    "missing": (0.05, 0.2),
}
URCHIN = urchin(6, 2.0, subdivisions=3)


def apply(name: str, mesh: trimesh.Trimesh, strength: float, seed: int = 0) -> trimesh.Trimesh:
    before = mesh.vertices.copy(), mesh.faces.copy()
    done = PERTURBATIONS[name].apply(mesh, strength, np.random.default_rng(seed))
    assert np.array_equal(mesh.vertices, before[0])
    assert np.array_equal(mesh.faces, before[1])
    return done


def topology(mesh: trimesh.Trimesh) -> tuple[int, int, int | None]:
    found = count(np.asarray(mesh.vertices), np.asarray(mesh.faces))
    return found.components, found.holes, found.genus


def test_every_perturbation_is_tested() -> None:
    assert set(STRENGTHS) == set(PERTURBATIONS)


@pytest.mark.parametrize(
    ("name", "strength"), [(name, one) for name, many in STRENGTHS.items() for one in many]
)
def test_the_prepared_surface_is_closed_and_of_genus_0(name: str, strength: float) -> None:
    surface = perturb(URCHIN, name, strength, seed=0, shape_id="urchin")
    assert_genus_zero(surface.mesh)
    again = perturb(URCHIN, name, strength, seed=0, shape_id="urchin")
    assert np.array_equal(surface.mesh.vertices, again.mesh.vertices)
    assert np.array_equal(surface.mesh.faces, again.mesh.faces)
    other = perturb(URCHIN, name, strength, seed=0, shape_id="another")
    assert not np.array_equal(surface.mesh.vertices, other.mesh.vertices)


def test_a_perturbed_surface_is_prepared_as_its_database_is() -> None:
    options = {"method": "volume", "resolution": 30, "vertices": 200, "smallest_part": 1.0}
    surface = perturb(URCHIN, "missing", 0.1, seed=0, shape_id="urchin", options=options)
    assert surface.report.method == "volume"
    assert len(surface.mesh.vertices) <= 200
    assert_genus_zero(surface.mesh)
    with pytest.raises(UnsupportedMesh, match="handle"):
        perturb(
            *(URCHIN, "shortcut", 3),
            seed=0,
            shape_id="urchin",
            options={"method": "repair", "most_handles": 0},
        )


@settings(max_examples=10)
@given(st.floats(0.01, 0.5), st.integers(0, 99))
def test_noise_has_the_deviation_asked_for(strength: float, seed: int) -> None:
    ball = icosphere(4)
    moved = apply("noise", ball, strength, seed).vertices - ball.vertices
    assert moved.std() == pytest.approx(strength * ball.edges_unique_length.mean(), rel=0.05)
    assert np.abs(moved.mean(axis=0)).max() < 0.1 * moved.std()


@settings(max_examples=10)
@given(st.sampled_from([0.25, 0.5, 1.0, 2.0, 3.0]), st.integers(0, 99))
def test_remeshing_changes_the_triangles_and_not_the_surface(strength: float, seed: int) -> None:
    ball = icosphere(3)
    other = apply("remesh", ball, strength, seed)
    assert len(other.vertices) == np.ceil(strength * len(ball.vertices))
    assert topology(other) == (1, 0, 0)
    before = set(map(tuple, ball.vertices.tolist()))
    assert len(before.intersection(map(tuple, other.vertices.tolist()))) < 0.05 * len(before)
    assert np.linalg.norm(other.vertices, axis=1) == pytest.approx(1, abs=0.05)
    assert other.volume == pytest.approx(ball.volume, rel=0.03)


@settings(max_examples=10)
@given(st.floats(0.01, 0.3), st.integers(0, 99))
def test_missing_is_one_region_of_the_share_asked_for(share: float, seed: int) -> None:
    ball = icosphere(4)
    rest = apply("missing", ball, share, seed)
    assert rest.area / ball.area == pytest.approx(1 - share, abs=2 / len(ball.faces))
    rest.remove_unreferenced_vertices()
    assert topology(rest)[:2] == (1, 1)


def test_holes_are_small_and_many() -> None:
    ball = icosphere(4)
    rest = apply("holes", ball, 0.04)
    assert 1 - rest.area / ball.area == pytest.approx(0.04, rel=0.1)
    rest.remove_unreferenced_vertices()
    assert 5 <= topology(rest)[1] <= 8


@settings(max_examples=10)
@given(st.integers(1, 3), st.integers(0, 99))
def test_a_shortcut_is_a_handle(number: int, seed: int) -> None:
    joined = apply("shortcut", URCHIN, number, seed)
    joined.remove_unreferenced_vertices()
    assert topology(joined) == (1, 0, number)


def test_a_shortcut_joins_what_is_near_in_space() -> None:
    """Two balls on a bent rod nearly touch; the tube goes from one to the other."""
    arch = urchin(1, 0.0, subdivisions=4)
    turn = np.pi * 0.97 * np.asarray(arch.vertices[:, 2])
    reach = 2 + 0.4 * arch.vertices[:, 0]
    bent = np.column_stack((reach * np.cos(turn), reach * np.sin(turn), 0.4 * arch.vertices[:, 1]))
    ring = trimesh.Trimesh(bent, arch.faces, process=False)
    joined = apply("shortcut", ring, 1)
    removed = np.setdiff1d(np.arange(len(bent)), joined.faces)
    assert len(removed) == 2
    assert np.abs(turn[removed]).min() > 0.8 * np.pi
    assert turn[removed].prod() < 0


def test_stronger_strikes_at_the_same_places() -> None:
    for name in ("missing", "holes"):
        weak, strong = (apply(name, URCHIN, one) for one in (0.05, 0.1))
        kept = {tuple(face) for face in strong.faces.tolist()}
        assert kept < {tuple(face) for face in weak.faces.tolist()}
