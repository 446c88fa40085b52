"""Parametrizers: closed genus-0 mesh to unit sphere (paper, Section 3).

The way of the built-in maps: :mod:`.hierarchy` coarsens the mesh to a tetrahedron,
:mod:`.embedding` refines that on the sphere without a flip, :mod:`.newton` descends the
distortion :mod:`.energy` from there, :mod:`.exact_areas` may remove what is left of it at the
vertices, and :mod:`.spherical_areas` proves the result bijective.
"""

from __future__ import annotations

from typing import Any

import trimesh

from gipkg import registry
from gipkg.api import SphericalMap


def parametrize(mesh: trimesh.Trimesh, method: str = "authalic", **parameters: Any) -> SphericalMap:
    """Map a closed genus-0 mesh to the unit sphere.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented, of one component and of genus 0 (see :func:`gipkg.prepare`).
    method : str
        Name of a parametrizer (``gipkg plugins list --kind parametrizer``).
    **parameters
        Of that parametrizer (``gipkg plugins show NAME``).

    Returns
    -------
    SphericalMap
        The mesh and a unit vector for each of its vertices, in the same order.

    Raises
    ------
    UnknownPluginError
        There is no such parametrizer.
    UnsupportedMesh
        The mesh is outside the method's domain.
    ParametrizationError
        The method could not keep what it guarantees.
    """
    plugin = registry.create("parametrizer", method, parameters)
    return SphericalMap(mesh, plugin.parametrize(mesh))
