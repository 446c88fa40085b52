"""A body with limbs, small enough to be measured in other ways."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from gipkg.api import SphericalMap
from gipkg.datasets.articulated import Articulated


@pytest.fixture(scope="session")
def hand() -> trimesh.Trimesh:
    """A hand of some 300 vertices."""
    return Articulated(min_vertices=300, max_vertices=320).load(Path(), "hands-000")


@pytest.fixture(scope="session")
def ellipsoid_map() -> SphericalMap:
    """An ellipsoid of half axes 1, 2 and 4, under the projection of the sphere it is made of."""
    sphere = trimesh.creation.icosphere(subdivisions=3)
    stretched = trimesh.Trimesh(sphere.vertices * [1, 2, 4], sphere.faces, process=False)
    return SphericalMap(stretched, np.asarray(sphere.vertices))
