"""What the stage of surfaces hands on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.surfaces.report import Report


@dataclass(frozen=True, slots=True)
class Surface:
    """A closed, outward oriented genus-0 surface of one component, and how it came about.

    Attributes
    ----------
    mesh : trimesh.Trimesh
        V vertices; those that were kept come first and in their order.
    mask : (V,) bool array
        The topological mask: True on the original surface, False at the vertices of what
        was added to close it.
    report : Report
        What was done.
    """

    mesh: trimesh.Trimesh
    mask: NDArray[np.bool_]
    report: Report
