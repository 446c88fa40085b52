"""From any mesh or volume to a closed genus-0 surface: the steps and their record."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import trimesh
from pydantic import ConfigDict, Field, validate_call

from gipkg.api import Volume
from gipkg.errors import UnsupportedMesh
from gipkg.formats.array_faults import array_fault
from gipkg.formats.reading import load_mesh
from gipkg.surfaces import cleaning, genus, holes, parts, slivers, splitting
from gipkg.surfaces.report import Report, Step, count
from gipkg.surfaces.surface import Surface
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import (
    check_genus_zero,
    face_areas,
    genus_zero_faults,
)
from gipkg.surfaces.volumes import volume_surface

Share = Annotated[float, Field(ge=0, le=1)]
Figures = dict[str, int | float | list[float]]


@validate_call(config=ConfigDict(arbitrary_types_allowed=True))
def prepare(
    source: trimesh.Trimesh | Volume | Path | str,
    *,
    merge_tolerance: Share = 1e-7,
    smallest_part: Share = 0.5,
    largest_hole: Share = 0.4,
    components: Literal["largest", "joined"] = "largest",
    vertices: Annotated[int, Field(ge=4)] = 3000,
) -> Surface:
    """Make a closed, oriented genus-0 surface of one component out of a mesh or a volume.

    A volume goes the way of :func:`gipkg.surfaces.volumes.volume_surface`. A mesh that is
    such a surface stays as it is, bit by bit. Otherwise, as far as needed: coinciding border
    vertices are merged, duplicate faces removed, non-manifold edges and vertices split, the
    largest part kept and oriented, holes capped, handles cut along their shortest loop and
    capped, and faces without area resolved. Vertices keep their place, but for those at a
    cut, whose two copies draw apart by a hundredth of an edge, and those of faces without
    area.

    Parameters
    ----------
    source : trimesh.Trimesh or Volume or Path or str
        A mesh or a volume, which is not changed, or the file of a mesh.
    merge_tolerance : float
        Largest distance of border vertices that are merged, as a share of the bounding
        box's diagonal.
    smallest_part : float
        Least area, or volume, of the largest part, as a share of all parts'; the others are
        dropped.
    largest_hole : float
        Largest area of the cap over a hole, as a share of the closed surface's.
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
        It cannot be repaired this way; the message says why, and what to do.
    """
    if isinstance(source, Volume):
        return volume_surface(
            source, vertices=vertices, components=components, smallest_part=smallest_part
        )
    mesh = source if isinstance(source, trimesh.Trimesh) else load_mesh(source)
    name = mesh.metadata.get("file_name") or "the mesh"
    points = np.array(mesh.vertices, np.float64)
    faces = np.array(mesh.faces, np.int64)
    if fault := array_fault(points, faces):
        raise UnsupportedMesh(f"{name} is not a triangle mesh: {fault}. Correct its arrays")
    pipeline = _Pipeline(Triangles(points, faces, np.ones(len(points), bool)))
    before = count(points, faces)
    try:
        pipeline.run(merge_tolerance, smallest_part, largest_hole)
    except UnsupportedMesh as error:
        raise UnsupportedMesh(f"{name}: {error}") from error
    result, steps = pipeline.mesh, tuple(pipeline.steps)
    after = count(result.vertices, result.faces) if steps else before
    prepared = trimesh.Trimesh(
        result.vertices, result.faces, process=False, metadata={"file_name": str(name)}
    )
    if steps:
        check_genus_zero(prepared)
    return Surface(prepared, result.original, Report(before, after, steps))


class _Pipeline:
    """The mesh under repair and the record of the steps that changed it."""

    def __init__(self, mesh: Triangles) -> None:
        self.mesh = mesh
        self.steps: list[Step] = []

    def run(self, merge_tolerance: float, smallest_part: float, largest_hole: float) -> None:
        """Do what is needed, in order."""
        if any(genus_zero_faults(self.mesh.vertices, self.mesh.faces)):
            self._clean(merge_tolerance)
            self._take_largest_part(smallest_part)
            self._count("orient faces", "faces", parts.orient_consistently)
            self._count("fill holes", "holes", lambda m: holes.fill_holes(m, largest_hole))
            self._remove_handles()
            self._resolve_slivers()
            parts.require_volume(self.mesh)
        self._count("turn outward", "faces", parts.orient_outward)

    def _clean(self, merge_tolerance: float) -> None:
        self._count("remove collapsed faces", "faces", cleaning.remove_collapsed_faces)
        self._count(
            "merge border vertices",
            "vertices",
            lambda m: cleaning.merge_border_vertices(m, merge_tolerance),
        )
        self._count("remove faces collapsed by merging", "faces", cleaning.remove_collapsed_faces)
        self._count("remove duplicate faces", "faces", cleaning.remove_duplicate_faces)
        self._count("remove unused vertices", "vertices", cleaning.remove_unused_vertices)
        self._count("split non-manifold", "added vertices", splitting.split_nonmanifold)

    def _take_largest_part(self, smallest_part: float) -> None:
        if not face_areas(self.mesh.vertices, self.mesh.faces).any():
            raise UnsupportedMesh("its faces have no area at all. Export it again from its source")
        mesh, dropped, share = parts.largest_part(self.mesh)
        if share < smallest_part:
            raise UnsupportedMesh(
                f"the largest of its {dropped + 1} parts has only {share:.0%} of the area, less "
                f"than {smallest_part:.0%}, so most of the shape would be lost. Join the parts "
                "to one solid, or pass smallest_part=0 to keep the largest all the same"
            )
        if dropped:
            self._record("keep largest part", mesh, {"dropped parts": dropped, "area share": share})

    def _remove_handles(self) -> None:
        mesh, lengths = genus.remove_handles(self.mesh)
        if lengths:
            self._record("cut handles", mesh, {"handles": len(lengths), "loop lengths": lengths})

    def _resolve_slivers(self) -> None:
        mesh, resolved = slivers.resolve_slivers(self.mesh)
        if any(asdict(resolved).values()):
            self._record("resolve slivers", mesh, asdict(resolved))

    def _count(
        self, name: str, counted: str, step: Callable[[Triangles], tuple[Triangles, int]]
    ) -> None:
        """Run a step and record it where it changed something."""
        mesh, number = step(self.mesh)
        if number:
            self._record(name, mesh, {counted: number})

    def _record(self, name: str, mesh: Triangles, figures: Figures) -> None:
        self.mesh = mesh
        self.steps.append(Step(name, figures))
