"""Which way is up, for baselines that turn a shape about its upright axis."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from gipkg.baselines.solids import principal_frame

if TYPE_CHECKING:
    import trimesh

Upright = Annotated[
    Literal["principal", "z"],
    Field(
        description="What stands upright: the longest principal axis of the solid, or the z axis "
        "of the database"
    ),
]
"""The longest principal axis of the solid, its heavier tail above, or the z axis."""


def stand(mesh: trimesh.Trimesh, upright: Upright) -> trimesh.Trimesh:
    """Turn a mesh so that what is to stand upright is its z axis; the mesh is not changed.

    Raises
    ------
    UnsupportedMesh
        A principal axis is to stand upright, but the mesh encloses no positive volume.
    """
    if upright == "z":
        return mesh
    mesh = mesh.copy()
    mesh.vertices = mesh.vertices @ principal_frame(mesh)
    return mesh
