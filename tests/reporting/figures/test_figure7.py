from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gipkg.api import SphericalMap
from gipkg.evaluation.histogram import BINS
from gipkg.evaluation.surface_distance import SurfaceDistance
from gipkg.reporting.figures import figure7
from gipkg.reporting.figures.figure7 import Panel, Reconstruction
from gipkg.reporting.figures.layout import write_png
from tests.support.shapes import ellipsoid, icosphere

WHITE = np.full((8, 8, 3), 255, np.uint8)
KNOWN = Reconstruction(WHITE, SurfaceDistance(0.25, 0.125))
PANELS = [Panel("cat0", WHITE, {"good": KNOWN, "bad": None})]
COUNTS = np.arange(BINS)
HISTOGRAMS = {
    "low": {"good": COUNTS, "bad": COUNTS[::-1]},
    "high": {"good": 2 * COUNTS, "bad": np.zeros(BINS, int)},
}
VARIANCES = {(database, method): 1.5e-7 for database in HISTOGRAMS for method in ("good", "bad")}


def test_a_shape_is_pictured_as_its_images_give_it_back() -> None:
    mesh = ellipsoid(1, 1, 2)
    sphere = np.asarray(icosphere().vertices)
    folded = np.abs(sphere)
    maps = {
        "good": SphericalMap(mesh, sphere),
        "folded": SphericalMap(mesh, folded),
        "none": None,
    }
    coarse, fine = (figure7.reconstruct_panel("egg", mesh, maps, size) for size in (8, 32))
    assert fine.reconstructions["folded"] is None
    assert fine.reconstructions["none"] is None
    again = fine.reconstructions["good"]
    assert again.distance.hausdorff < 0.02 < coarse.reconstructions["good"].distance.hausdorff
    assert again.picture.shape == fine.original.shape
    difference = np.abs(again.picture.astype(int) - fine.original.astype(int))
    # The same shape from the same side: only its outline and shades differ.
    assert 0 < difference.mean() < 3
    assert (fine.original < 200).any()


def test_a_column_for_each_method_and_a_row_for_each_shape_and_database(tmp_path: Path) -> None:
    figure = figure7.draw(PANELS, HISTOGRAMS, VARIANCES)
    assert len(figure.axes) == 3 * 3
    assert [axes.get_title() for axes in figure.axes[:3]] == ["", "good", "bad"]
    assert [axes.get_xlabel() for axes in figure.axes[:3]] == ["cat0", "farthest 25.0%", "no image"]
    (stairs,) = figure.axes[4].patches
    np.testing.assert_allclose(stairs.get_data().values, COUNTS / COUNTS.sum())
    assert "1.5e-07" in figure.axes[4].texts[0].get_text()
    for name in ("one.png", "two.png"):
        write_png(tmp_path / name, figure7.draw(PANELS, HISTOGRAMS, VARIANCES))
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()


def test_the_numbers_shown_are_written_down() -> None:
    rows = list(figure7.histogram_rows(HISTOGRAMS))
    assert len(rows) == 4 * BINS
    assert {len(row) for row in rows} == {len(figure7.HISTOGRAM_HEADER)}
    assert sum(row[-1] for row in rows if row[:2] == ("high", "good")) == 2 * COUNTS.sum()
    assert float(rows[0][2]) == pytest.approx(-2)
    shapes = list(figure7.shape_rows(PANELS))
    assert shapes == [("cat0", "good", "0.25", "0.125"), ("cat0", "bad", "", "")]
    assert len(figure7.SHAPE_HEADER) == 4
