"""Figure 5: coordinates turn with a shape, the heat kernel signature does not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from gipkg import registry
from gipkg.errors import UnsupportedMesh
from gipkg.reporting.articulation import bend, stretching
from gipkg.reporting.figures import figure5
from gipkg.reporting.figures.layout import write_png


@pytest.fixture(scope="module")
def properties(hand: trimesh.Trimesh) -> figure5.Properties:
    return figure5.compare(hand, registry.create("parametrizer", "authalic"), size=32)


def test_the_claims_are_what_the_paper_says(properties: figure5.Properties) -> None:
    values = {claim.claim: claim.value for claim in properties.claims()}
    # The shape is turned and mapped anew; the image turns with it, and y changes its sign.
    assert values["half turn: y against flipped y, correlation"] == pytest.approx(-1, abs=1e-3)
    assert values["half turn: HKS against flipped HKS, correlation"] == pytest.approx(1, abs=1e-3)
    # The bend moves the limbs and hardly stretches them: the signature stays at its vertices.
    assert values["bend: z of the vertices, correlation"] < 0.9
    assert values["bend: HKS of the vertices, correlation"] > 0.99
    assert values["padding: largest step over largest inside the image"] == pytest.approx(1)


def test_the_figure_has_a_red_cut(properties: figure5.Properties, tmp_path: Path) -> None:
    write_png(tmp_path / "figure.png", figure5.draw(properties))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(float)
    red = (drawn[..., 0] > 100) & (drawn[..., 1:] < 0.25 * drawn[..., :1]).all(axis=-1)
    rows, columns = np.nonzero(red[: red.shape[0] // 3, : red.shape[1] // 2])
    assert len(rows) > 300
    assert columns.min() > red.shape[1] / 6


def test_a_bend_keeps_the_middle_and_moves_the_ends(hand: trimesh.Trimesh) -> None:
    bent = bend(hand, [0, 0, 1], 0.5)
    moved = np.linalg.norm(bent.vertices - hand.vertices, axis=1)
    assert (moved < 1e-9).mean() > 0.1
    assert moved.max() > 0.05 * np.linalg.norm(np.ptp(hand.vertices, axis=0))
    assert 0.0 < stretching(hand, bent) < stretching(hand, bend(hand, [0, 0, 1], 1.0)) < 0.2
    assert stretching(hand, hand) == 0.0


def test_a_ball_has_nothing_to_bend() -> None:
    with pytest.raises(UnsupportedMesh, match="no limbs"):
        bend(trimesh.creation.icosphere(subdivisions=2), [0, 0, 1], 0.5)
