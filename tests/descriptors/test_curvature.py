"""Curvature: closed forms on sphere, torus, cylinder and ellipsoid; Gauss and Bonnet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from numpy.testing import assert_allclose
from scipy.spatial import ConvexHull

from gipkg.api import Volume
from gipkg.descriptors.curvature import Curvature
from gipkg.descriptors.curvature_measures import curvature_measures
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import prepare

AXES = np.array([1.0, 1.5, 2.5])


def curvature(mesh: trimesh.Trimesh, quantity: str = "principal", **parameters) -> np.ndarray:
    """The curvature of the mesh as it is, not scaled to unit area."""
    descriptor = Curvature(quantity=quantity, logarithm=False, **parameters)
    values = descriptor.describe(mesh, Operators(mesh))
    return values / (mesh.area if quantity == "gaussian" else np.sqrt(mesh.area))


def of_ellipsoid(points: np.ndarray) -> np.ndarray:
    """Principal curvatures of the ellipsoid of the axes AXES."""
    weight = (points**2 / AXES**4).sum(axis=1)
    product = np.prod(AXES)
    gaussian = 1 / (product**2 * weight**2)
    mean = (AXES @ AXES - (points**2).sum(axis=1)) / (2 * product**2 * weight**1.5)
    difference = np.sqrt(np.maximum(mean**2 - gaussian, 0))
    return np.stack([mean + difference, mean - difference], axis=1)


def test_it_nears_that_of_the_sphere_as_the_mesh_is_refined() -> None:
    errors = []
    for subdivisions in (3, 4, 5):
        mesh = trimesh.creation.icosphere(subdivisions, radius=5.0)
        errors.append(np.abs(5 * curvature(mesh) - 1).max())
        assert np.abs(25 * curvature(mesh, "gaussian") - 1).max() < 1.1 * errors[-1]
    assert errors[-1] < 0.005
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_units_are_those_of_unit_area() -> None:
    mesh = trimesh.creation.icosphere(4, radius=1e-3)
    operators = Operators(mesh)
    for quantity, expected in (("mean", np.sqrt(4 * np.pi)), ("gaussian", 4 * np.pi)):
        raw = Curvature(quantity=quantity, logarithm=False).describe(mesh, operators)
        assert_allclose(raw, expected, rtol=0.02)
        assert_allclose(Curvature(quantity=quantity).describe(mesh, operators), np.log1p(raw))


def test_it_is_that_of_the_torus() -> None:
    mesh = trimesh.creation.torus(1.0, 0.4, 64, 64)
    from_axis = np.linalg.norm(mesh.vertices[:, :2], axis=1)
    first, second = 1 / 0.4, (from_axis - 1) / 0.4 / from_axis
    found = curvature(mesh, time=1e-4)
    assert_allclose(found[:, 0], first, rtol=0.01)
    assert_allclose(found[:, 1], second, atol=0.05)
    assert_allclose(curvature(mesh, "mean", time=1e-4)[:, 0], (first + second) / 2, atol=0.05)
    assert_allclose(curvature(mesh, "gaussian", time=1e-4)[:, 0], first * second, atol=0.1)


def test_it_is_that_of_the_cylinder() -> None:
    height = np.linspace(-3, 3, 90)
    profile = np.vstack([[[0, -3]], np.stack([0.5 + 0 * height, height], axis=1), [[0, 3]]])
    mesh = trimesh.creation.revolve(profile, sections=32)
    assert mesh.is_watertight
    middle = np.abs(mesh.vertices[:, 2]) < 1.5
    assert middle.sum() > 1000
    assert_allclose(curvature(mesh)[middle], np.tile([2.0, 0.0], (middle.sum(), 1)), atol=0.03)


@pytest.mark.parametrize("regular", [True, False])
def test_it_is_that_of_the_ellipsoid_also_on_points_at_random(regular: bool) -> None:
    if regular:
        sphere = trimesh.creation.icosphere(4)
    else:
        points = np.random.default_rng(0).standard_normal((4000, 3))
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        sphere = trimesh.Trimesh(points, ConvexHull(points).simplices, process=False)
        sphere.fix_normals()
    mesh = trimesh.Trimesh(sphere.vertices * AXES, sphere.faces, process=False)
    errors = np.abs(curvature(mesh, time=2e-4) / of_ellipsoid(mesh.vertices) - 1)
    assert (errors.mean(axis=0) < (0.02 if regular else 0.06)).all()


@pytest.mark.parametrize("time", [1e-6, 1e-3, 1.0])
def test_the_integral_of_the_gaussian_curvature_is_that_of_gauss_and_bonnet(
    pebble, time: float
) -> None:
    for mesh, euler in ((pebble, 2), (trimesh.creation.torus(1.0, 0.4), 0)):
        operators = Operators(mesh)
        values = Curvature(quantity="gaussian", logarithm=False, time=time)
        density = values.describe(mesh, operators)[:, 0] / operators.mass.sum()
        assert operators.mass @ density == pytest.approx(2 * np.pi * euler, abs=1e-8)


def test_a_mesh_turned_inside_out_has_the_opposite_curvature(pebble) -> None:
    other = trimesh.Trimesh(pebble.vertices, pebble.faces[:, ::-1], process=False)
    for logarithm in (True, False):
        descriptor = Curvature(logarithm=logarithm)
        expected = -descriptor.describe(pebble, Operators(pebble))[:, ::-1]
        found = descriptor.describe(other, Operators(other))
        assert_allclose(found, expected, atol=1e-9)


def test_gaussian_curvature_does_not_change_when_the_surface_is_bent() -> None:
    strip = trimesh.creation.box((8, 1, 0.1)).subdivide_to_size(0.25)
    x, y, z = strip.vertices.T
    radius = 8 / np.pi
    bent = [(radius + z) * np.sin(x / radius), y, (radius + z) * np.cos(x / radius)]
    other = trimesh.Trimesh(np.column_stack(bent), strip.faces, process=False)
    gaussian = [curvature(mesh, "gaussian") for mesh in (strip, other)]
    mean = [curvature(mesh, "mean") for mesh in (strip, other)]
    assert np.abs(gaussian[0] - gaussian[1]).max() < 0.02 * np.ptp(gaussian[0])
    # Bent by 1 / radius, the outer side one way and the inner side the other.
    assert np.abs(mean[0] - mean[1]).max() > 0.4 / radius


def test_noise_is_averaged_over_more_of_the_surface_in_more_time() -> None:
    mesh = trimesh.creation.icosphere(4)
    radius = 1 + 0.003 * np.random.default_rng(0).standard_normal(len(mesh.vertices))
    noisy = trimesh.Trimesh(mesh.vertices * radius[:, None], mesh.faces, process=False)
    errors = [np.abs(curvature(noisy, time=time) - 1).mean() for time in (1e-5, 1e-3, 1e-2)]
    assert errors[0] > 5 * errors[1] > 10 * errors[2]


def test_the_choice_of_tangent_frames_cancels_out(small_pebble) -> None:
    operators = Operators(small_pebble)
    measures = curvature_measures(small_pebble)
    turn = np.random.default_rng(0).uniform(0, 2 * np.pi, len(measures.frames))
    cosine, sine = np.cos(turn)[:, None], np.sin(turn)[:, None]
    first, second = measures.frames[:, 0], measures.frames[:, 1]
    frames = np.stack([cosine * first + sine * second, cosine * second - sine * first], axis=1)
    turned = replace(measures, frames=frames, anisotropic=measures.anisotropic * np.exp(-2j * turn))
    mixed = [m.turning_laplacian(operators.laplacian) @ m.anisotropic for m in (measures, turned)]
    assert_allclose(np.abs(mixed[1]), np.abs(mixed[0]), rtol=1e-9, atol=1e-12)


def test_the_turning_laplacian_is_hermitian_and_not_negative(small_pebble) -> None:
    matrix = curvature_measures(small_pebble).turning_laplacian(Operators(small_pebble).laplacian)
    dense = matrix.toarray()
    assert_allclose(dense, dense.conj().T, atol=1e-14)
    assert np.linalg.eigvalsh(dense).min() > 1e-6  # No field is constant on a sphere.


def test_channels_are_named_by_what_is_in_them() -> None:
    assert Curvature().channels() == ("log-principal-curvature-1", "log-principal-curvature-2")
    assert Curvature(quantity="gaussian", logarithm=False).channels() == ("gaussian-curvature",)


def test_it_survives_the_remeshing_of_a_solid() -> None:
    """An ellipsoid of 30 voxels, taken apart and built up again by the surface stage."""
    axes = 14.5 * AXES / AXES.max()
    grid = np.stack(np.mgrid[:30, :30, :30], axis=-1) - 14.5
    surface = prepare(Volume(((grid / axes) ** 2).sum(axis=-1) < 1), vertices=800)
    mesh = trimesh.Trimesh(surface.mesh.vertices - 14.5, surface.mesh.faces, process=False)
    scale = AXES.max() / 14.5
    found = curvature(mesh, time=2e-3) / scale
    expected = of_ellipsoid(mesh.vertices * scale)
    assert (np.median(np.abs(found - expected), axis=0) < [0.17, 0.07]).all()
    assert (np.abs(np.mean(found - expected, axis=0)) < 0.06).all()
    for i, least in ((0, 0.84), (1, 0.91)):
        assert np.corrcoef(found[:, i], expected[:, i])[0, 1] > least


@pytest.mark.parametrize("fault", ["open", "turned"])
def test_a_mesh_whose_edges_do_not_pair_is_refused(pebble, fault: str) -> None:
    faces = np.array(pebble.faces)
    if fault == "open":
        faces = faces[1:]
    else:
        faces[0] = faces[0, ::-1]
    mesh = trimesh.Trimesh(pebble.vertices, faces, process=False)
    with pytest.raises(UnsupportedMesh, match=r"closed mesh .* gipkg\.prepare"):
        Curvature().describe(mesh, Operators(pebble))
