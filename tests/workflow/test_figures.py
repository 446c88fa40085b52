"""Figures 1 to 6 of a run: pictures, the numbers they show, and where they come from."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.workflow.workdir import Workdir

SHAPES_6 = ("hands-000", "chair-000")
FIGURES = ("figure2", "figure3", "figure4", "figure5", "figure6")


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("figure", FIGURES)
def test_a_figure_is_a_picture_with_numbers_and_provenance(smoke: Workdir, figure: str) -> None:
    results = smoke.path / "results"
    picture = np.asarray(Image.open(results / f"{figure}.png").convert("RGB"))
    assert picture.shape[1] > 1500
    assert 0.1 < (picture < 240).any(axis=2).mean() < 0.9
    assert len(rows(results / f"{figure}.csv")) > 5
    provenance = json.loads((results / f"{figure}.json").read_text())
    assert provenance["shapes"][0] == "hands-000"
    assert provenance["size"] == 64
    assert next(iter(provenance["plugins"]["dataset"])) == "tiny"
    names = provenance["config"]["parametrizers"]
    assert set(provenance["plugins"]["parametrizer"]) == set(names)
    assert provenance["libraries"]["pyvista"]
    assert provenance["gipkg"]["version"]


def test_figure_1_is_the_pixels_of_two_shapes(smoke: Workdir) -> None:
    results = smoke.path / "results"
    shapes = rows(results / "figure1_shapes.csv")
    assert [row["shape"] for row in shapes] == ["teddies-000", "spectacles-000"]
    assert shapes[0]["added_vertices"] == "0"
    assert int(shapes[1]["added_vertices"]) > 0
    assert len(rows(results / "figure1.csv")) == 64 * 64
    picture = np.asarray(Image.open(results / "figure1.png").convert("RGB"))
    assert 0.1 < (picture < 240).any(axis=2).mean() < 0.9
    provenance = json.loads((results / "figure1.json").read_text())
    assert provenance["shapes"] == ["teddies-000", "spectacles-000"]


def test_figure_2_keeps_the_tips_by_area_alone(smoke: Workdir) -> None:
    parts = rows(smoke.path / "results/figure2.csv")
    tips = {
        name: [
            float(row["area_ratio"])
            for row in parts
            if row["parametrizer"] == name and row["part"] != "whole"
        ]
        for name in ("authalic", "conformal")
    }
    assert [len(ratios) for ratios in tips.values()] == [5, 5]
    assert min(tips["authalic"]) > 0.9
    assert max(tips["conformal"]) < 0.1
    whole = {row["parametrizer"]: float(row["hausdorff"]) for row in parts if row["hausdorff"]}
    assert whole["authalic"] < whole["conformal"] / 3


def test_figure_3_ends_with_less_distortion_than_it_began(smoke: Workdir) -> None:
    steps = rows(smoke.path / "results/figure3.csv")
    assert [int(step["iteration"]) for step in steps] == list(range(len(steps)))
    assert float(steps[-1]["variance"]) < 0.3 * float(steps[0]["variance"])
    assert {step["flips"] for step in steps} == {"0"}


def test_figure_4_has_every_vertex(smoke: Workdir) -> None:
    vertices = rows(smoke.path / "results/figure4.csv")
    figure2 = rows(smoke.path / "results/figure2.csv")
    assert len(vertices) == int(figure2[0]["vertices"])
    potential = np.array([float(row["potential"]) for row in vertices])
    assert potential.mean() == pytest.approx(0, abs=1e-9)


def test_figure_6_turns_a_shape_with_limbs_and_an_upright_one(smoke: Workdir) -> None:
    views = rows(smoke.path / "results/figure6.csv")
    turns = {shape: {row["turn"] for row in views if row["shape"] == shape} for shape in SHAPES_6}
    assert [len(found) for found in turns.values()] == [6, 12]
    assert {row["shape"] for row in views} == set(SHAPES_6)


def test_a_shape_that_is_not_there_is_named(smoke: Workdir, tmp_path: Path) -> None:
    workdir = smoke.copy(tmp_path)
    shapes = [{"database": "tiny", "shape": "hands-999"}]
    done = workdir.run("results/figure4.png", config={"figures": {"shapes": shapes}})
    assert done.returncode != 0
    assert "DatasetNotFound: configuration, figures: 'hands-999' has no surface" in done.stdout
