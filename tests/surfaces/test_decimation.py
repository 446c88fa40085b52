"""Decimation keeps the topology, the place and the regularity of a surface."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from gipkg.surfaces.decimation import decimate
from gipkg.surfaces.triangles import Triangles
from tests.surfaces.solids import chain_of_tori, sphere, torus


@pytest.mark.parametrize(("mesh", "euler"), [(sphere(4), 2), (torus(), 0), (chain_of_tori(3), -4)])
def test_the_topology_is_kept_to_the_last(mesh, euler):
    triangles = Triangles.of(mesh)
    for size in (200, 40):
        fewer = decimate(triangles, size)
        found = trimesh.Trimesh(fewer.vertices, fewer.faces, process=False)
        assert len(fewer.vertices) == size
        assert found.is_watertight
        assert found.is_winding_consistent
        assert found.euler_number == euler
    coarse = decimate(triangles, 200)
    volume = trimesh.Trimesh(coarse.vertices, coarse.faces, process=False).volume
    assert volume == pytest.approx(mesh.volume, rel=0.2)


@pytest.mark.parametrize(("mesh", "least"), [(sphere(3), 4), (torus(), 7)])
def test_it_ends_where_no_edge_can_collapse(mesh, least):
    fewer = decimate(Triangles.of(mesh), 4)
    found = trimesh.Trimesh(fewer.vertices, fewer.faces, process=False)
    assert found.euler_number == mesh.euler_number
    assert found.is_watertight
    assert least <= len(fewer.vertices) <= 2 * least - 4


def test_it_stays_on_the_surface_and_keeps_triangles_regular():
    mesh = sphere(5)
    fewer = decimate(Triangles(mesh.vertices, np.asarray(mesh.faces), mesh.vertices[:, 2] > 0), 500)
    found = trimesh.Trimesh(fewer.vertices, fewer.faces, process=False)
    assert np.abs(np.linalg.norm(fewer.vertices, axis=1) - 1).max() < 0.01
    sides = found.triangles - np.roll(found.triangles, 1, axis=1)
    quality = 4 * np.sqrt(3) * found.area_faces / (sides**2).sum(axis=(1, 2))
    assert quality.min() > 0.4
    assert (fewer.original == (fewer.vertices[:, 2] > 0))[np.abs(fewer.vertices[:, 2]) > 0.1].all()
