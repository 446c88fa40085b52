"""Mesh to per-vertex channels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    import trimesh
    from numpy.typing import NDArray

    from gipkg.descriptors.operators import Operators


def describe(
    mesh: trimesh.Trimesh, name: str = "hks", operators: Operators | None = None, **parameters: Any
) -> NDArray[np.float64]:
    """Compute a descriptor's channels at every vertex.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        V vertices.
    name : str
        A registered descriptor (``gipkg plugins list --kind descriptor``).
    operators : Operators, optional
        Of this mesh, to share eigenpairs between descriptors; made here otherwise.
    **parameters
        The descriptor's fields (``gipkg plugins show hks``).

    Returns
    -------
    (V, C) float64 array

    Raises
    ------
    UnknownPluginError
        No descriptor has that name.
    InvalidParameterError
        It has no such parameter, or the value is outside its bounds.
    UnsupportedMesh
        The operators of the mesh are undefined.
    """
    from gipkg import registry
    from gipkg.descriptors.operators import Operators

    descriptor = registry.create("descriptor", name, parameters)
    return descriptor.describe(mesh, operators or Operators(mesh))


__all__ = ["describe"]
