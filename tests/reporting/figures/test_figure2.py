"""Figure 2 shows each method's map of one shape, and says in numbers what is seen."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from scipy.spatial.transform import Rotation

import gipkg
from gipkg.api import SphericalMap
from gipkg.reporting.cameras import principal_camera
from gipkg.reporting.colours import category
from gipkg.reporting.figures import figure2
from gipkg.reporting.figures.appearance import RoundSphere, facing
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.tips import limb_tips


@pytest.fixture(scope="module")
def comparison(hand: trimesh.Trimesh) -> figure2.Comparison:
    sphere = gipkg.parametrize(hand).sphere
    return figure2.compare(
        hand, {"even": sphere, "uneven": shrunk(sphere, limb_tips(hand).vertex[0])}, size=32
    )


def shrunk(sphere: np.ndarray, vertex: int) -> np.ndarray:
    """Apply the Möbius map that shrinks what is around a vertex tenfold."""
    pole = sphere[vertex]
    height = (sphere @ pole)[:, None]
    plane = 0.1 * (sphere - height * pole) / (1 + height).clip(1e-9)
    square = (plane**2).sum(axis=1, keepdims=True)
    return (2 * plane + (1 - square) * pole) / (1 + square)


def test_the_rows_are_the_whole_and_the_tips_of_every_method(
    comparison: figure2.Comparison,
) -> None:
    names = ["whole", *(f"tip {number}" for number in range(1, 6))]
    assert [part.part for part in comparison.parts] == 2 * names
    assert [part.parametrizer for part in comparison.parts] == 6 * ["even"] + 6 * ["uneven"]
    even, uneven = comparison.parts[1:6], comparison.parts[7:]
    assert min(part.area_ratio for part in even) > 0.9
    assert uneven[0].area_ratio < 0.05
    assert uneven[0].pixels < 3 < min(part.pixels for part in even)
    assert comparison.parts[0].hausdorff < comparison.parts[6].hausdorff


def test_what_is_lost_is_not_in_the_picture(comparison: figure2.Comparison, tmp_path: Path) -> None:
    write_png(tmp_path / "figure.png", figure2.draw(comparison))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(float)
    colour = category(0) / np.linalg.norm(category(0))
    likeness = drawn @ colour / np.maximum(np.linalg.norm(drawn, axis=2), 1)
    # In the lower row, the right four fifths: the upper one has the tip on sphere and image.
    half, left = drawn.shape[0] // 2, drawn.shape[1] // 4
    is_tip = (likeness > 0.998)[:, left:] & (np.ptp(drawn, axis=2) > 40)[:, left:]
    assert is_tip[:half].sum() > 2000
    assert is_tip[half:].sum() < 0.2 * is_tip[:half].sum()


def test_spheres_are_turned_as_the_mesh_is_seen(ellipsoid_map: SphericalMap) -> None:
    camera = principal_camera(ellipsoid_map.mesh.vertices)
    turn = Rotation.from_rotvec([0.4, -1.2, 0.7])
    turned = SphericalMap(ellipsoid_map.mesh, turn.apply(ellipsoid_map.sphere))
    axes = np.stack([np.cross(camera.up, camera.towards_eye), camera.up, camera.towards_eye])
    expected = ellipsoid_map.sphere @ axes.T
    assert facing(turned, camera).apply(turned.sphere) == pytest.approx(expected, abs=1e-6)


def test_a_round_sphere_carries_colours_of_vertices_and_faces(ellipsoid_map: SphericalMap) -> None:
    sphere = RoundSphere.of(ellipsoid_map)
    mesh = sphere.mesh()
    assert np.linalg.norm(mesh.vertices, axis=1) == pytest.approx(1)
    assert mesh.area == pytest.approx(4 * np.pi, rel=1e-3)
    carried = sphere.colours(ellipsoid_map.sphere)
    assert carried == pytest.approx(mesh.vertices, abs=0.01)
    of_faces = sphere.face_colours(ellipsoid_map.sphere[ellipsoid_map.mesh.faces].mean(axis=1))
    assert np.linalg.norm(of_faces - mesh.vertices, axis=1).max() < 0.15
