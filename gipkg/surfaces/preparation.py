"""From any mesh or volume to a closed genus-0 surface."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, validate_call

from gipkg.api import Volume
from gipkg.errors import UnsupportedMesh
from gipkg.formats.array_faults import array_fault
from gipkg.formats.mesh_reading import read_mesh
from gipkg.surfaces.distance import deviation
from gipkg.surfaces.parts import require_area
from gipkg.surfaces.repair import repair
from gipkg.surfaces.report import Report, Step, count
from gipkg.surfaces.soups import soup_surface
from gipkg.surfaces.surface import Surface
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import genus_zero_faults
from gipkg.surfaces.volumes import volume_surface

Share = Annotated[float, Field(ge=0, le=1)]

SMALLEST, LARGEST = 1e-50, 1e50
"""Longest side of the box around a mesh whose areas and volumes can be computed."""

SHARPEST = 1e-7
"""Least precision of the coordinates, as a share of that side."""


@validate_call(config=ConfigDict(arbitrary_types_allowed=True))
def prepare(
    source: trimesh.Trimesh | Volume | Path | str,
    *,
    method: Literal["auto", "repair", "volume"] = "auto",
    merge_tolerance: Share = 1e-7,
    smallest_part: Share = 0.5,
    largest_hole: Share = 0.4,
    largest_loss: Share = 0.01,
    most_handles: Annotated[int, Field(ge=0)] = 30,
    most_faces: Annotated[int, Field(ge=1)] = 1_000_000,
    resolution: Annotated[int, Field(ge=10, le=300)] = 100,
    components: Literal["largest", "joined"] = "largest",
    vertices: Annotated[int, Field(ge=4)] = 3000,
) -> Surface:
    """Make a closed, oriented genus-0 surface of one component out of a mesh or a volume.

    A mesh that is such a surface stays as it is, bit by bit. Others are made one in one of
    two ways:

    repair
        As far as needed: coinciding border vertices are merged, duplicate faces removed,
        non-manifold edges and vertices split, the largest part kept and oriented, holes capped,
        handles cut along their shortest loop and capped, and faces without area resolved.
        Vertices keep their place, but for those at a cut, whose two copies draw apart by a
        hundredth of an edge, and those of faces without area.
    volume
        The mesh becomes a solid of voxels (:mod:`gipkg.surfaces.soups`), whatever its faces are
        like, and the solid a surface as a volume does
        (:func:`gipkg.surfaces.volumes.volume_surface`).

    Parameters
    ----------
    source : trimesh.Trimesh or Volume or Path or str
        A mesh or a volume, which is not changed, or the file of a mesh.
    method : {"auto", "repair", "volume"}
        How a mesh is treated. ``auto`` repairs, and takes the volume where that is impossible or
        loses parts of the shape. ``volume`` remakes accurate surfaces, too.
    merge_tolerance : float
        Largest distance of border vertices that are merged, as a share of the bounding
        box's diagonal.
    smallest_part : float
        Least area, or volume, of the largest part, as a share of all parts'; the others are
        dropped.
    largest_hole : float
        Largest area of the cap over a hole, as a share of the closed surface's.
    largest_loss : float
        Largest share of the area of what was given that ``auto`` lets a repair lose: what is
        farther than 2 % of the bounding box's diagonal from the surface.
    most_handles : int
        Most handles that repair cuts.
    most_faces : int
        Most faces of a mesh that is left as it is or repaired. The volume takes ten million.
    resolution : int
        Voxels along the longest side of a mesh that goes through the volume.
    components : {"largest", "joined"}
        What becomes of a volume of several parts: the largest is kept, or strands join them.
    vertices : int
        Largest number of vertices of a volume's surface.

    Returns
    -------
    Surface

    Raises
    ------
    MeshFormatError
        The file is not readable as a mesh.
    UnsupportedMesh
        It bounds no solid, or is too large; the message says why, and what to do.
    """
    remake = partial(
        _remake,
        resolution=resolution,
        vertices=vertices,
        components=components,
        smallest_part=smallest_part,
    )
    if isinstance(source, Volume):
        return volume_surface(
            source, vertices=vertices, components=components, smallest_part=smallest_part
        )
    given = source if isinstance(source, trimesh.Trimesh) else read_mesh(source)
    name = str(given.metadata.get("file_name") or "the mesh")
    with _naming(name):
        mesh = _triangles(given)
        if method == "volume":
            return remake(mesh, name, reason="asked for")
        if len(mesh.faces) > most_faces:
            raise UnsupportedMesh(
                f"it has {len(mesh.faces)} faces, more than {most_faces}. Decimate it, pass "
                "method='volume' to make a surface of fewer faces, or raise most_faces"
            )
        try:
            result, steps = repair(
                mesh,
                merge_tolerance=merge_tolerance,
                smallest_part=smallest_part,
                largest_hole=largest_hole,
                most_handles=most_handles,
            )
            surface = _repaired(mesh, result, steps, name)
        except UnsupportedMesh as error:
            if method == "repair":
                raise
            return remake(mesh, name, reason=str(error))
        apart = surface.report.deviation
        if method == "auto" and apart and apart.missing > largest_loss:
            return remake(mesh, name, reason=f"repair loses {apart.missing:.1%} of the area")
        return surface


@contextmanager
def _naming(name: str) -> Iterator[None]:
    """Begin the messages of errors with the name of the mesh."""
    try:
        yield
    except UnsupportedMesh as error:
        raise UnsupportedMesh(f"{name}: {error}") from error


def _triangles(mesh: trimesh.Trimesh) -> Triangles:
    """Take over the arrays of a mesh that can be computed with."""
    points = np.array(mesh.vertices, np.float64).reshape(-1, 3)
    faces = np.array(mesh.faces, np.int64).reshape(-1, 3)
    if fault := array_fault(points, faces):
        raise UnsupportedMesh(f"it is not a triangle mesh: {fault}. Correct its arrays")
    used = points[np.unique(faces)]
    with np.errstate(over="ignore"):
        side = float(np.ptp(used, axis=0).max())
    if side and not SMALLEST <= side <= LARGEST:
        raise UnsupportedMesh(
            f"the longest side of the box around it is {side:.3g}. Scale it to between "
            f"{SMALLEST:g} and {LARGEST:g}"
        )
    if side and np.spacing(np.abs(used).max()) > SHARPEST * side:
        raise UnsupportedMesh(
            f"its size is {side:.3g}, but it lies {np.abs(used).max():.3g} away from the origin, "
            "where numbers are too coarse for its shape. Move it to the origin at its source"
        )
    triangles = Triangles(points, faces, np.ones(len(points), bool))
    require_area(triangles)
    return triangles


def _repaired(given: Triangles, result: Triangles, steps: tuple[Step, ...], name: str) -> Surface:
    """Check what the repair made, and report it."""
    mesh = _named(result.vertices, result.faces, name)
    before = count(given.vertices, given.faces)
    if not steps:
        return Surface(mesh, result.original, Report(before, before))
    if faults := list(genus_zero_faults(result.vertices, result.faces)):
        raise UnsupportedMesh(
            f"the repair left faults: {'; '.join(faults)}. method='volume' remakes the mesh"
        )
    after = count(result.vertices, result.faces)
    report = Report(before, after, steps, "repair", deviation=deviation(given, result))
    return Surface(mesh, result.original, report)


def _remake(
    given: Triangles,
    name: str,
    reason: str,
    resolution: int,
    vertices: int,
    components: Literal["largest", "joined"],
    smallest_part: float,
) -> Surface:
    """Send a mesh through the volume, and report it."""
    surface, steps = soup_surface(given, resolution, vertices, components, smallest_part)
    mesh = _named(surface.mesh.vertices, surface.mesh.faces, name)
    made = Triangles(np.asarray(mesh.vertices), np.asarray(mesh.faces), surface.mask)
    report = Report(
        count(given.vertices, given.faces),
        surface.report.after,
        steps,
        "volume",
        reason,
        deviation(given, made),
    )
    return Surface(mesh, surface.mask, report)


def _named(vertices: NDArray[np.float64], faces: NDArray[np.int64], name: str) -> trimesh.Trimesh:
    return trimesh.Trimesh(vertices, faces, process=False, metadata={"file_name": name})
