from __future__ import annotations

import numpy as np
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage
from scipy.spatial import ConvexHull

from gipkg.baselines.light_field.silhouettes import MARGIN, SIZE, silhouette

SCALE = SIZE / 2 - MARGIN
EIGHT = np.ones((3, 3), dtype=bool)


def draw(mesh: trimesh.Trimesh, direction: tuple[float, float, float]) -> np.ndarray:
    unit = np.array(direction) / np.linalg.norm(direction)
    return silhouette(np.asarray(mesh.triangles), unit)


def test_a_ball_is_a_disc() -> None:
    image = draw(trimesh.creation.icosphere(4), (0.3, -0.5, 0.8))
    away = np.linalg.norm(np.argwhere(image) + 0.5 - SIZE / 2, axis=1)
    outside = np.linalg.norm(np.argwhere(~image) + 0.5 - SIZE / 2, axis=1)
    assert away.max() <= SCALE + 0.71
    assert outside.min() >= SCALE - 0.5  # The polyhedron lies a little inside the sphere.


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_a_convex_body_is_the_hull_of_its_projected_vertices(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = trimesh.creation.icosphere(0)
    body.vertices *= rng.uniform(0.05, 1, (12, 1))
    body = body.convex_hull
    direction = rng.standard_normal(3)
    direction /= np.linalg.norm(direction)
    image = silhouette(np.asarray(body.triangles), direction)

    # Where the image lies in its plane is known up to a motion: compare areas of hull and image.
    across = np.linalg.svd(direction[None])[2][1:]
    hull = ConvexHull(body.vertices @ across.T * SCALE)
    pixels = image.sum()
    assert hull.volume <= pixels <= hull.volume + 1.5 * hull.area + 4
    assert ndimage.label(image, EIGHT)[1] == 1
    # Filled, without holes.
    assert (ndimage.binary_fill_holes(image) == image).all()


def test_a_needle_keeps_together() -> None:
    needle = trimesh.creation.icosphere(3)
    needle.vertices *= [1e-4, 1e-4, 1.0]
    for direction in ((1, 0, 0), (0.3, 0.7, 0.2), (0.1, 0.2, 0.99)):
        image = draw(needle, direction)
        assert ndimage.label(image, EIGHT)[1] == 1
    along = draw(needle, (0, 0, 1))
    assert 1 <= along.sum() <= 4


def test_pixels_are_those_that_the_surface_touches() -> None:
    """Second route: many points of the surface, and the squares that they fall into."""
    mesh = trimesh.creation.torus(0.7, 0.2, 24, 12)
    direction = np.array([0.0, 0.0, 1.0])
    image = silhouette(np.asarray(mesh.triangles), direction)
    # The torus looks the same however the image is turned by right angles or mirrored.
    places = mesh.sample(400_000, seed=0)[:, :2] * SCALE + SIZE / 2
    touched = np.zeros_like(image)
    touched[tuple(np.floor(places).astype(int).T)] = True
    assert not (touched & ~image).any()
    assert touched.sum() > 0.99 * image.sum()
