from __future__ import annotations

import numpy as np
import pytest
import trimesh
from pydantic import ValidationError

from gipkg.errors import MeshFormatError, UnsupportedMesh
from gipkg.surfaces import preparation, prepare
from gipkg.surfaces.report import Step
from tests.surfaces.prepared import assert_sound, assert_untouched
from tests.surfaces.solids import chain_of_tori, moebius_strip, soup, sphere, torus, without_cap
from tests.surfaces.test_steps import triangles


@pytest.mark.parametrize("mesh", [sphere(), sphere(0), trimesh.creation.capsule()])
def test_accurate_surface_stays_as_it_is(mesh):
    assert_untouched(mesh, prepare(mesh))


def test_source_is_not_changed():
    mesh = chain_of_tori(2)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)
    surface = prepare(mesh)
    surface.mesh.vertices += 1
    assert np.array_equal(mesh.vertices, vertices)
    assert np.array_equal(mesh.faces, faces)


def test_faults_that_repair_leaves_are_named_with_a_way_out(monkeypatch):
    opened = triangles(without_cap(sphere(), 0.5))
    monkeypatch.setattr(preparation, "repair", lambda *_, **__: (opened, (Step("nothing", {}),)))
    fault = r"faults: \d+ vertices belong to no face; it is open.*\. method='volume' remakes"
    with pytest.raises(UnsupportedMesh, match=fault):
        prepare(torus(), method="repair")
    assert "the repair left faults" in prepare(torus(), resolution=20).report.reason


@pytest.mark.parametrize(
    "options", [{"largest_hole": 2}, {"merge_tolerance": -1}, {"smallest_part": "x"}, {"size": 1}]
)
def test_options_are_checked(options):
    with pytest.raises(ValidationError):
        prepare(sphere(), **options)


def test_files_are_read_and_named(tmp_path):
    path = tmp_path / "ring.stl"
    torus().export(path)
    surface = prepare(path)
    assert surface.mesh.metadata["file_name"] == "ring.stl"
    assert_sound(surface)
    moebius_strip().export(tmp_path / "strip.obj")
    with pytest.raises(UnsupportedMesh, match=r"strip\.obj: the surface has one side"):
        prepare(str(tmp_path / "strip.obj"), method="repair")
    with pytest.raises(MeshFormatError, match="no such file"):
        prepare(tmp_path / "missing.ply")


def test_the_same_every_time():
    ring = soup(chain_of_tori(2))
    one, two = prepare(ring), prepare(ring)
    assert np.asarray(one.mesh.vertices).tobytes() == np.asarray(two.mesh.vertices).tobytes()
    assert np.array_equal(one.mesh.faces, two.mesh.faces)
    assert one.report == two.report
