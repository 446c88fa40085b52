from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy import ndimage

from gipkg.baselines.light_field.features import (
    ANGULAR,
    COUNT,
    RADIAL,
    angular_radial_transform,
    silhouette_features,
)
from gipkg.baselines.light_field.outline import fourier_descriptors, length, resample, trace
from gipkg.baselines.light_field.silhouettes import silhouette

RADIUS = 110.0
GRID = np.stack(np.meshgrid(np.arange(256.0), np.arange(256.0), indexing="ij"), axis=-1)
CENTRE = np.array([127.3, 128.1])


def polar() -> tuple[np.ndarray, np.ndarray]:
    offsets = (GRID - CENTRE) / RADIUS
    angle = np.arctan2(offsets[..., 1], offsets[..., 0]) % (2 * np.pi)
    return np.linalg.norm(offsets, axis=-1), angle


def disc() -> np.ndarray:
    return polar()[0] <= 1


def blob(seed: int) -> np.ndarray:
    """A connected silhouette without holes, of any outline."""
    noise = np.random.default_rng(seed).standard_normal((40, 40))
    noise = np.pad(ndimage.gaussian_filter(noise, 2), 2, constant_values=-1)
    image = ndimage.binary_fill_holes(noise > 0, np.ones((3, 3)))
    labels, _ = ndimage.label(image, np.ones((3, 3)))
    image = labels == np.bincount(labels[labels > 0]).argmax()
    return ndimage.binary_fill_holes(image)


def radial_integrals(outer: float = 1.0) -> np.ndarray:
    """∫ R_n(ρ) ρ dρ from 0 to `outer`, in closed form."""
    first = [outer**2 / 2]
    for n in (1, 2):
        a = np.pi * n
        first.append(2 * (outer * np.sin(a * outer) / a + (np.cos(a * outer) - 1) / a**2))
    return np.array(first)


def test_the_transform_of_a_disc_is_known() -> None:
    expected = np.zeros((RADIAL, ANGULAR))
    expected[:, 0] = radial_integrals()
    found = angular_radial_transform(GRID[disc()], CENTRE, RADIUS)
    assert_allclose(found, expected, atol=1e-3)
    assert expected[0, 0] == 0.5
    assert expected[1, 0] == pytest.approx(-4 / np.pi**2)


@pytest.mark.parametrize("angle", [0.7, 2.0, 4.5])
@pytest.mark.parametrize("outer", [1.0, 0.6])
def test_the_transform_of_a_sector_is_that_of_its_integral(angle: float, outer: float) -> None:
    distance, direction = polar()
    pixels = GRID[(distance <= outer) & (direction <= angle)]
    m = np.arange(1, ANGULAR)
    turns = np.concatenate([[angle], (1 - np.exp(-1j * m * angle)) / (1j * m)]) / (2 * np.pi)
    expected = np.outer(radial_integrals(outer), turns)
    found = angular_radial_transform(pixels, CENTRE, RADIUS)
    assert_allclose(found, expected, atol=2e-3)


def test_a_turned_silhouette_has_the_turned_transform() -> None:
    distance, direction = polar()
    pixels = GRID[(distance <= 0.9) & (np.sin(2 * direction) > -0.3)]
    centred = pixels - CENTRE
    turned = centred @ np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]])
    expected = angular_radial_transform(pixels, CENTRE) * np.exp(-0.4j * np.arange(ANGULAR))
    assert_allclose(angular_radial_transform(turned, np.zeros(2)), expected, atol=1e-9)


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_the_outline_passes_every_pixel_beside_the_outside(seed: int) -> None:
    image = blob(seed)
    outline = trace(image)
    inner = ndimage.binary_erosion(image)
    assert {tuple(pixel) for pixel in outline} == {tuple(p) for p in np.argwhere(image & ~inner)}
    steps = np.abs(np.diff(np.vstack([outline, outline[:1]]), axis=0)).max(axis=1)
    assert (steps == 1).all()


def test_a_line_is_walked_there_and_back_and_a_pixel_is_one() -> None:
    image = np.zeros((7, 9), dtype=bool)
    image[3, 4] = True
    assert trace(image).tolist() == [[3, 4]]
    features = silhouette_features(image)
    assert features.shape == (COUNT,)
    assert np.isfinite(features).all()
    image[3, 2:7] = True
    assert [column for _, column in trace(image)] == [2, 3, 4, 5, 6, 5, 4, 3]


def test_points_of_an_outline_are_equally_far_apart() -> None:
    square = np.array([[0, 0], [0, 4], [4, 4], [4, 0]])
    points = resample(square, 16)
    assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), 1)
    assert length(points) == pytest.approx(16)


@pytest.mark.parametrize("waves", [2, 3, 7])
def test_a_wave_along_a_circle_has_one_fourier_descriptor(waves: int) -> None:
    """r = 1 + ε cos(kφ) has |F_k| / F_0 = ε / 2, to the first order."""
    distance, direction = polar()
    image = distance <= 0.8 * (1 + 0.04 * np.cos(waves * direction))
    found = fourier_descriptors(trace(image), CENTRE, 10)
    assert found[waves - 1] == pytest.approx(0.02, abs=0.002)
    assert np.delete(found, waves - 1).max() < 0.004


def test_a_disc_is_round_and_an_ellipse_is_not() -> None:
    round_features = silhouette_features(disc())
    assert np.abs(round_features[35:45]).max() < 0.004
    assert_allclose(round_features[45:], 1, atol=0.02)

    offsets = (GRID - CENTRE) / RADIUS
    ellipse = (offsets[..., 0] ** 2 + (3 * offsets[..., 1]) ** 2) <= 1
    circularity, eccentricity = silhouette_features(ellipse)[45:]
    assert eccentricity == pytest.approx(1 / 3, abs=0.01)
    perimeter = 4.454964407  # 4 E(1 - 1/9), for half axes 1 and 1/3
    assert circularity == pytest.approx(4 * np.pi * np.pi / 3 / perimeter**2, abs=0.02)


@settings(max_examples=10)
@given(st.integers(0, 10**6))
def test_a_turn_a_mirror_and_a_shift_change_nothing(seed: int) -> None:
    image = np.kron(blob(seed), np.ones((4, 4))).astype(bool)
    expected = silhouette_features(image)
    shifted = np.pad(image, ((5, 0), (0, 9)))
    for other in (np.rot90(image), image[::-1], image.T, shifted):
        found = silhouette_features(other)
        # The points of the outline lie elsewhere between its pixels.
        assert_allclose(found[:45], expected[:45], atol=0.01)
        assert_allclose(found[45:], expected[45:], atol=0.03)


@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.2, 0.5, -0.8)])
def test_cameras_on_opposite_sides_measure_the_same(direction: tuple[float, ...]) -> None:
    mesh = trimesh.creation.icosphere(3)
    mesh.vertices *= [0.3, 0.9, 0.5]
    mesh.vertices[:, 0] += 0.3 * mesh.vertices[:, 1] ** 2
    towards = np.array(direction) / np.linalg.norm(direction)
    front, back = (silhouette(np.asarray(mesh.triangles), d) for d in (towards, -towards))
    assert_allclose(silhouette_features(front), silhouette_features(back), atol=0.02)
