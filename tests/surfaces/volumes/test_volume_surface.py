"""Volumes to surfaces: topology by construction, shape within a voxel, mask and report."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st

from gipkg.api import Volume
from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import prepare, volume_surface
from gipkg.surfaces.volumes import assembly
from gipkg.surfaces.volumes.fairing import fair
from gipkg.surfaces.volumes.tetrahedra import lattice_surface
from gipkg.surfaces.volumes.topology import count_topology
from tests.surfaces.prepared import assert_sound, step_names
from tests.surfaces.solids import assert_genus_zero, sphere
from tests.surfaces.volumes.solids import ball, blobs, grid, ring

CENTRE = 19.5


@given(
    st.integers(0, 10**6),
    st.floats(0.0, 2.0),
    st.floats(0.01, 1.0),
    st.sampled_from(["largest", "joined"]),
    st.sampled_from([4, 30, 200]),
)
@example(0, 0.0, 0.125, "joined", 4)  # turned inside out by the reduction
@settings(max_examples=20)
def test_any_solid_becomes_a_closed_surface_of_genus_zero(seed, smooth, share, components, size):
    volume = Volume(blobs(seed, 9, smooth, share))
    surface = volume_surface(volume, components=components, vertices=size, smallest_part=0)
    assert_genus_zero(surface.mesh)
    assert 4 <= len(surface.mesh.vertices) <= size


@pytest.mark.parametrize("size", [200, 10**6])
def test_a_ball_keeps_its_place_and_size(size):
    surface = volume_surface(Volume(ball(12)), vertices=size)
    assert_sound(surface)
    assert not surface.report.changed
    assert surface.mask.all()
    distance = np.linalg.norm(surface.mesh.vertices - CENTRE, axis=1)
    assert np.abs(distance - 12).max() < 0.6
    assert surface.mesh.volume == pytest.approx(4 / 3 * np.pi * 12**3, rel=0.03)


def test_grey_values_place_the_surface_between_voxels():
    x, y, z = grid()
    depth = 10.3 - np.sqrt(x**2 + y**2 + z**2)
    surface = volume_surface(Volume(depth, level=0.0), vertices=1000)
    distance = np.linalg.norm(surface.mesh.vertices - CENTRE, axis=1)
    assert np.abs(distance - 10.3).max() < 0.15


def test_spacing_and_origin_are_applied():
    plain = volume_surface(Volume(ball(9)), vertices=300).mesh
    placed = volume_surface(Volume(ball(9), spacing=0.5, origin=(1, 2, 3)), vertices=300).mesh
    np.testing.assert_allclose(placed.vertices, 0.5 * plain.vertices + (1, 2, 3))
    assert np.array_equal(placed.faces, plain.faces)


def test_where_the_solid_is_in_its_array_does_not_matter():
    solid = ball(5, size=12)
    tight = volume_surface(Volume(solid), vertices=300).mesh
    roomy = volume_surface(Volume(np.pad(solid, ((3, 1), (0, 2), (5, 4)))), vertices=300).mesh
    np.testing.assert_allclose(roomy.vertices, tight.vertices + np.array((3, 0, 5)), atol=1e-12)
    assert np.array_equal(roomy.faces, tight.faces)


def test_the_source_is_not_changed_and_the_result_repeats():
    values = ring(11, 4).astype(np.float32)
    kept = values.copy()
    one, two = (volume_surface(Volume(values), vertices=500) for _ in range(2))
    assert np.array_equal(values, kept)
    assert one.mesh.vertices.tobytes() == two.mesh.vertices.tobytes()
    assert np.array_equal(one.mask, two.mask)


def test_a_cavity_is_filled():
    surface = volume_surface(Volume(ball(14) & ~ball(6)), vertices=500)
    assert_sound(surface)
    assert surface.report.before.cavities == 1
    (step,) = surface.report.steps
    assert step.name == "fill cavities"
    assert step.figures == {"cavities": 1, "voxels": int(ball(6).sum())}
    assert surface.mask.all()
    assert surface.mesh.volume == pytest.approx(4 / 3 * np.pi * 14**3, rel=0.03)


def test_a_ring_gets_a_membrane_and_the_mask_says_where():
    surface = volume_surface(Volume(ring(11, 4)), vertices=1500)
    assert_sound(surface)
    assert surface.report.before.tunnels == 1
    assert step_names(surface) == ["close tunnels"]
    x, y, z = (surface.mesh.vertices - CENTRE).T
    added = ~surface.mask
    assert added.sum() > 20
    assert np.hypot(x, y)[added].max() < 8.5
    assert np.abs(z[added]).max() < 3.5
    assert np.hypot(x, y)[~added].min() > 6
    tube = np.abs(np.hypot(np.hypot(x, y) - 11, z) - 4)
    assert tube[surface.mask].max() < 1


@pytest.mark.parametrize("radius", [8, 9])
def test_a_double_ring_has_two_tunnels_closed(radius):
    solid = ring(radius, 3, (-radius + 1, 0, 0)) | ring(radius, 3, (radius - 1, 0, 0))
    surface = volume_surface(Volume(solid))
    assert_sound(surface)
    assert surface.report.before.tunnels == 2
    right = (~surface.mask)[surface.mesh.vertices[:, 0] > CENTRE].sum()
    assert 10 < right < (~surface.mask).sum() - 10


TWO_BALLS = ball(8, (-9, 0, 0)) | ball(6, (9, 0, 0))
LINKED = ring(9, 2.5, (-5, 0, 0)) | ring(9, 2.5, (5, 0, 0), axis=1)


def test_of_two_balls_the_larger_is_kept():
    surface = volume_surface(Volume(TWO_BALLS), vertices=500)
    assert_sound(surface)
    assert surface.report.before.components == 2
    assert step_names(surface) == ["keep largest part"]
    assert surface.mesh.volume == pytest.approx(ball(8, (-9, 0, 0)).sum(), rel=0.03)


def test_two_balls_are_joined_by_a_strand():
    surface = volume_surface(Volume(TWO_BALLS), vertices=1000, components="joined")
    assert_sound(surface)
    assert step_names(surface) == ["join parts and close tunnels"]
    assert surface.mesh.volume == pytest.approx(TWO_BALLS.sum(), rel=0.04)
    added = surface.mesh.vertices[~surface.mask] - CENTRE
    assert len(added)
    assert np.abs(added - (1, 0, 0)).max() < 4


def test_linked_rings_are_joined_and_closed():
    surface = volume_surface(Volume(LINKED), components="joined")
    assert_sound(surface)
    assert surface.report.before.tunnels == 2


def test_less_than_half_of_the_shape_is_refused_unless_asked_for():
    three = ball(5, (-12, 0, 0)) | ball(5.2) | ball(5, (12, 0, 0))
    with pytest.raises(UnsupportedMesh, match=r"3 components has only .*'joined'"):
        volume_surface(Volume(three))
    assert_sound(volume_surface(Volume(three), smallest_part=0.3, vertices=300))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.zeros((4, 4, 4)), "no value above its level"),
        (np.ones((4, 4)), "2 axes"),
        (np.full((4, 4, 4), np.nan), "not finite"),
    ],
)
def test_what_is_no_solid_is_refused(values, message):
    with pytest.raises(UnsupportedMesh, match=message):
        prepare(Volume(values))


@pytest.mark.parametrize("solid", [np.ones((1, 1, 1)), np.ones((5, 6, 7)), np.ones((1, 9, 1))])
def test_what_fills_its_array_has_an_outside_all_the_same(solid):
    assert_sound(volume_surface(Volume(solid)))


@given(st.integers(0, 10**6), st.floats(0.0, 1.5))
@settings(max_examples=15)
def test_the_lattice_surface_has_the_topology_of_the_voxels(seed, smoothness):
    solid = np.pad(blobs(seed, 8, smoothness), 1)
    depth = np.random.default_rng(seed).normal(size=solid.shape).astype(np.float32)
    vertices, faces, owner = lattice_surface(solid, depth)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    found = count_topology(solid)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    # Every part and every cavity has a surface of its own; each tunnel is a handle.
    assert mesh.euler_number == 2 * (found.components + found.cavities - found.tunnels)
    assert mesh.body_count == found.components + found.cavities
    assert solid.ravel()[owner].all()
    assert np.abs(vertices - np.argwhere(np.ones_like(solid))[owner]).max() < 1


def test_fairing_keeps_the_size_of_a_sphere_and_takes_noise_away():
    mesh = sphere(4)
    noise = 1 + 0.02 * np.random.default_rng(0).normal(size=len(mesh.vertices))
    smooth = fair(mesh.vertices * noise[:, None], np.asarray(mesh.faces), 10)
    radius = np.linalg.norm(smooth, axis=1)
    assert radius.mean() == pytest.approx(1, abs=0.005)
    assert radius.std() < 0.4 * noise.std()


def test_too_many_voxels_are_refused(monkeypatch):
    monkeypatch.setattr("gipkg.surfaces.volumes.assembly.MOST_VOXELS", 1000)
    with pytest.raises(UnsupportedMesh, match="more than 1000; take every second"):
        volume_surface(Volume(ball(9)))


def test_what_is_not_original_is_masked_like_a_membrane():
    upper = np.zeros_like(ball(9))
    upper[:, :, 20:] = True
    surface = volume_surface(Volume(ball(9)), vertices=800, original=upper)
    height = surface.mesh.vertices[:, 2] - CENTRE
    assert surface.mask[height > 1].all()
    assert not surface.mask[height < -1].any()


def test_a_surface_with_faults_is_refused_with_a_way_out(monkeypatch):
    def opened(mesh, count):
        return mesh.with_faces(mesh.faces[1:])

    monkeypatch.setattr(assembly, "decimate", opened)
    with pytest.raises(UnsupportedMesh, match=r"it is open: 3 edges.* or more vertices may"):
        volume_surface(Volume(ball(5, size=12)))
