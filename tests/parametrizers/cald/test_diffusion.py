"""Latitude and longitude by diffusion."""

import numpy as np
import pytest

from gipkg.parametrizers.cald.diffusion import diffuse
from gipkg.parametrizers.cald.stars import Stars
from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from tests.support.shapes import ellipsoid, icosphere, needle, urchin


def _diffused(mesh) -> np.ndarray:
    return diffuse(np.asarray(mesh.vertices), Stars.of(np.asarray(mesh.faces, np.int64)))


def test_stars_are_counterclockwise_and_whole() -> None:
    mesh = icosphere(2)
    stars = Stars.of(np.asarray(mesh.faces, np.int64))
    assert (np.sort(stars.corners) == np.arange(mesh.faces.size)).all()
    for v in range(len(mesh.vertices)):
        span = slice(stars.offsets[v], stars.offsets[v + 1])
        ring, corners = stars.ring[span], stars.corners[span]
        for k, (q, r) in enumerate(zip(ring, np.roll(ring, -1), strict=True)):
            face = np.roll(mesh.faces[corners[k] // 3], -(corners[k] % 3))
            assert face.tolist() == [v, q, r]


@pytest.mark.parametrize("mesh", [icosphere(3), ellipsoid(1, 2, 4), urchin(6, 1.0, 3)])
def test_both_functions_are_harmonic_and_cover_the_sphere_once(mesh) -> None:
    sphere = _diffused(mesh)
    latitude = np.arccos(np.clip(sphere[:, 2], -1, 1))
    longitude = np.arctan2(sphere[:, 1], sphere[:, 0])
    poles = {int(latitude.argmin()), int(latitude.argmax())}
    assert sphere[sorted(poles), 2].round(12).tolist() in ([1, -1], [-1, 1])
    for v in set(range(len(sphere))) - poles:
        ring = mesh.vertex_neighbors[v]
        assert latitude[v] == pytest.approx(latitude[ring].mean(), abs=1e-6)
        inner = [w for w in ring if w not in poles]
        turns = (longitude[inner] - longitude[v] + np.pi) % (2 * np.pi) - np.pi
        assert turns.sum() == pytest.approx(0, abs=1e-6)
    assert signed_spherical_areas(sphere, mesh.faces).sum() == pytest.approx(4 * np.pi)
    assert not flipped_faces(sphere, mesh.faces).any()


def test_a_tube_of_hexagons_has_parallels_of_hexagons() -> None:
    mesh = needle(20)
    sphere = _diffused(mesh)
    rings = sphere[:-2].reshape(20, 6, 3)
    # Turned by 60 degrees about the poles, the mesh is the same.
    assert np.ptp(rings[:, :, 2], axis=1).max() < 1e-9
    longitude = np.arctan2(rings[:, :, 1], rings[:, :, 0])
    assert np.allclose(np.diff(longitude, axis=1) % (2 * np.pi), np.pi / 3)
