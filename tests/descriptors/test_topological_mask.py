"""The mask goes from the surface stage through the operators to the channel."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy import ndimage

from gipkg.api import Volume
from gipkg.descriptors import describe
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import prepare


def test_the_membrane_in_a_ring_is_marked_and_nothing_else() -> None:
    x, y, z = np.mgrid[-14:15, -14:15, -14:15]
    solid = (np.hypot(x, y) - 9) ** 2 + z**2 < 3.5**2
    surface = prepare(Volume(solid, origin=(-14.0, -14.0, -14.0)), vertices=1500)
    operators = Operators(surface.mesh, mask=surface.mask)
    mask = describe(surface.mesh, "topological-mask", operators)[:, 0]
    assert set(mask) == {0.0, 1.0}
    from_axis = np.linalg.norm(surface.mesh.vertices[:, :2], axis=1)
    assert (mask[from_axis < 4] == 0).all()
    assert (mask[from_axis > 7] == 1).all()
    assert (from_axis < 4).sum() > 20


def test_a_solid_without_holes_is_all_original(pebble) -> None:
    solid = ndimage.gaussian_filter(np.pad(np.ones((5, 6, 7)), 3), 1)
    surface = prepare(Volume(solid))
    operators = Operators(surface.mesh, mask=surface.mask)
    assert (describe(surface.mesh, "topological-mask", operators) == 1).all()
    assert (describe(pebble, "topological-mask") == 1).all()


def test_a_mask_of_another_mesh_is_refused() -> None:
    with pytest.raises(UnsupportedMesh, match="the mask given is of a mesh with 3 vertices"):
        Operators(trimesh.creation.icosahedron(), mask=np.ones(3, bool))
