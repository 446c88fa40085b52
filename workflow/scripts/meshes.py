"""Surfaces and their operators, from the arrays that the earlier stages left in shards."""

from __future__ import annotations

import trimesh
from gipkg.descriptors.operators import Operators, Spectrum
from gipkg.shards import Arrays


def mesh_of(surface: Arrays) -> trimesh.Trimesh:
    """Return a surface as it was prepared, vertex by vertex."""
    return trimesh.Trimesh(surface["vertices"], surface["faces"], process=False)


def operators_of(surface: Arrays, spectrum: Arrays) -> Operators:
    """Return the operators of a surface, its eigenpairs known."""
    return Operators(mesh_of(surface), spectrum=Spectrum(**spectrum))
