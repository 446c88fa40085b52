"""What the page's view turns and cuts: surfaces, their spheres and their channels, as data."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.evaluation.distortion import Distortion, distortion
from gipkg.reporting.cameras import principal_camera, standing_camera
from gipkg.reporting.figures.appearance import as_seen, facing
from gipkg.surfaces.areas import at_vertices

RATIO = "area ratio (log2)"
"""The channel that every map has of its own."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A shape to be looked at.

    Attributes
    ----------
    name : str
    note : str
        What it is, for readers.
    mesh : trimesh.Trimesh
        V vertices.
    spheres : mapping
        Parametrizer -> unit vectors (V, 3).
    channels : mapping
        Name -> values (V,).
    upright : bool
        The z axis points up, and is to be seen so.
    """

    name: str
    note: str
    mesh: trimesh.Trimesh
    spheres: Mapping[str, NDArray[np.float64]]
    channels: Mapping[str, NDArray[np.floating]]
    upright: bool = False


def as_data(scene: Scene) -> dict[str, Any]:
    """Pack a scene for the page: plain types, and arrays as base64 of little-endian numbers.

    The mesh is moved to its middle, scaled to the unit ball and turned as it is seen best: x to
    the right, y upward, z to the eye; each sphere is turned with it. The area ratio of every map
    comes with it, in the order of the vertices (`RATIO`).
    """
    faces = np.asarray(scene.mesh.faces)
    look_at = standing_camera if scene.upright else principal_camera
    camera = look_at(np.asarray(scene.mesh.vertices))
    seen = as_seen(scene.mesh, camera)
    seen = seen / np.linalg.norm(seen, axis=1).max()
    coordinates = dict(zip("xyz", seen.T, strict=True))
    maps = []
    for name, sphere in scene.spheres.items():
        spherical_map = SphericalMap(scene.mesh, sphere)
        turned: Rotation = facing(spherical_map, camera)
        measured = distortion(spherical_map)
        maps.append(
            {
                "name": name,
                "sphere": _packed(turned.apply(sphere), "<f4"),
                "ratio": _packed(_vertex_ratio(measured, faces), "<f4"),
                "std": measured.face_std,
                "flips": measured.flips,
            }
        )
    return {
        "name": scene.name,
        "note": scene.note,
        "vertices": _packed(seen, "<f4"),
        "faces": _packed(faces, "<u4"),
        "maps": maps,
        "channels": [
            {"name": name, "values": _packed(values, "<f4")}
            for name, values in {**scene.channels, **coordinates}.items()
        ],
    }


def _vertex_ratio(measured: Distortion, faces: NDArray[np.integer]) -> NDArray[np.float64]:
    """Return log2 of sphere over mesh area (V,) of what is around each vertex, cut off at ±4."""
    on_sphere, on_mesh = (
        at_vertices(areas, faces, int(faces.max()) + 1)
        for areas in (measured.spherical_areas, measured.mesh_areas)
    )
    return np.log2((on_sphere / on_mesh).clip(2.0**-4, 2.0**4))


def _packed(array: NDArray[Any], kind: str) -> str:
    return b64encode(np.ascontiguousarray(array, dtype=kind).tobytes()).decode()
