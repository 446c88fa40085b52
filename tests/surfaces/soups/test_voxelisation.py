"""Soups to solids: closed, open, turned, two-sided and thin ones, against what they enclose."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from gipkg.surfaces.soups.band import BAND, band_distances
from gipkg.surfaces.soups.voxelisation import THICKNESS, voxelise
from gipkg.surfaces.soups.winding import wound_around
from gipkg.surfaces.volumes.topology import count_topology
from tests.surfaces.solids import bare, soup, sphere, torus, without_cap

SIZE = 24


def solid_of(mesh: trimesh.Trimesh, resolution: int = SIZE):
    volume, original = voxelise(np.asarray(mesh.vertices), np.asarray(mesh.faces), resolution)
    return volume, volume.values > 0, original


def litres(mesh: trimesh.Trimesh, resolution: int = SIZE) -> float:
    volume, solid, _ = solid_of(mesh, resolution)
    return float(np.count_nonzero(solid) * volume.spacing**3)


def swollen(radius: float, resolution: int = SIZE) -> float:
    """Volume of a ball that is thicker by as much as all solids are."""
    return 4 / 3 * np.pi * (radius + THICKNESS * 2 / resolution) ** 3


def turned(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Every other face turned."""
    faces = np.asarray(mesh.faces).copy()
    faces[::2] = faces[::2, ::-1]
    return bare(mesh.vertices, faces)


def two_sided(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    return bare(mesh.vertices, np.concatenate((mesh.faces, mesh.faces[:, ::-1])))


@pytest.mark.parametrize("change", [lambda m: m, soup, turned, two_sided])
def test_a_closed_surface_encloses_its_solid_however_its_faces_are_given(change):
    assert litres(change(sphere(3))) == pytest.approx(swollen(1), rel=0.03)


def test_narrow_gaps_do_not_matter():
    gaps = np.delete(sphere(4).faces, np.arange(0, 5120, 9), axis=0)
    mesh = turned(bare(sphere(4).vertices, gaps))
    assert litres(mesh) == pytest.approx(swollen(1), rel=0.03)


def test_values_are_distances_from_the_swollen_surface():
    volume, solid, original = solid_of(sphere(4))
    centres = np.argwhere(np.ones(solid.shape, bool)) * volume.spacing + volume.origin
    radius = np.linalg.norm(centres, axis=1).reshape(solid.shape) / volume.spacing
    expected = SIZE / 2 + THICKNESS - radius
    shown = (volume.values > THICKNESS - BAND + 1e-3) & (radius > SIZE / 2)
    assert np.abs(volume.values - expected)[shown].max() < 0.05
    assert (original == (np.abs(radius - SIZE / 2) < THICKNESS)).mean() > 0.99


def test_an_open_sheet_becomes_a_plate_of_one_piece():
    square = bare(
        [[0, 0, 0], [1, 0.2, 0.3], [1.1, 1.2, 0.6], [0.1, 1, 0.3]], [[0, 1, 2], [0, 2, 3]]
    )
    _, solid, original = solid_of(square, 40)
    found = count_topology(solid)
    assert (found.components, found.cavities, found.tunnels) == (1, 0, 0)
    assert original[solid].all()


def test_a_bowl_stays_hollow_and_a_wide_hole_in_a_well_oriented_surface_is_filled():
    assert litres(without_cap(sphere(3), 0)) < 0.5 * swollen(1)
    holed = without_cap(sphere(4), 0.97)
    volume, solid, original = solid_of(holed)
    centre = tuple(np.rint(-np.array(volume.origin) / volume.spacing).astype(int))
    assert solid[centre]
    assert not original[centre]


def test_a_ring_keeps_its_tunnel():
    assert count_topology(solid_of(torus(60, 30))[1]).tunnels == 1


def test_distances_agree_with_brute_force():
    rng = np.random.default_rng(0)
    points = rng.uniform(4, 26, (60, 3))
    mesh = bare(points, np.arange(60).reshape(-1, 3))
    found = band_distances(points, np.asarray(mesh.faces), (30, 30, 30))
    samples, _ = trimesh.sample.sample_surface(mesh, 400_000, seed=0)
    centres = np.argwhere(np.ones(found.shape, bool))
    samples = np.concatenate((samples, points))
    excess = np.minimum(cKDTree(samples).query(centres)[0], BAND).reshape(found.shape) - found
    assert excess.min() > -1e-5
    assert excess[found > 1].max() < 0.1


def test_winding_numbers_decide_only_where_they_are_whole():
    everywhere = np.ones((20, 20, 20), bool)
    ball = sphere(3)
    points = 7 * ball.vertices + 9.63
    wound = wound_around(points, np.asarray(ball.faces), everywhere)
    assert np.count_nonzero(wound) == pytest.approx(4 / 3 * np.pi * 7**3, rel=0.05)
    inverted = wound_around(points, np.asarray(ball.faces)[:, ::-1].copy(), everywhere)
    assert np.array_equal(inverted, wound)
    bowl = without_cap(ball, 0)
    broken = wound_around(7 * bowl.vertices + 9.63, np.asarray(bowl.faces), everywhere)
    assert not broken.any()
