"""Barycentric transfer: where vertices go, and that the careful way keeps its promises."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.parametrizers.flow.authalic import AreaFlow
from gipkg.parametrizers.flow.linear_elements import LinearElements
from gipkg.parametrizers.flow.transfer import carry_all, carry_carefully, destinations
from gipkg.parametrizers.sphere.areas import (
    flipped_faces,
    mean_square_distortion,
    signed_spherical_areas,
)
from gipkg.surfaces.areas import at_vertices
from gipkg.surfaces.halfedges import corners_by_vertex
from tests.support.shapes import icosphere

MESH = icosphere(3)
SPHERE, FACES = np.array(MESH.vertices), np.asarray(MESH.faces, np.int64)
ELEMENTS = LinearElements(SPHERE, FACES)


def _tangent(rng: np.random.Generator, size: float) -> np.ndarray:
    field = size * rng.standard_normal(SPHERE.shape)
    return field - SPHERE * np.einsum("ij,ij->i", field, SPHERE)[:, None]


def test_a_displacement_to_a_neighbour_ends_at_that_neighbour() -> None:
    target = np.arange(len(SPHERE))
    target[FACES[:, 0]] = FACES[:, 1]
    corners, rates = destinations(FACES, ELEMENTS.hats, SPHERE[target] - SPHERE)
    moved = SPHERE.copy()
    carry_all(moved, FACES, corners, rates, 1.0)
    np.testing.assert_allclose(moved, SPHERE[target], atol=1e-9)


def test_on_the_sphere_itself_a_displacement_is_what_it_says() -> None:
    displacement = _tangent(np.random.default_rng(0), 1e-3)
    corners, rates = destinations(FACES, ELEMENTS.hats, displacement)
    moved = SPHERE.copy()
    carry_all(moved, FACES, corners, rates, 1.0)
    # Faces are tilted against the tangent plane by about half an edge's angle.
    tilt = 0.5 * MESH.edges_unique_length.max()
    assert np.linalg.norm(moved - SPHERE - displacement, axis=1).max() < tilt * 4e-3


def test_no_vertex_leaves_its_ring() -> None:
    displacement = _tangent(np.random.default_rng(1), 10.0)
    corners, rates = destinations(FACES, ELEMENTS.hats, displacement)
    moved = SPHERE.copy()
    carry_all(moved, FACES, corners, rates, 1.0)
    assert np.linalg.norm(moved - SPHERE, axis=1).max() <= MESH.edges_unique_length.max() + 1e-12


@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1), st.floats(1e-3, 10), st.floats(0, 0.9))
def test_careful_steps_never_flip_and_always_even_out(seed, size, spread) -> None:
    rng = np.random.default_rng(seed)
    areas = 1 + spread * rng.uniform(-1, 1, len(FACES))
    areas *= 4 * np.pi / areas.sum()
    corners, rates = destinations(FACES, ELEMENTS.hats, _tangent(rng, size))
    starts, fans = corners_by_vertex(FACES, len(SPHERE))
    moved = SPHERE.copy()
    count = carry_carefully(moved, FACES, areas, starts, fans, corners, rates, 1.0)
    assert not flipped_faces(moved, FACES).any()
    assert count == (moved != SPHERE).any(axis=1).sum()
    before, after = (mean_square_distortion(s, FACES, areas) for s in (SPHERE, moved))
    assert after < before


def test_the_smooth_flow_lowers_distortion_at_its_known_rate() -> None:
    """d/dt of the mean of δh² is minus the mean of δh² (δh + 2), whatever the start."""
    mesh = icosphere(5)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int64)
    sphere = vertices * (1, 1, 0.8)
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    flow = AreaFlow(vertices, faces)
    targets = at_vertices(flow.elements.areas, faces, len(vertices))
    excess = at_vertices(signed_spherical_areas(sphere, faces), faces, len(vertices)) / targets - 1
    step = 1e-3
    moved, _ = flow.advance(sphere, step=step, integrated=True, guard=False)
    after = at_vertices(signed_spherical_areas(moved, faces), faces, len(vertices)) / targets - 1
    rate = np.average((after**2 - excess**2) / step, weights=targets)
    expected = -np.average(excess**2 * (excess + 2), weights=targets)
    assert abs(rate / expected - 1) < 0.05
