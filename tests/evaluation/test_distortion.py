import numpy as np
import pytest
import trimesh

from gipkg.api import SphericalMap
from gipkg.evaluation.distortion import distortion


def test_the_octahedron_on_itself_has_no_distortion() -> None:
    vertices = np.vstack((np.eye(3), -np.eye(3)))
    mesh = trimesh.convex.convex_hull(vertices)
    measured = distortion(SphericalMap(mesh, np.asarray(mesh.vertices)))
    assert measured.flips == 0
    assert measured.degree == pytest.approx(1, abs=1e-15)
    assert measured.face_std == pytest.approx(0, abs=1e-14)
    assert measured.vertex_std == pytest.approx(0, abs=1e-14)
    assert measured.variance == pytest.approx(0, abs=1e-28)


def test_figures_follow_their_definitions_and_ignore_the_scale_of_the_mesh() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    axes = np.array([1.0, 2.0, 3.0])
    small = trimesh.Trimesh(sphere.vertices * axes, sphere.faces, process=False)
    large = trimesh.Trimesh(sphere.vertices * axes * 1e3, sphere.faces, process=False)
    measured = distortion(SphericalMap(small, np.asarray(sphere.vertices)))
    scaled = distortion(SphericalMap(large, np.asarray(sphere.vertices)))
    expected = small.area_faces * 4 * np.pi / small.area
    np.testing.assert_allclose(measured.mesh_areas, expected, rtol=1e-12)
    assert measured.variance == pytest.approx(np.var(measured.spherical_areas - expected))
    assert measured.face_std == pytest.approx(np.std(measured.spherical_areas / expected - 1))
    incident = [(small.faces == v).any(axis=1) for v in range(len(small.vertices))]
    ratio = [measured.spherical_areas[i].sum() / expected[i].sum() for i in incident]
    assert measured.vertex_std == pytest.approx(np.std(ratio))
    squares = (measured.spherical_areas / expected - 1) ** 2
    share = expected / (4 * np.pi)
    assert measured.weighted_face_std == pytest.approx(np.sqrt(share @ squares))
    assert scaled.face_std == pytest.approx(measured.face_std)
    assert scaled.variance == pytest.approx(measured.variance)


def test_a_mirrored_map_is_flipped_everywhere_and_of_degree_minus_one() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=1)
    measured = distortion(SphericalMap(mesh, -np.asarray(mesh.vertices)))
    assert measured.flips == len(mesh.faces)
    assert measured.degree == pytest.approx(-1)
