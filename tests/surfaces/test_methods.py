"""Repair or volume: which way a mesh takes, and what is said of it."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import prepare
from tests.surfaces.solids import (
    assert_genus_zero,
    bare,
    chain_of_tori,
    moebius_strip,
    sphere,
    torus,
    without_cap,
)

COARSE = {"resolution": 24, "vertices": 300}


def assert_remade(mesh, reason, **options):
    """Through the volume, for the reason given; no vertex is far from the mesh but where masked."""
    surface = prepare(mesh, **COARSE, **options)
    assert_genus_zero(surface.mesh)
    report = surface.report
    assert report.method == "volume"
    assert reason in report.reason
    assert report.steps[0].name == "voxelise"
    assert report.after.vertices <= 300
    samples, _ = trimesh.sample.sample_surface(mesh, 20_000, seed=0)
    distance, _ = cKDTree(samples).query(surface.mesh.vertices[surface.mask])
    assert distance.max() < 3 * report.steps[0].figures["voxel side"]
    return surface


@pytest.mark.parametrize(
    ("mesh", "reason"),
    [
        (moebius_strip(), "one side only"),
        (bare(np.eye(3), [[0, 1, 2]]), "open sheet"),
        (without_cap(sphere(3), -0.5), "open sheet"),
    ],
    ids=["Möbius strip", "triangle", "shallow bowl"],
)
def test_what_is_no_solid_gets_thickness(mesh, reason):
    assert assert_remade(mesh, reason).report.deviation.lost < 0.06


def test_a_moebius_strip_has_its_tunnel_closed_by_a_membrane():
    surface = prepare(moebius_strip(), resolution=40)
    assert "close tunnels" in [step.name for step in surface.report.steps]
    assert 0.05 < np.mean(~surface.mask) < 0.7
    assert surface.report.deviation.added > 0.2


def test_parts_are_kept_together_where_repair_would_drop_one():
    beside = sphere(2)
    beside.apply_scale(0.3)
    beside.apply_translation((1.25, 0, 0))
    surface = assert_remade(trimesh.util.concatenate([sphere(3), beside]), "repair loses")
    assert surface.mesh.bounds[1, 0] > 1.5


def test_parts_apart_are_joined_where_asked_for():
    balls = [sphere(2) for _ in range(3)]
    for k, ball in enumerate(balls):
        ball.apply_translation((3 * k, 0, 0))
    three = trimesh.util.concatenate(balls)
    with pytest.raises(UnsupportedMesh, match="components='joined'"):
        prepare(three, **COARSE)
    surface = assert_remade(three, "3 parts", components="joined")
    assert np.ptp(surface.mesh.vertices, axis=0)[0] > 7.5
    between = np.abs(surface.mesh.vertices[~surface.mask, 0] % 3 - 1.5)
    assert len(between)
    assert between.max() < 0.6


def test_handles_are_cut_up_to_a_number():
    mesh = chain_of_tori(3)
    assert prepare(mesh).report.method == "repair"
    surface = assert_remade(mesh, "its genus is 3", most_handles=2)
    assert not surface.mask.all()
    with pytest.raises(UnsupportedMesh, match="most_handles"):
        prepare(mesh, method="repair", most_handles=2)


def test_accurate_surfaces_are_remade_only_where_asked_for():
    ball = sphere(3)
    assert prepare(ball, method="repair").report.method == "none"
    assert prepare(ball).report.deviation is None
    surface = assert_remade(ball, "asked for", method="volume")
    assert surface.mask.all()
    assert surface.report.deviation.lost < 0.03


def test_repair_tells_how_far_it_went():
    report = prepare(without_cap(sphere(4), 0.6)).report
    assert report.method == "repair"
    assert report.deviation.lost < 1e-9
    # The cap is flat, of radius 0.8; its middle is 0.8 from the rim.
    diagonal = np.linalg.norm(np.ptp(without_cap(sphere(4), 0.6).vertices, axis=0))
    assert report.deviation.added == pytest.approx(0.8 / diagonal, rel=0.1)


def test_too_large_a_mesh_is_refused_or_made_smaller():
    ball = torus(40, 20)
    with pytest.raises(UnsupportedMesh, match=r"1600 faces, more than 1000.*method='volume'"):
        prepare(ball, most_faces=1000)
    assert_remade(ball, "asked for", method="volume", most_faces=1000)


def test_more_faces_than_memory_holds(monkeypatch):
    monkeypatch.setattr("gipkg.surfaces.soups.assembly.MOST_FACES", 1000)
    with pytest.raises(UnsupportedMesh, match="1600 faces, more than 1000"):
        prepare(torus(40, 20), method="volume")


def test_a_heap_of_faces_is_no_surface():
    fan = np.column_stack((np.zeros(600), np.ones(600), 2 + np.arange(600))).astype(int)
    turn = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    rim = np.column_stack((np.cos(turn), np.sin(turn), 0 * turn))
    mesh = bare(np.concatenate(([[0, 0, -1], [0, 0, 1]], rim)), fan)
    assert_remade(mesh, "heap of faces")
