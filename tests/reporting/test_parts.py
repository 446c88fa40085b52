"""The figures of tips and whole surfaces, against a second way to each of them."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest
import pyvista
import trimesh
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.evaluation.distortion import distortion
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.images.lookup import geometry_image, lookup
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.parts import WHOLE, measure
from gipkg.reporting.tips import Tips


def spherical_area(corners: np.ndarray) -> float:
    """Return the area of a spherical triangle by l'Huilier's theorem."""
    sides = [np.arccos(corners[k] @ corners[k - 1]) for k in range(3)]
    half = sum(sides) / 2
    product = np.tan(half / 2) * np.prod([np.tan((half - side) / 2) for side in sides])
    return float(4 * np.arctan(np.sqrt(product)))


@pytest.fixture(scope="module")
def coarse() -> SphericalMap:
    sphere = trimesh.creation.icosphere(subdivisions=2)
    mesh = trimesh.Trimesh(sphere.vertices * [1, 2, 4], sphere.faces, process=False)
    return SphericalMap(mesh, np.asarray(sphere.vertices))


def test_every_figure_is_what_it_says(coarse: SphericalMap) -> None:
    mesh, size = coarse.mesh, 24
    heights = mesh.vertices[:, 2]
    region = np.select([heights > 3, heights < -3], [0, 1], -1)
    tips = Tips(np.array([heights.argmax(), heights.argmin()]), region)
    again = reconstruct(geometry_image(coarse, mesh.vertices, size))
    parts = measure("x", coarse, lookup(coarse, size, Rotation.identity()), again, tips)
    assert [part.part for part in parts] == [WHOLE, "tip 1", "tip 2"]

    on_sphere = np.array([spherical_area(coarse.sphere[face]) for face in mesh.faces])
    one_hot = geometry_image(coarse, np.eye(len(mesh.vertices)), size).argmax(axis=0)
    surface = pyvista.PolyData.from_regular_faces(again.vertices, again.faces)
    points = pyvista.PolyData(np.array(mesh.vertices)).compute_implicit_distance(surface)
    away = np.abs(points["implicit_distance"])
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    masks = [region >= -1, region == 0, region == 1]
    for part, inside in zip(parts, masks, strict=True):
        corners = inside[mesh.faces].sum(axis=1)
        touching = corners > 0
        ratio = (on_sphere / on_sphere.sum()) / (mesh.area_faces / mesh.area)
        expected = {
            "vertices": inside.sum(),
            "mesh_share": corners @ mesh.area_faces / (3 * mesh.area),
            "sphere_share": corners @ on_sphere / (12 * np.pi),
            "area_ratio_std": ratio[touching].std(),
            "flips": 0,
            "pixels": np.isin(one_hot, np.flatnonzero(inside)).sum(),
            "largest_distance": away[inside].max() / diagonal,
            "mean_distance": away[inside].mean() / diagonal,
        }
        found = asdict(part)
        assert {name: found[name] for name in expected} == pytest.approx(expected, rel=1e-6)
        assert part.area_ratio == pytest.approx(part.sphere_share / part.mesh_share)
    whole, *ends = parts
    assert whole.area_ratio_std == pytest.approx(distortion(coarse).face_std)
    assert whole.hausdorff == surface_distance(mesh, again).hausdorff
    assert whole.hausdorff >= whole.largest_distance
    assert all(np.isnan(end.hausdorff) for end in ends)
    assert whole.area_ratio == pytest.approx(1)
    assert all(end.area_ratio > 1.2 for end in ends)  # an ellipsoid is narrow at its ends


def test_flipped_faces_are_counted_where_they_are(coarse: SphericalMap) -> None:
    mesh, size = coarse.mesh, 16
    located = lookup(coarse, size, Rotation.identity())
    again = reconstruct(geometry_image(coarse, mesh.vertices, size))
    folded = coarse.sphere.copy()
    neighbour = mesh.vertex_neighbors[0][0]
    folded[0] = folded[0] + 1.5 * (folded[neighbour] - folded[0])
    folded[0] /= np.linalg.norm(folded[0])
    region = np.full(len(mesh.vertices), -1)
    far = int(np.argmin(coarse.sphere @ coarse.sphere[0]))
    region[0], region[far] = 0, 1
    tips = Tips(np.array([0, far]), region)
    whole, here, there = measure("x", SphericalMap(mesh, folded), located, again, tips)
    assert here.flips == whole.flips > 0
    assert there.flips == 0
