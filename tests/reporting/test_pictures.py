"""Pictures of stages show the same point in the same colour; a sheet keeps its order."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from gipkg.api import SphericalMap
from gipkg.images.lookup import geometry_image
from gipkg.reporting import pictures
from gipkg.reporting.sheet import COLUMNS, Shown, draw
from tests.support.shapes import icosphere


def middle(panel: np.ndarray) -> np.ndarray:
    """Return the mean colour of the middle of a square picture."""
    low, high = 3 * len(panel) // 8, 5 * len(panel) // 8
    return panel[low:high, low:high].reshape(-1, 3).astype(float).mean(axis=0)


def test_a_point_has_one_colour_on_the_mesh_the_sphere_and_the_image() -> None:
    sphere = icosphere(3)
    flattened = trimesh.Trimesh(sphere.vertices * [1.3, 1.1, 0.7], sphere.faces, process=False)
    picture = pictures.of_map(SphericalMap(flattened, np.asarray(sphere.vertices)), 96)
    assert picture.shape == (96, 288, 3)
    on_mesh, on_sphere, on_image = np.hsplit(picture, 3)
    assert np.abs(middle(on_mesh) - middle(on_sphere)).max() < 8
    # Light falls on solids alone; the image shows the colours as they are.
    shade = middle(on_image) / middle(on_sphere)
    assert np.ptp(shade) < 0.1


def test_faces_that_disagree_about_outside_are_seen_from_both_sides() -> None:
    plate = trimesh.creation.box([1.0, 0.7, 0.01])
    doubled = np.vstack([plate.faces, plate.faces[:, ::-1]])
    soup = trimesh.Trimesh(plate.vertices, doubled, process=False)
    seen, whole = middle(pictures.of_mesh(soup, 64)), middle(pictures.of_mesh(plate, 64))
    assert seen.min() > 100
    assert np.abs(seen - whole).max() < 30


def test_an_image_of_positions_has_its_mesh_beside_it_and_others_a_panel_a_channel() -> None:
    sphere = icosphere(2)
    known = SphericalMap(sphere, np.asarray(sphere.vertices))
    positions = geometry_image(known, sphere.vertices, 16)
    image, mesh = np.hsplit(pictures.of_image(positions, 64), 2)
    assert (mesh[0, 0] == 255).all()
    assert (image < 255).any(axis=2).all()
    panels = np.hsplit(pictures.of_image(positions[:2], 64), 2)
    assert np.unique(panels[0].reshape(-1, 3), axis=0).size > 3
    assert (panels[0] != panels[1]).any()


def test_a_sheet_leaves_the_place_of_what_is_gone_empty(tmp_path: Path) -> None:
    for name in "ab":
        icosphere(1).export(tmp_path / f"{name}.off")
    names = ["a", "gone", "b", "a", "b"]
    figure = draw([Shown(tmp_path / f"{name}.off", name, f"${name}_{{") for name in names])
    figure.canvas.draw()
    places = figure.axes
    assert len(places) == 2 * COLUMNS
    drawn = [bool((place.images[0].get_array() < 250).any()) for place in places[: len(names)]]
    assert drawn == [True, False, True, True, True]
    assert [place.get_title() for place in places[: len(names)]] == names
    assert not any(place.images for place in places[len(names) :])
