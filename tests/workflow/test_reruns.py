"""What is done again after a change, and what is not."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path

import pytest

from tests.workflow.workdir import REPOSITORY, Workdir

AT_THE_END = {"page": 1, "all": 1}

OF_TABLE_1 = {"precision_recall": 1, "score_table": 1}
"""What shows the scores of Table 1: itself, and Figure 8."""

AFTER_IMAGES = {
    **{"images": 5, "complete": 2, "learn": 5, "evaluate": 5, **OF_TABLE_1},
    **{"predict_perturbed": 1, "table_beyond": 1},
}
"""Jobs that make or depend on images of the HKS: two shards of two parametrizers and, of one, the
test shapes with a fault; two seeds, and one training with a shape a class. Evaluated are the two
columns, and three settings beyond the paper."""

EXTENT = '''
from typing import ClassVar

import numpy as np
from pydantic import Field

from gipkg.baselines.vectors import VectorBaseline


class Extent(VectorBaseline):
    """Proportions of the box along the principal axes."""

    summary: ClassVar[str] = "Proportions of the box along the principal axes"
    citation: ClassVar[str] = "none"

    power: float = Field(1.0, gt=0, description="Power that the proportions are raised to.")

    def represent(self, mesh, operators):
        centred = mesh.vertices - mesh.vertices.mean(axis=0)
        axes = np.linalg.svd(centred, full_matrices=False)[2]
        extent = np.sort(np.ptp(centred @ axes.T, axis=0))
        return (extent / extent[-1]) ** self.power
'''

DRAWN = {f"figure{number}": 1 for number in range(2, 7)}
"""What shows one shape, and maps it by itself."""

AFTER_MAPS = {"table_distortion": 1, "table_reconstruction": 1, "figure7": 1}


def test_a_descriptors_parameter_leaves_maps_and_baselines_alone(smoke: Workdir) -> None:
    planned = smoke.planned({"descriptors": {"hks": {"plugin": "hks", "times": 7}}})
    assert planned == {"describe": 3, "scenes": 1, **AFTER_IMAGES, **AT_THE_END}


def test_a_parametrizers_parameter_touches_its_own_columns(smoke: Workdir) -> None:
    changed = {"conformal": {"plugin": "conformal", "max_iterations": 7}}
    planned = smoke.planned({"parametrizers": changed})
    column = {"images": 2, "complete": 1, "learn": 2, "evaluate": 1, **OF_TABLE_1}
    of_the_map = {"distort": 1, "reconstruct": 1, **AFTER_MAPS, "figure2": 1, "figure4": 1}
    assert planned == {"parametrize": 2, **of_the_map, **column, "scenes": 1, **AT_THE_END}


def test_another_way_to_measure_distortion_maps_nothing_again(smoke: Workdir) -> None:
    planned = smoke.planned({"reconstruction": {"sizes": [16]}})
    assert planned == {"reconstruct": 2, "table_reconstruction": 1, **AT_THE_END}
    planned = smoke.planned({"distortion": {"methods": [{"parametrizer": "conformal"}]}})
    assert planned == {"table_distortion": 1, "figure7": 1, **AT_THE_END}


def test_another_shape_is_drawn_from_its_own_surface(smoke: Workdir) -> None:
    planned = smoke.planned({"figures": {"shapes": [{"database": "tiny", "shape": "ants-001"}]}})
    assert planned == {**DRAWN, **AT_THE_END}
    planned = smoke.planned({"figures": {"figure3": {"shown": 3}}})
    assert planned == {"figure3": 1, **AT_THE_END}


def test_another_seed_adds_its_splits_and_nothing_else(smoke: Workdir) -> None:
    planned = smoke.planned({"table1": {"seeds": [0, 1, 2]}})
    new = {"split": 1, "learn": 2, "classify": 2}
    assert planned == {**new, "evaluate": 4, **OF_TABLE_1, **AT_THE_END}


def test_another_fault_trains_nothing(smoke: Workdir) -> None:
    faults = [{"perturbation": "noise", "strengths": [0.3]}]
    planned = smoke.planned({"beyond": {"robustness": {"faults": faults}}})
    stages = ("perturb", "spectra", "describe", "parametrize", "images", "represent")
    predicted = {"predict_perturbed": 1, "classify_perturbed": 1, "evaluate": 2}
    assert planned == {**dict.fromkeys(stages, 1), **predicted, "table_beyond": 1, **AT_THE_END}


def test_fewer_training_shapes_leave_the_tables_alone(smoke: Workdir) -> None:
    planned = smoke.planned({"beyond": {"few_shot": [3]}})
    new = {"split": 1, "learn": 1, "classify": 1, "evaluate": 2}
    assert planned == {**new, "table_beyond": 1, **AT_THE_END}


def test_the_failures_allowed_do_not_train_again(smoke: Workdir) -> None:
    planned = smoke.planned({"max_failures": 0}, targets=["results/table1.csv"])
    assert planned == {"complete": 4, "score_table": 1}


TARGETS = (
    *("results/table1.csv", "results/figure8.png", "results/table1_beyond.csv"),
    *("results/table_reconstruction.csv", "results/figure2.png"),
)


@pytest.mark.parametrize(
    ("addition", "expected"),
    [
        # The paper's own table is a file of the checkout, which lies elsewhere in a copy of it.
        ("\n# A remark changes nothing.\n", {"score_table": 1}),
        (
            "\nEDITED = 1\n",
            {**AFTER_IMAGES, "reconstruct": 2, "table_reconstruction": 1, "figure2": 1},
        ),
    ],
)
def test_an_edited_module_reruns_what_it_computes(
    smoke: Workdir, tmp_path: Path, addition: str, expected: dict[str, int]
) -> None:
    for name in ("Snakefile", "config", "gipkg", "profiles", "results/reference", "workflow"):
        copy = shutil.copytree if (REPOSITORY / name).is_dir() else shutil.copy2
        copy(REPOSITORY / name, tmp_path / name)
    module = tmp_path / "gipkg" / "images" / "lookup.py"
    module.write_text(module.read_text() + addition)
    assert Workdir(smoke.path, checkout=tmp_path).planned(targets=TARGETS) == expected


def test_a_file_of_ones_own_becomes_a_column(smoke: Workdir, tmp_path: Path) -> None:
    workdir = smoke.copy(tmp_path)
    (tmp_path / "extent.py").write_text(EXTENT)
    columns = [
        {"column": "ShapeDNA", "baseline": "shapedna"},
        {"column": "Mine", "baseline": "box"},
    ]
    config = {
        "baselines": {"box": {"plugin": "extent.py:Extent", "power": 0.5}},
        "table1": {"columns": columns},
    }
    done = workdir.run(config=config)
    assert done.returncode == 0, done.stdout
    with (tmp_path / "results/table1.csv").open() as stream:
        (row,) = csv.DictReader(stream)
    with (smoke.path / "results/table1.csv").open() as stream:
        (before,) = csv.DictReader(stream)
    assert 10 < float(row["Mine accuracy mean"]) <= 100
    assert row["ShapeDNA mAP mean"] == before["ShapeDNA mAP mean"]
    assert "Proportions of the box" in (tmp_path / "results/table1.md").read_text()
    assert workdir.planned(config) == {}

    (tmp_path / "extent.py").write_text(EXTENT.replace("np.ptp", "2 * np.ptp"))
    assert workdir.planned(config) == {
        **{"represent": 2, "classify": 2, "complete": 1},
        **{"evaluate": 1, **OF_TABLE_1, **AT_THE_END},
    }


def test_the_rules_know_no_method_by_name() -> None:
    rules = [*(REPOSITORY / "workflow").rglob("*.smk"), *(REPOSITORY / "workflow").rglob("*.py")]
    assert len(rules) > 10
    for path in [REPOSITORY / "Snakefile", *rules]:
        text = path.read_text().lower()
        names = ("authalic", "conformal", "hks", "zernike", "shapedna", "shrec", "articulated")
        assert not [name for name in names if name in text], path
