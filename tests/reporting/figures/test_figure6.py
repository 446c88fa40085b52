"""Figure 6: every cut shows all limbs, each elsewhere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from scipy.spatial.transform import Rotation

import gipkg
from gipkg.api import SphericalMap
from gipkg.images.cuts import standard_cuts
from gipkg.reporting.cut_lines import cut_lines, points_at
from gipkg.reporting.figures import figure6
from gipkg.reporting.figures.layout import write_png


@pytest.fixture(scope="module")
def cuts(hand: trimesh.Trimesh) -> figure6.Cuts:
    return figure6.cut("a hand", hand, gipkg.parametrize(hand).sphere, size=32)


def test_all_cuts_show_all_tips(cuts: figure6.Cuts) -> None:
    views = cuts.views()
    assert len(views) == len(standard_cuts()) * 5
    assert {(view.axis, view.turn) for view in views} == {
        (axis, 60.0 * turn) for axis in figure6.AXES for turn in range(6)
    }
    # An area-preserving map gives every tip its share, wherever it is cut: 20 of 1024 pixels.
    ratios = [view.pixel_ratio for view in views]
    assert min(ratios) > 0.5
    assert max(ratios) < 2
    assert np.mean(ratios) == pytest.approx(1, abs=0.05)
    assert all(abs(view.u) <= 1 and abs(view.v) <= 1 for view in views)
    half_turns = {(view.axis, view.turn, view.part): (view.u, view.v) for view in views}
    for (axis, turn, part), (u, v) in half_turns.items():
        if turn < 180:
            assert half_turns[axis, turn + 180, part] == pytest.approx((-u, -v))


def test_an_upright_shape_is_turned_about_what_is_highest(ellipsoid_map: SphericalMap) -> None:
    upright = figure6.cut_upright("an egg", ellipsoid_map.mesh, ellipsoid_map.sphere, size=33)
    views = upright.views()
    assert [view.turn for view in views] == [30.0 * turn for turn in range(12)]
    assert {(view.shape, view.axis, view.part) for view in views} == {("an egg", "up", "top")}
    for view in views:
        assert (view.u, view.v) == pytest.approx((0, 0), abs=1e-6)
    # The projection of an ellipsoid swells its long end: 2 % of its area is more on the sphere.
    for view in views:
        assert 0.02 < view.pixels / 33**2 < 0.1
        assert view.pixel_ratio == pytest.approx(view.pixels / 33**2 / 0.02, rel=0.02)


def test_cut_lines_run_over_the_surface_from_one_pole(ellipsoid_map: SphericalMap) -> None:
    turn = Rotation.from_rotvec([0.3, 0.2, -0.4])
    lines = cut_lines(ellipsoid_map, turn)
    assert len(lines) == 4
    pole = turn.inv().apply([0.0, 0, -1])
    for line in lines:
        # The map is the projection of the sphere that the ellipsoid is made of.
        directions = line / [1, 2, 4]
        lengths = np.linalg.norm(directions, axis=1)
        assert lengths == pytest.approx(1, abs=0.01)
        assert directions[0] @ pole == pytest.approx(1, abs=0.01)
        assert directions[-1] @ pole == pytest.approx(0, abs=0.01)
    vertices = points_at(ellipsoid_map, 7 * ellipsoid_map.sphere[:20])
    assert vertices == pytest.approx(np.asarray(ellipsoid_map.mesh.vertices[:20]))


def test_the_figure_frames_what_is_padded(cuts: figure6.Cuts, tmp_path: Path) -> None:
    standing = figure6.cut_upright("a hand", cuts.spherical_map.mesh, cuts.spherical_map.sphere, 32)
    write_png(tmp_path / "figure.png", figure6.draw(cuts, standing))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(float)
    colourful = np.ptp(drawn, axis=2) > 60
    for row in np.array_split(colourful, 6, axis=0):
        pictures = np.array_split(row, 7, axis=1)
        assert sum(picture.any() for picture in pictures) >= 4
