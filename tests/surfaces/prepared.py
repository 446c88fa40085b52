"""What is asked of every prepared surface."""

from __future__ import annotations

import json

import numpy as np
import trimesh

from gipkg.surfaces import Surface, prepare
from tests.surfaces.solids import assert_genus_zero


def step_names(surface: Surface) -> list[str]:
    return [step.name for step in surface.report.steps]


def assert_sound(surface: Surface) -> None:
    """Closed and of genus 0, with a mask and a report that agree, and finished."""
    assert_genus_zero(surface.mesh)
    assert surface.mask.shape == (len(surface.mesh.vertices),)
    assert surface.mask.dtype == bool
    report = json.loads(json.dumps(surface.report.as_dict()))
    assert report["after"] == {
        "vertices": len(surface.mesh.vertices),
        "faces": len(surface.mesh.faces),
        "components": 1,
        "holes": 0,
        "genus": 0,
    }
    assert_untouched(surface.mesh, prepare(surface.mesh))


def assert_untouched(mesh: trimesh.Trimesh, surface: Surface) -> None:
    assert not surface.report.changed
    assert surface.mask.all()
    assert surface.mesh is not mesh
    assert np.asarray(surface.mesh.vertices).tobytes() == np.asarray(mesh.vertices).tobytes()
    assert np.array_equal(surface.mesh.faces, mesh.faces)
