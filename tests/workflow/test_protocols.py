"""Of a database of which some shapes take part, no other shape is in anything that is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gipkg.files import read_csv, read_json
from gipkg.learning.model import load_model
from tests.workflow.workdir import Workdir

PICKY = """
from gipkg.baselines.shapedna import ShapeDNA
from gipkg.errors import UnsupportedMesh


class Picky(ShapeDNA):
    def represent(self, mesh, operators):
        if len(mesh.vertices) % 3 == 0:
            raise UnsupportedMesh("three times a number of vertices")
        return super().represent(mesh, operators)
"""
CLASSES = ["ants", "hands", "spectacles"]
LEARNED = {"parametrizer": "authalic", "descriptors": ["hks"], "network": "shallow"}
CONFIG = {
    "datasets": {
        "tiny": {
            "protocols": {"Some": {"train_per_class": 1, "classes": CLASSES, "shapes_per_class": 3}}
        }
    },
    "max_failures": 40,
    "baselines": {"picky": {"plugin": "picky.py:Picky"}},
    "table1": {
        "columns": [{"column": "Picky", "baseline": "picky"}, {"column": "Ours", **LEARNED}],
        "seeds": [0],
    },
    "beyond": {"databases": [{"database": "tiny", "protocol": "Some"}]},
}


@pytest.fixture(scope="module")
def results(smoke: Workdir, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Results with a protocol more, under which most of the shapes take no part."""
    workdir = smoke.copy(tmp_path_factory.mktemp("protocols"))
    (workdir.path / "picky.py").write_text(PICKY)
    few_shot = "results/datasets/tiny/splits/Train1-0.csv"
    done = workdir.run("results/table1.csv", few_shot, config=CONFIG)
    assert done.returncode == 0, done.stdout
    assert "rule images" not in done.stdout
    return workdir.path / "results"


def split(results: Path, name: str) -> dict[str, dict[str, str]]:
    """Return one split: part -> shape -> class."""
    parts: dict[str, dict[str, str]] = {"train": {}, "test": {}}
    for row in read_csv(results / f"datasets/tiny/splits/{name}.csv"):
        parts[row["part"]][row["id"]] = row["label"]
    return parts


def test_a_split_lists_what_takes_part(results: Path) -> None:
    parts = split(results, "Some-0")
    assert list(parts["train"].values()) == CLASSES
    assert sorted(parts["test"].values()) == sorted(2 * CLASSES)
    assert sum(map(len, split(results, "Tiny1-0").values())) == 40
    # Few training shapes are taken of the shapes of the protocol.
    assert split(results, "Train1-0") == parts


def test_networks_and_baselines_know_its_classes_and_are_asked_about_its_shapes(
    results: Path,
) -> None:
    test = split(results, "Some-0")["test"]
    network = results / "learning/tiny/authalic/hks/standard/shallow"
    assert load_model(network / "Some-0.model.npz").classes == tuple(CLASSES)
    for prediction in (network / "Some-0.npz", results / "baselines/tiny/picky/Some-0.npz"):
        with np.load(prediction) as said:
            assert set(said["classes"]) <= set(CLASSES)
            assert set(said["ids"]) <= set(test)


def test_a_lost_shape_counts_where_it_is_tested(results: Path) -> None:
    lost = set(read_json(results / "failures/baselines/tiny/picky.json", sealed=True))
    for row, tested in (("Some", 6), ("Tiny1", 20)):
        picky, ours = (
            read_json(results / f"evaluation/table1/tiny/{column}/{row}.json", sealed=True)[0]
            for column in ("picky", "ours")
        )
        assert picky["tested"] == ours["tested"] == tested
        assert picky["missing"] == sorted(lost & split(results, f"{row}-0")["test"].keys())
        assert 0 < len(picky["missing"]) < len(lost)
        assert picky["accuracy"] <= 1 - len(picky["missing"]) / tested
        assert ours["missing"] == []


def test_the_note_names_what_takes_part(results: Path) -> None:
    (note,) = [
        line
        for line in (results / "table1.md").read_text().splitlines()
        if "shapes of `tiny` take part" in line
    ]
    assert note.startswith("- **Some**: 9 of the 40 shapes of `tiny` take part: `ants` `")
    parts = split(results, "Some-0")
    assert all(shape_id.partition("-")[2] in note for part in parts.values() for shape_id in part)
