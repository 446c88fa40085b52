"""From a volume to its surface: topology first, among the voxels, then the mesh."""

from __future__ import annotations

from typing import Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy import ndimage

from gipkg.api import Volume
from gipkg.errors import UnsupportedMesh
from gipkg.surfaces.decimation import decimate
from gipkg.surfaces.report import Report, Step, VolumeCounts, count
from gipkg.surfaces.surface import Surface
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.validation import genus_zero_faults
from gipkg.surfaces.volumes.fairing import fair
from gipkg.surfaces.volumes.lattice import Solid
from gipkg.surfaces.volumes.shrinking import contractible_hull
from gipkg.surfaces.volumes.tetrahedra import lattice_surface
from gipkg.surfaces.volumes.topology import count_topology, fill_cavities, largest_component

MARGIN = 2
"""Empty voxels around the solid."""

BLUR = 0.7
"""Standard deviation, in voxels, of the Gaussian that says where the surface runs: the steps of
solids that are all or nothing are gone, and little else is."""

MOST_VOXELS = 320**3
"""Voxels around the solid at the most: some 100 bytes of memory each."""

FAIRING = 10
"""Rounds of smoothing of the surface, before its vertices become fewer."""


def volume_surface(
    volume: Volume,
    *,
    vertices: int = 3000,
    components: Literal["largest", "joined"] = "largest",
    smallest_part: float = 0.5,
    blur: float = BLUR,
    original: Solid | None = None,
) -> Surface:
    """Make a closed, oriented genus-0 surface of one component out of any solid.

    The topology is settled among the voxels and never changes afterwards: one component is
    kept or all are joined, cavities filled, tunnels closed by membranes one voxel thick where
    they are narrowest. Marching tetrahedra, in the lattice in which all this was decided, put
    the surface on the level of the slightly blurred values, as far as the topology leaves the
    choice. It is smoothed and its edges collapse to the number of vertices asked for.

    Parameters
    ----------
    volume : Volume
        Not changed.
    vertices : int
        Largest number of vertices, at least 4.
    components : {"largest", "joined"}
        Keep the largest component, or join all of them by strands where they come closest.
        Voxels are connected as in :mod:`gipkg.surfaces.volumes.lattice`.
    smallest_part : float
        Least share of the voxels that the largest component must have, if it alone is kept.
    blur : float
        Standard deviation, in voxels, of the Gaussian that the values pass first. None is needed
        where they are distances.
    original : (X, Y, Z) bool array, optional
        Voxels whose border is the original surface, as far as they are solid; all, by default.

    Returns
    -------
    Surface
        In the volume's coordinates. The mask is False at the vertices of membranes and
        strands, and of the border of voxels that are not original; the report counts what was
        found and done.

    Raises
    ------
    UnsupportedMesh
        The volume is no solid, or its largest component is too small a share of it.
    """
    values, cut = _crop(volume)
    solid = values > volume.level
    kept, before, steps = _one_component(solid, components, smallest_part)
    filled = fill_cavities(kept)
    hull = contractible_hull(filled)
    steps += _closing_steps(kept, filled, hull)
    dense, faces, owner = lattice_surface(hull, _depth(values, solid, hull, volume.level, blur))
    given = filled if original is None else filled & np.pad(original, MARGIN)[cut]
    smooth = Triangles(fair(dense, faces, FAIRING), faces, given.ravel()[owner])
    result = decimate(smooth, vertices)
    corner = np.array([side.start for side in cut]) - MARGIN
    points = (result.vertices + corner) * volume.spacing + volume.origin
    mesh = trimesh.Trimesh(points, result.faces, process=False)
    if mesh.volume < 0:
        # A rugged solid reduced to a handful of vertices can be turned inside out by it.
        mesh = trimesh.Trimesh(points, result.faces[:, ::-1], process=False)
    if faults := list(genus_zero_faults(points, np.asarray(mesh.faces))):
        raise UnsupportedMesh(
            f"the surface made of the volume has faults: {'; '.join(faults)}. Another resolution "
            "or more vertices may give one without"
        )
    report = Report(before, count(points, mesh.faces), tuple(steps), "volume")
    return Surface(mesh, result.original, report)


def _crop(volume: Volume) -> tuple[NDArray[np.float32], tuple[slice, ...]]:
    """Cut out the solid with a margin; return also where in the array widened by it."""
    values = np.asarray(volume.values, np.float32)
    if values.ndim != 3:
        raise UnsupportedMesh(f"the volume has {values.ndim} axes; it takes three")
    if not np.isfinite(values).all():
        raise UnsupportedMesh("the volume has values that are not finite; replace them")
    solid = values > volume.level
    if not solid.any():
        raise UnsupportedMesh(f"the volume has no value above its level of {volume.level}")
    least, greatest = float(values.min()), float(values.max())
    # A solid that fills its array has no value of the outside: the greatest one is mirrored.
    empty = least if least <= volume.level else 2 * volume.level - greatest
    padded = np.pad(values, MARGIN, constant_values=empty)
    box = ndimage.find_objects(np.pad(solid, MARGIN).view(np.uint8))[0]
    cut = tuple(slice(side.start - MARGIN, side.stop + MARGIN) for side in box)
    cropped = padded[cut]
    if cropped.size > MOST_VOXELS:
        raise UnsupportedMesh(
            f"the volume has {cropped.size} voxels around its solid, more than {MOST_VOXELS}; "
            "take every second one along each axis"
        )
    return cropped, cut


def _one_component(
    solid: Solid, components: str, smallest_part: float
) -> tuple[Solid, VolumeCounts, list[Step]]:
    """Choose the voxels to work on; return also the counts of all and what was done."""
    before = count_topology(solid)
    if before.components == 1 or components == "joined":
        return solid, before, []
    largest, share = largest_component(solid)
    if share < smallest_part:
        raise UnsupportedMesh(
            f"the largest of the volume's {before.components} components has only {share:.0%} of "
            f"its voxels, less than {smallest_part:.0%}, so most of the shape would be lost. Pass "
            "components='joined' to join them, or smallest_part=0 to keep the largest all the same"
        )
    step = Step("keep largest part", {"dropped parts": before.components - 1, "voxel share": share})
    return largest, before, [step]


def _closing_steps(kept: Solid, filled: Solid, hull: Solid) -> list[Step]:
    """Say what was filled, joined and closed on the way from the voxels kept to the hull."""
    found = count_topology(kept)
    steps = []
    if found.cavities:
        voxels = int(np.count_nonzero(filled & ~kept))
        steps.append(Step("fill cavities", {"cavities": found.cavities, "voxels": voxels}))
    if added := int(np.count_nonzero(hull & ~filled)):
        closed = count_topology(filled)
        name = "join parts and close tunnels" if closed.components > 1 else "close tunnels"
        steps.append(
            Step(name, {"parts": closed.components, "tunnels": closed.tunnels, "voxels": added})
        )
    return steps


def _depth(
    values: NDArray[np.float32], solid: Solid, hull: Solid, level: float, blur: float
) -> NDArray[np.float32]:
    """Return how far the blurred values are above the level, those of the changed voxels set."""
    changed = np.where(hull, values.max(), values.min())
    blurred = ndimage.gaussian_filter(np.where(hull == solid, values, changed), blur)
    return blurred - np.float32(level)
