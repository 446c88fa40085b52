"""What a surface was before and after preparation, and what was done in between."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from gipkg.surfaces import halfedges
from gipkg.surfaces.distance import Deviation


@dataclass(frozen=True, slots=True)
class Counts:
    """Size and topology of a triangle mesh.

    Attributes
    ----------
    vertices, faces, components, holes : int
        Components are counted across edges of two faces, holes as connected borders.
    genus : int or None
        Number of handles, over all components; None where edges or vertices are not
        manifold or neighbouring faces disagree in orientation.
    """

    vertices: int
    faces: int
    components: int
    holes: int
    genus: int | None


@dataclass(frozen=True, slots=True)
class VolumeCounts:
    """Size and topology of a solid given by voxels.

    Attributes
    ----------
    voxels, components, cavities, tunnels : int
        Tunnels are counted over all components: the genus of their outer surfaces and of
        their cavities'.
    """

    voxels: int
    components: int
    cavities: int
    tunnels: int


def count(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> Counts:
    """Count size and topology of (V, 3) vertices and (F, 3) faces."""
    edges = halfedges.group_edges(faces)
    pairs = edges.pairs()
    components, _ = halfedges.components(faces, pairs)
    origin, target = halfedges.endpoints(faces)
    border = edges.halfedges(edges.count == 1)
    holes = _connected(origin[border], target[border])
    used = len(np.unique(faces))
    oriented = not ((edges.count > 2) | ((edges.count == 2) & (edges.balance != 0))).any()
    genus = None
    if oriented and halfedges.fans(faces, pairs)[0] == used:
        genus = components - (used - len(edges.count) + len(faces) + holes) // 2
    return Counts(len(vertices), len(faces), components, holes, genus)


@dataclass(frozen=True, slots=True)
class Step:
    """One thing that was done, with its figures."""

    name: str
    figures: dict[str, int | float | list[float]]


@dataclass(frozen=True, slots=True)
class Report:
    """What was done, and what came of it.

    Attributes
    ----------
    before : Counts or VolumeCounts
    after : Counts
    steps : tuple of Step
        Those that changed something, in order. A surface that was left as it is has none.
    method : {"none", "repair", "volume"}
        The way that the steps are of.
    reason : str
        Why a mesh was not repaired but went through the volume.
    deviation : Deviation or None
        From the mesh that was given; None where that is the surface, or was a volume.
    """

    before: Counts | VolumeCounts
    after: Counts
    steps: tuple[Step, ...] = field(default_factory=tuple)
    method: Literal["none", "repair", "volume"] = "none"
    reason: str = ""
    deviation: Deviation | None = None

    @property
    def changed(self) -> bool:
        """Whether anything was done."""
        return bool(self.steps)

    def as_dict(self) -> dict[str, Any]:
        """Return the report in plain types, as JSON takes them."""
        return asdict(self) | {"steps": [asdict(step) for step in self.steps]}


def _connected(origin: NDArray[np.int64], target: NDArray[np.int64]) -> int:
    """Count the connected pieces of a set of edges."""
    names, number = np.unique(np.concatenate((origin, target)), return_inverse=True)
    one, two = number.reshape(2, -1)
    return halfedges.label_connected(len(names), one, two)[0]
