"""A faulty mesh to a closed genus-0 surface that keeps its vertices: the steps and their record."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import cleaning, genus, halfedges, holes, parts, slivers, splitting
from gipkg.surfaces.report import Step
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import genus_zero_faults

MOST_PAIRS = 100_000
"""Faces at edges of more than two are compared two by two, so often at the most: where there are
more pairs, the mesh is no surface with faults."""

Figures = dict[str, int | float | list[float]]


def repair(
    mesh: Triangles,
    *,
    merge_tolerance: float,
    smallest_part: float,
    largest_hole: float,
    most_handles: int,
) -> tuple[Triangles, tuple[Step, ...]]:
    """Do what a mesh needs to be a closed, outward oriented genus-0 surface of one component.

    Parameters
    ----------
    mesh : Triangles
    merge_tolerance, smallest_part, largest_hole, most_handles
        As :func:`gipkg.surfaces.prepare` takes them.

    Returns
    -------
    mesh : Triangles
    steps : tuple of Step
        None where nothing was needed.

    Raises
    ------
    UnsupportedMesh
        It cannot be repaired this way; the message says why, and what to do.
    """
    pipeline = _Pipeline(mesh)
    if any(genus_zero_faults(mesh.vertices, mesh.faces)):
        pipeline.clean(merge_tolerance)
        pipeline.take_largest_part(smallest_part)
        pipeline.count("orient faces", "faces", parts.orient_consistently)
        pipeline.count("fill holes", "holes", lambda m: holes.fill_holes(m, largest_hole))
        pipeline.remove_handles(most_handles)
        pipeline.resolve_slivers()
        parts.require_volume(pipeline.mesh, parts.THINNEST)
    else:
        parts.require_volume(mesh, parts.FLAT)
    pipeline.count("turn outward", "faces", parts.orient_outward)
    return pipeline.mesh, tuple(pipeline.steps)


class _Pipeline:
    """The mesh under repair and the record of the steps that changed it."""

    def __init__(self, mesh: Triangles) -> None:
        self.mesh = mesh
        self.steps: list[Step] = []

    def clean(self, merge_tolerance: float) -> None:
        """Merge and split until every edge and vertex is manifold."""
        self.count("remove collapsed faces", "faces", cleaning.remove_collapsed_faces)
        self.count(
            "merge border vertices",
            "vertices",
            lambda m: cleaning.merge_border_vertices(m, merge_tolerance),
        )
        self.count("remove faces collapsed by merging", "faces", cleaning.remove_collapsed_faces)
        self.count("remove duplicate faces", "faces", cleaning.remove_duplicate_faces)
        self.count("remove unused vertices", "vertices", cleaning.remove_unused_vertices)
        self._refuse_crowds()
        self.count("split non-manifold", "added vertices", splitting.split_nonmanifold)

    def take_largest_part(self, smallest_part: float) -> None:
        """Keep the part of the largest area."""
        parts.require_area(self.mesh)
        mesh, dropped, share = parts.largest_part(self.mesh)
        if share < smallest_part:
            raise UnsupportedMesh(
                f"the largest of its {dropped + 1} parts has only {share:.0%} of the area, less "
                f"than {smallest_part:.0%}, so most of the shape would be lost. Join the parts "
                "to one solid, or pass smallest_part=0 to keep the largest all the same"
            )
        if dropped:
            self._record("keep largest part", mesh, {"dropped parts": dropped, "area share": share})

    def remove_handles(self, most: int) -> None:
        """Cut all handles, if they are not too many."""
        found = genus.genus(self.mesh)
        if found > most:
            raise UnsupportedMesh(
                f"its genus is {found}, more than {most}, and every cut takes a search for its "
                "loop. Pass method='volume', or most_handles to cut them all the same"
            )
        mesh, lengths = genus.remove_handles(self.mesh)
        if lengths:
            self._record("cut handles", mesh, {"handles": len(lengths), "loop lengths": lengths})

    def resolve_slivers(self) -> None:
        """Do away with faces without area."""
        mesh, resolved = slivers.resolve_slivers(self.mesh)
        if any(asdict(resolved).values()):
            self._record("resolve slivers", mesh, asdict(resolved))

    def count(
        self, name: str, counted: str, step: Callable[[Triangles], tuple[Triangles, int]]
    ) -> None:
        """Run a step and record it where it changed something."""
        mesh, number = step(self.mesh)
        if number:
            self._record(name, mesh, {counted: number})

    def _refuse_crowds(self) -> None:
        if not len(self.mesh.faces):
            raise UnsupportedMesh("every face names a vertex twice. Export it again")
        count = halfedges.group_edges(self.mesh.faces).count
        crowded = count[count > 2]
        if (crowded * (crowded - 1)).sum() > 2 * MOST_PAIRS:
            raise UnsupportedMesh(
                f"{len(crowded)} edges belong to more than two faces, one of them to "
                f"{crowded.max()}: this is rather a heap of faces than a surface. Pass "
                "method='volume'"
            )

    def _record(self, name: str, mesh: Triangles, figures: Figures) -> None:
        self.mesh = mesh
        self.steps.append(Step(name, figures))
