"""From a polygon soup to its surface."""

from __future__ import annotations

from typing import Literal

from gipkg.errors import UnsupportedMesh
from gipkg.formats.limits import MOST_FACES
from gipkg.surfaces.report import Step
from gipkg.surfaces.soups.voxelisation import voxelise
from gipkg.surfaces.surface import Surface
from gipkg.surfaces.triangles import Triangles
from gipkg.surfaces.volumes import volume_surface


def soup_surface(
    soup: Triangles,
    resolution: int,
    vertices: int,
    components: Literal["largest", "joined"],
    smallest_part: float,
) -> tuple[Surface, tuple[Step, ...]]:
    """Make a closed genus-0 surface of any triangles, through voxels.

    Parameters
    ----------
    soup : Triangles
        Of some area.
    resolution : int
        Voxels along the longest side of its box.
    vertices, components, smallest_part
        As :func:`gipkg.surfaces.volumes.volume_surface` takes them.

    Returns
    -------
    surface : Surface
        Its mask is True on what lies on a triangle.
    steps : tuple of Step
        What was done, voxelisation included.

    Raises
    ------
    UnsupportedMesh
        The largest of its components is too small a share of it, or its faces are too many.
    """
    if len(soup.faces) > MOST_FACES:
        raise UnsupportedMesh(
            f"it has {len(soup.faces)} faces, more than {MOST_FACES}. Decimate it"
        )
    soup = soup.compact()
    volume, original = voxelise(soup.vertices, soup.faces, resolution)
    surface = volume_surface(
        volume,
        vertices=vertices,
        components=components,
        smallest_part=smallest_part,
        blur=0,
        original=original,
    )
    voxels = Step("voxelise", {"resolution": resolution, "voxel side": volume.spacing})
    return surface, (voxels, *surface.report.steps)
