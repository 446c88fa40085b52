"""Scenes hold what the page draws, as the reader sees it."""

from __future__ import annotations

from base64 import b64decode

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.reporting.page.scene import Scene, as_data


def numbers(text: str, kind: str = "<f4") -> np.ndarray:
    return np.frombuffer(b64decode(text), dtype=kind)


def test_a_scene_is_the_shape_turned_and_scaled_with_its_sphere(
    ellipsoid_map: SphericalMap,
) -> None:
    mesh = ellipsoid_map.mesh
    turned = Rotation.from_rotvec([1.0, 0.4, -2.0]).apply(ellipsoid_map.sphere)
    weight = np.arange(len(mesh.vertices), dtype=float)
    data = as_data(Scene("egg", "an egg", mesh, {"projection": turned}, {"weight": weight}))

    vertices = numbers(data["vertices"]).reshape(-1, 3)
    assert np.linalg.norm(vertices, axis=1).max() == pytest.approx(1)
    # Half axes of 1, 2 and 4: the longest upward, the shortest to the eye.
    assert np.ptp(vertices, axis=0) == pytest.approx([1, 2, 0.5], abs=1e-3)
    assert (numbers(data["faces"], "<u4").reshape(-1, 3) == mesh.faces).all()

    (projection,) = data["maps"]
    sphere = numbers(projection["sphere"]).reshape(-1, 3)
    # However the map was turned, its sphere shows each point on the side where the shape has it.
    assert sphere == pytest.approx(vertices / [0.5, 1, 0.25], abs=1e-3)
    assert projection["flips"] == 0
    ratio = numbers(projection["ratio"])
    upper = np.abs(vertices[:, 1]).argmax()
    assert ratio[upper] > 1 > 0 > ratio.min()

    channels = {channel["name"]: numbers(channel["values"]) for channel in data["channels"]}
    assert list(channels) == ["weight", "x", "y", "z"]
    assert channels["weight"] == pytest.approx(weight)
    assert channels["y"] == pytest.approx(vertices[:, 1])


@pytest.mark.parametrize("upright", [True, False])
def test_a_shape_of_an_upright_database_stands_however_long_it_is(
    ellipsoid_map: SphericalMap, upright: bool
) -> None:
    lying = ellipsoid_map.mesh.copy()
    lying.vertices = lying.vertices[:, [2, 0, 1]]
    data = as_data(Scene("egg", "", lying, {}, {}, upright))
    upward = numbers(data["vertices"]).reshape(-1, 3)[:, 1]
    like = [abs(np.corrcoef(upward, axis)[0, 1]) for axis in lying.vertices.T]
    assert np.argmax(like) == (2 if upright else 0)
