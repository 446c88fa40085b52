"""Parametrizers: closed genus-0 mesh to unit sphere (paper, Section 3).

A module here is a method that has a name; a folder is what methods are built from. For all of
them: :mod:`.hierarchy`, the bijective start, and :mod:`.sphere`, the geometry of spherical
triangles, which also proves a map bijective. :mod:`.variational` makes ``authalic`` and
``conformal``, :mod:`.flow` ``authalic-flow`` and ``lie-advection``, :mod:`.unconstrained`
``penalty``, :mod:`.transport` ``optimal-transport``, and :mod:`.cald` ``spharm``.
"""

from __future__ import annotations

from typing import Any

import trimesh

from gipkg import registry
from gipkg.api import Callback, SphericalMap
from gipkg.errors import UnsupportedMesh


def parametrize(
    mesh: trimesh.Trimesh,
    method: str = "authalic",
    *,
    callback: Callback | None = None,
    **parameters: Any,
) -> SphericalMap:
    """Map a closed genus-0 mesh to the unit sphere.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed, oriented, of one component and of genus 0 (see :func:`gipkg.prepare`).
    method : str
        Name of a parametrizer (``gipkg plugins list --kind parametrizer``).
    callback : callable, optional
        Told every :class:`~gipkg.api.Iteration` of an iterative method.
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
    InvalidParameterError
        It has no such parameter, or the value is outside its bounds.
    UnsupportedMesh
        The mesh is outside the method's domain, or none at all.
    ParametrizationError
        The method could not keep what it guarantees.
    """
    if not isinstance(mesh, trimesh.Trimesh):
        raise UnsupportedMesh(
            f"a mesh is needed, not a {type(mesh).__name__}: gipkg.prepare reads files"
        )
    plugin = registry.create("parametrizer", method, parameters)
    return SphericalMap(mesh, plugin.parametrize(mesh, callback))
