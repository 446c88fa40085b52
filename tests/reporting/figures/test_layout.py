"""Pages are pictures of the size asked for, and the same bytes every time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gipkg.reporting.colours import category, diverging, sequential
from gipkg.reporting.figures.layout import RESOLUTION, as_picture, page, panel, pixels, write_png


def test_a_panel_shows_its_picture(tmp_path: Path) -> None:
    image = np.zeros((3, 40, 40))
    image[0, :20], image[2, 20:] = 1.5, 1.0  # red above, blue below; beyond 1 is 1
    figure = page(2, 2)
    panel(figure.subplots(), as_picture(image), "title", "note")
    write_png(tmp_path / "a.png", figure)
    drawn = np.asarray(Image.open(tmp_path / "a.png").convert("RGB"))
    assert drawn.shape[:2] == pixels(2, 2)[::-1] == (2 * RESOLUTION, 2 * RESOLUTION)
    red, blue = (drawn == [255, 0, 0]).all(axis=2), (drawn == [0, 0, 255]).all(axis=2)
    assert red.sum() == pytest.approx(blue.sum(), rel=0.02)
    assert (red | blue).sum() > 0.5 * red.size
    assert np.argwhere(red)[:, 0].max() < np.argwhere(blue)[:, 0].min()


def test_the_same_page_is_the_same_file(tmp_path: Path) -> None:
    for name in ("a.png", "b.png"):
        figure = page(1, 1)
        figure.subplots().plot([0, 1], [1, 0])
        write_png(tmp_path / name, figure)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_scales_have_their_ends_and_middle() -> None:
    low, middle, high = diverging(np.array([-2.0, 0.0, 2.0]), 2.0)
    assert low[2] > low[0]
    assert high[0] > high[2]
    assert middle.min() > 0.95
    assert np.array_equal(diverging(np.array([-9.0, 9.0]), 2.0), [low, high])
    brightness = sequential(np.linspace(3, 7, 50)) @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(brightness) > 0).all()
    assert np.array_equal(sequential(np.full(2, 5.0)), sequential(np.zeros(2)))
    assert len({tuple(category(number)) for number in range(7)}) == 7
