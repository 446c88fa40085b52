"""Local and global smoothing, each by itself."""

import numpy as np
import pytest

from gipkg.parametrizers.cald.diffusion import diffuse
from gipkg.parametrizers.cald.global_smoothing import smooth_globally
from gipkg.parametrizers.cald.local_smoothing import smooth_locally
from gipkg.parametrizers.cald.stars import Stars
from gipkg.parametrizers.sphere.areas import (
    flipped_faces,
    mean_square_distortion,
    signed_spherical_areas,
)
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import icosphere, urchin


def _surface(subdivisions: int = 3):
    """Return vertices, faces, areas to 4π, cotangents and stars of the unit sphere."""
    mesh = icosphere(subdivisions)
    faces = np.asarray(mesh.faces, np.int64)
    vertices = np.array(mesh.vertices)
    areas = face_areas(vertices, faces)
    return (
        vertices,
        faces,
        areas * 4 * np.pi / areas.sum(),
        corner_cotangents(vertices, faces),
        Stars.of(faces),
    )


def _shaken(vertices: np.ndarray, amount: float) -> np.ndarray:
    moved = vertices + amount * np.random.default_rng(3).normal(size=vertices.shape)
    return moved / np.linalg.norm(moved, axis=1, keepdims=True)


def _worst_length(sphere: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> float:
    """Largest factor by which any length is changed, by singular values."""

    def frames(points: np.ndarray) -> np.ndarray:
        p, q, r = (points[faces[:, k]] for k in range(3))
        along = (q - p) / np.linalg.norm(q - p, axis=1, keepdims=True)
        across = (r - p) - along * np.einsum("ij,ij->i", r - p, along)[:, None]
        across /= np.linalg.norm(across, axis=1, keepdims=True)
        axes = np.stack((along, across), 1)
        return axes @ np.stack((q - p, r - p), 2)

    singular = np.linalg.svd(frames(sphere) @ np.linalg.inv(frames(vertices)), compute_uv=False)
    return float(max(singular.max(), 1 / singular.min()))


def test_area_error_of_known_ratios() -> None:
    vertices, faces, _, _, _ = _surface()
    on_sphere = signed_spherical_areas(vertices, faces)
    factor = np.where(vertices[faces].mean(axis=1)[:, 2] > 0, 1.5, 0.5)
    areas = on_sphere / factor
    expected = ((factor - 1) ** 2 * areas).sum() / (4 * np.pi)
    assert mean_square_distortion(vertices, faces, areas) == pytest.approx(expected)


def test_local_smoothing_evens_out_areas_without_a_flip() -> None:
    vertices, faces, areas, cotangents, stars = _surface()
    sphere = _shaken(vertices, 0.02)
    before = mean_square_distortion(sphere, faces, areas)
    assert not flipped_faces(sphere, faces).any()
    smooth_locally(sphere, stars, areas, cotangents, 10.0, 20)
    assert mean_square_distortion(sphere, faces, areas) < before / 50
    assert not flipped_faces(sphere, faces).any()
    assert np.abs(np.linalg.norm(sphere, axis=1) - 1).max() < 1e-14


def test_local_smoothing_does_not_change_lengths_beyond_the_limit() -> None:
    mesh = urchin(6, 1.0, 3)
    faces = np.asarray(mesh.faces, np.int64)
    vertices = mesh.vertices * np.sqrt(4 * np.pi / mesh.area)
    areas, cotangents = face_areas(vertices, faces), corner_cotangents(vertices, faces)
    stars = Stars.of(faces)
    start = diffuse(vertices, stars)
    smooth_locally(start, stars, areas, cotangents, 1.0, 50)
    before = _worst_length(start, vertices, faces)

    def worst(limit: float) -> float:
        sphere = start.copy()
        smooth_locally(sphere, stars, areas, cotangents, limit, 50)
        return _worst_length(sphere, vertices, faces)

    assert worst(1.0) <= before * (1 + 1e-9)
    assert worst(1.05 * before) <= 1.05 * before * (1 + 1e-9)
    assert worst(1e9) > 1.1 * before


def test_local_smoothing_turns_faces_back() -> None:
    vertices, faces, areas, cotangents, stars = _surface()
    sphere = vertices.copy()
    apex = faces[0, 0]
    sphere[apex] = -vertices[apex] + 3 * vertices[faces[0, 1]]
    sphere[apex] /= np.linalg.norm(sphere[apex])
    assert flipped_faces(sphere, faces).any()
    smooth_locally(sphere, stars, areas, cotangents, 2.0, 3)
    assert not flipped_faces(sphere, faces).any()


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_equal_areas_are_left_alone(axis: int) -> None:
    vertices, faces, _, _, _ = _surface(5)
    areas = signed_spherical_areas(vertices, faces)
    moved, _ = smooth_globally(vertices, faces, areas, 6, axis)
    assert np.abs(moved - vertices).max() < 0.02


def test_global_smoothing_evens_out_a_smooth_density_from_all_sides() -> None:
    vertices, faces, areas, _, _ = _surface(4)
    areas = areas * np.exp(vertices[faces].mean(axis=1) @ [0.5, -0.3, 0.8])
    areas *= 4 * np.pi / areas.sum()
    sphere = vertices
    errors = [mean_square_distortion(sphere, faces, areas)]
    for turn in range(12):
        sphere, share = smooth_globally(sphere, faces, areas, 6, turn % 3)
        errors.append(mean_square_distortion(sphere, faces, areas))
        assert (share > 0) == (errors[-1] < errors[-2])
        assert not flipped_faces(sphere, faces).any()
    assert np.abs(np.linalg.norm(sphere, axis=1) - 1).max() < 1e-14
    assert (np.diff(errors) <= 0).all()
    assert errors[-1] < errors[0] / 100
