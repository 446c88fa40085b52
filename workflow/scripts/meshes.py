"""Surfaces and their operators, from the arrays that the earlier stages left in shards."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import trimesh
from gipkg.api import SphericalMap
from gipkg.descriptors.operators import Operators, Spectrum
from gipkg.shards import Arrays
from gipkg.surfaces import Surface

from shards import Shards


def mesh_of(surface: Arrays) -> trimesh.Trimesh:
    """Return a surface as it was prepared, vertex by vertex."""
    return trimesh.Trimesh(surface["vertices"], surface["faces"], process=False)


def surface_arrays(surface: Surface) -> Arrays:
    """Return what is kept of a prepared surface."""
    return {
        "vertices": np.asarray(surface.mesh.vertices),
        "faces": np.asarray(surface.mesh.faces),
        "mask": surface.mask,
        "report": np.array(json.dumps(surface.report.as_dict())),
    }


def report_of(surface: Arrays) -> dict[str, Any]:
    """Return what the surface stage reports."""
    return json.loads(str(surface["report"]))


def operators_of(surface: Arrays, spectrum: Arrays) -> Operators:
    """Return the operators of a surface, its eigenpairs known."""
    return Operators(mesh_of(surface), spectrum=Spectrum(**spectrum), mask=surface["mask"])


class Maps:
    """The surfaces of a whole database and their maps under one method, read when asked for.

    Attributes
    ----------
    ids : tuple of str
        The shapes that have a map, sorted.
    surfaces : frozenset of str
        The shapes that have a surface.
    failures : dict
        Identifier -> reason, of the shapes that have no map.
    """

    def __init__(self, surfaces: Sequence[str], maps: Sequence[str]) -> None:
        self._surfaces, self._maps = Shards(surfaces), Shards(maps)
        self.ids = tuple(sorted(self._maps))
        self.surfaces = frozenset(self._surfaces)
        self.failures = self._maps.failures

    def report(self, shape_id: str) -> dict[str, Any] | None:
        """Return what the surface stage reports; None where it failed."""
        surface = self._surfaces.get(shape_id)
        return None if surface is None else report_of(surface)

    def mesh(self, shape_id: str) -> trimesh.Trimesh:
        """Return the surface of a shape."""
        return mesh_of(self._surfaces[shape_id])

    def __getitem__(self, shape_id: str) -> SphericalMap:
        return SphericalMap(self.mesh(shape_id), self._maps[shape_id]["sphere"])
