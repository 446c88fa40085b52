"""Figure 1 shows shapes as images; the images are the shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gipkg.api import SphericalMap
from gipkg.images.reconstruct import reconstruct
from gipkg.reporting.figures import figure1
from gipkg.reporting.figures.layout import write_png

SIZE = 24


@pytest.fixture(scope="module")
def imaged(ellipsoid_map: SphericalMap) -> figure1.Imaged:
    mesh = ellipsoid_map.mesh
    return figure1.image(mesh, mesh.vertices[:, 2] < 3.5, ellipsoid_map.sphere, SIZE)


def test_the_pixels_are_the_shape(imaged: figure1.Imaged) -> None:
    rows = figure1.pixel_rows(imaged, imaged)
    assert [(row.row, row.column) for row in rows[SIZE : SIZE + 2]] == [(1, 0), (1, 1)]
    positions = np.array([(row.x, row.y, row.z) for row in rows]).T.reshape(3, SIZE, SIZE)
    again = reconstruct(positions)
    assert again.vertices == pytest.approx(np.asarray(imaged.again.vertices))
    assert again.volume == pytest.approx(imaged.mesh.volume, rel=0.05)
    # The top of the ellipsoid was added, and it alone.
    inside = np.array([row.mask > 0.999 for row in rows])
    outside = np.array([row.mask < 0.001 for row in rows])
    height = positions[2].ravel()
    assert inside.any()
    assert outside.any()
    assert height[inside].max() < 3.5 < height[outside].min()


def test_what_stands_upright_is_seen_so(ellipsoid_map: SphericalMap) -> None:
    mesh, mask = ellipsoid_map.mesh, np.ones(len(ellipsoid_map.mesh.vertices), bool)
    standing, principal = (
        figure1.image(mesh, mask, ellipsoid_map.sphere, SIZE, upright=upright).camera
        for upright in (True, False)
    )
    assert standing.towards_eye == pytest.approx(np.array([1, -2, 0.6]) / np.sqrt(5.36))
    assert abs(principal.towards_eye) == pytest.approx([1, 0, 0], abs=1e-6)


def test_an_ellipsoid_is_most_curved_at_its_long_end(imaged: figure1.Imaged) -> None:
    larger, smaller = imaged.curvatures
    assert (larger >= smaller).all()
    assert (smaller > 0).all()
    height = np.abs(imaged.positions[2])
    assert height.ravel()[smaller.argmax()] > 3.5


def test_what_was_added_is_seen(imaged: figure1.Imaged, tmp_path: Path) -> None:
    row = imaged.row("an ellipsoid")
    assert row.added_vertices == (imaged.mesh.vertices[:, 2] >= 3.5).sum()
    assert 0 < row.added_pixels < SIZE**2 / 4
    assert row.mean < row.hausdorff < 0.05
    write_png(tmp_path / "figure.png", figure1.draw(imaged, imaged, [row, row]))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(float)
    red, green, blue = np.moveaxis(drawn, -1, 0)
    added = (red > 100) & (green < 0.6 * red) & (blue < 0.3 * red)
    below = added[added.shape[0] // 2 :]
    # On the mesh, in the image of the mask, and on what comes back; the rest is grey or blue.
    for part in (slice(0, 1), slice(3, 4), slice(4, 5)):
        columns = np.array_split(below, 5, axis=1)[part]
        assert columns[0].sum() > 200
