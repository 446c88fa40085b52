"""What is done again after a change, and what is not."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path

import pytest

from tests.workflow.workdir import REPOSITORY, Workdir

AFTER_HKS = {"complete": 2, "learn": 4, "evaluate": 2, "score_table": 1, "all": 1}
"""Jobs that depend on Table 1's images: two parametrizers, one protocol and two seeds."""

AFTER_IMAGES = {"complete": 3, "learn": 5, "evaluate": 3, "score_table": 2, "all": 1}
"""Table 2 adds one column and one seed."""

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

DRAWN = {"figure2": 1, "figure3": 1, "figure4": 1}
"""What shows one shape, and maps it by itself."""

AFTER_MAPS = {"table_distortion": 1, "table_reconstruction": 1, "figure7": 1}


def test_a_descriptors_parameter_leaves_maps_and_baselines_alone(smoke: Workdir) -> None:
    planned = smoke.planned({"descriptors": {"hks": {"plugin": "hks", "times": 7}}})
    assert planned == {"describe": 2, "images": 4, **AFTER_HKS}


def test_a_parametrizers_parameter_touches_its_own_columns(smoke: Workdir) -> None:
    changed = {"authalic": {"plugin": "authalic", "max_iterations": 7}}
    planned = smoke.planned({"parametrizers": changed})
    columns = {"complete": 2, "learn": 3, "evaluate": 2, "score_table": 2, "all": 1}
    of_the_map = {"distort": 1, "reconstruct": 1, **AFTER_MAPS, **DRAWN}
    assert planned == {"parametrize": 2, "images": 4, **of_the_map, **columns}


def test_another_way_to_measure_distortion_maps_nothing_again(smoke: Workdir) -> None:
    planned = smoke.planned({"reconstruction": {"sizes": [16]}})
    assert planned == {"reconstruct": 2, "table_reconstruction": 1, "all": 1}
    planned = smoke.planned({"distortion": {"methods": [{"parametrizer": "conformal"}]}})
    assert planned == {"table_distortion": 1, "figure7": 1, "all": 1}


def test_another_shape_is_drawn_from_its_own_surface(smoke: Workdir) -> None:
    planned = smoke.planned({"figures": {"shapes": [{"database": "tiny", "shape": "ants-001"}]}})
    assert planned == {**DRAWN, "all": 1}
    assert smoke.planned({"figures": {"figure3": {"shown": 3}}}) == {"figure3": 1, "all": 1}


def test_another_seed_adds_its_splits_and_nothing_else(smoke: Workdir) -> None:
    planned = smoke.planned({"table1": {"seeds": [0, 1, 2]}})
    new = {"split": 1, "learn": 2, "classify": 2}
    assert planned == {**new, "evaluate": 4, "score_table": 1, "all": 1}


def test_the_failures_allowed_do_not_train_again(smoke: Workdir) -> None:
    assert smoke.planned({"max_failures": 0}) == {"complete": 5, "score_table": 2, "all": 1}


TABLES = {"score_table": 2, "table_distortion": 1, "all": 1}
"""Jobs that read a file of the checkout itself, which lies elsewhere in a copy of it."""


@pytest.mark.parametrize(
    ("addition", "expected"),
    [
        ("\n# A remark changes nothing.\n", TABLES),
        ("\nEDITED = 1\n", {"images": 6, **AFTER_IMAGES, "reconstruct": 2, **AFTER_MAPS, **DRAWN}),
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
    assert Workdir(smoke.path, checkout=tmp_path).planned() == expected


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
        **{"evaluate": 1, "score_table": 1, "all": 1},
    }


def test_the_rules_know_no_method_by_name() -> None:
    rules = [*(REPOSITORY / "workflow").rglob("*.smk"), *(REPOSITORY / "workflow").rglob("*.py")]
    assert len(rules) > 10
    for path in [REPOSITORY / "Snakefile", *rules]:
        text = path.read_text().lower()
        names = ("authalic", "conformal", "hks", "zernike", "shapedna", "shrec", "articulated")
        assert not [name for name in names if name in text], path
