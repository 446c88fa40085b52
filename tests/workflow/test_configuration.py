"""A fault of the configuration stops a run at once and names the key and the choices."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from tests.workflow.workdir import REPOSITORY, Workdir

LEARNED = {"parametrizer": "authalic", "descriptors": ["hks"], "network": "shallow"}


@pytest.mark.parametrize(
    ("config", "words"),
    [
        ({"colums": []}, ["the top level", "'colums'", "table1", "eigenpairs"]),
        ({"eigenpairs": "many"}, ["eigenpairs", "'many'", "integer"]),
        (
            {"images": {"standard": {"sampling": "authors'"}}},
            ["images.standard", "sampling", "equal-area", "authors"],
        ),
        (
            {"table2": {"columns": [{"column": "A", **LEARNED, "images": "upwright"}]}},
            ["table2.columns.0.images", "did you mean 'upright'"],
        ),
        ({"table2": {"seed": [0]}}, ["table2", "'seed'", "keys: databases, columns, seeds"]),
        (
            {"table1": {"databases": ["tini"]}},
            ["table1.databases", "'tini'", "did you mean 'tiny'", "shrec11"],
        ),
        (
            {"table1": {"columns": [{"column": "A", **LEARNED, "parametrizer": "authalik"}]}},
            ["table1.columns.0.parametrizer", "did you mean 'authalic'", "conformal"],
        ),
        (
            {"table1": {"columns": [{"column": "A", "baseline": "zernike", **LEARNED}]}},
            ["table1.columns.0", "'network'", "keys: column, baseline, paper"],
        ),
        (
            {"table2": {"columns": [{"column": "A b", **LEARNED}, {"column": "a-B", **LEARNED}]}},
            ["table2.columns.1", "'a-b' names two columns"],
        ),
        (
            {"table1": {"databases": ["tosca"]}},
            ["table1.databases", "'tosca' has no protocol", "datasets.tosca.protocols"],
        ),
        (
            {"distortion": {"methods": [{"parametrizer": "authalik"}]}},
            ["distortion.methods.0.parametrizer", "did you mean 'authalic'"],
        ),
        (
            {"reconstruction": {"parametrizers": ["conformall"]}},
            ["reconstruction.parametrizers", "did you mean 'conformal'"],
        ),
        (
            {"datasets": {"tosca": {"plugin": "tosca", "shards": 1, "classes": ["dogs"]}}}
            | {"distortion": {"databases": ["tosca"]}},
            ["datasets.tosca", "did you mean 'dog'"],
        ),
        (
            {"figures": {"shapes": [{"database": "tini", "shape": "hands-000"}]}},
            ["figures.shapes.0.database", "did you mean 'tiny'"],
        ),
        (
            {"figures": {"shapes": [{"database": "shrec11", "shape": "T280"}]}},
            ["figures.shapes", "none of the databases is at hand (shrec11)", "data_root"],
        ),
        (
            {"figures": {"figure2": {"parametrizers": ["authalik"]}}},
            ["figures.figure2.parametrizers", "did you mean 'authalic'"],
        ),
        (
            {"beyond": {"databases": [{"database": "shrec11"}]}},
            ["beyond.databases", "none of the databases is at hand (shrec11)", "data_root"],
        ),
        (
            {"beyond": {"databases": [{"database": "tiny", "protocol": "Tini1"}]}},
            ["beyond.databases", "no protocol 'Tini1'", "did you mean 'Tiny1'"],
        ),
        (
            {"datasets": {"tiny": {"protocols": {"Some": {"classes": ["ants"]}}}}},
            ["datasets.tiny.protocols.Some", "'train_per_class'"],
        ),
        (
            {"beyond": {"robustness": {"faults": [{"perturbation": "noisy", "strengths": [1]}]}}},
            ["beyond.robustness.faults.0", "did you mean 'noise'", "shortcut"],
        ),
        ({"figures": {"figure4": {"parametrizers": ["authalic"]}}}, ["figure4", "too short"]),
        (
            {"parametrizers": {"authalic": {"plugin": "authalik"}}},
            ["parametrizers.authalic", "did you mean 'authalic'", "conformal"],
        ),
        (
            {"descriptors": {"hks": {"plugin": "hks", "time": 3}}},
            ["descriptors.hks", "'time'", "did you mean 'times'", "logarithm"],
        ),
        (
            {"networks": {"shallow": {"training": {"epochs": 0}}}},
            ["networks.shallow", "epochs", ">= 1"],
        ),
        (
            {"images": {"standard": {"size": 20}}},
            [
                "columns.",
                "'shallow' on images 'standard'",
                "28 pixels",
                "too small",
                "fewer blocks",
            ],
        ),
        (
            {"networks": {"shallow": {"network": {"margin": 60}}}},
            ["columns.", "'shallow' on images 'standard'", "margin of 60"],
        ),
        (
            {"baselines": {"shapedna": {"plugin": "absent.py:Mine"}}},
            ["baselines.shapedna", "absent.py"],
        ),
    ],
)
def test_a_fault_is_named(tmp_path: Path, config: dict[str, object], words: list[str]) -> None:
    done = Workdir(tmp_path).run("--dry-run", config=config)
    assert done.returncode != 0
    message = next(line for line in done.stdout.splitlines() if line.startswith("configuration, "))
    assert [word for word in words if word not in message] == []


def test_a_database_asked_for_by_name_and_not_to_be_had(tmp_path: Path) -> None:
    nowhere = "http://127.0.0.1:9"
    done = Workdir(tmp_path).run(
        "results/datasets/shrec11/shapes.csv",
        config={"table1": {"databases": ["shrec11"]}},
        environment={"http_proxy": nowhere, "https_proxy": nowhere, "no_proxy": ""},
    )
    assert done.returncode != 0
    assert "DatasetNotFound" in done.stdout
    assert "https://" in done.stdout
    assert "data/shrec11" in done.stdout


def test_the_generated_database_stands_in_where_no_real_one_is(tmp_path: Path) -> None:
    config = {name: {"databases": "auto"} for name in ("table1", "table2", "distortion")}
    done = Workdir(tmp_path).run("--dry-run", config=config)
    assert "results/evaluation/table1/articulated/ours/Articulated1.json" in done.stdout
    assert "results/evaluation/table2/furniture/ours/Furniture2.json" in done.stdout
    for absent in ("table1/shrec11", "table1/furniture", "table2/articulated", "table2/modelnet10"):
        assert f"results/evaluation/{absent}" not in done.stdout
    # Few shapes, without a protocol, are there to be mapped by every method.
    assert "results/distortion/articulated-few/authalic.csv" in done.stdout
    for absent in ("distortion/articulated/", "evaluation/table1/articulated-few"):
        assert f"results/{absent}" not in done.stdout


def test_real_databases_take_their_rows(tmp_path: Path, data_root: Path) -> None:
    config = {"table1": {"databases": "auto"}, "data_root": str(data_root)}
    done = Workdir(tmp_path).run("--dry-run", config=config)
    assert "results/evaluation/table1/shrec11/ours/SHREC2.json" in done.stdout
    assert "results/evaluation/table1/articulated" not in done.stdout


def test_real_upright_databases_have_rows_in_table_2_and_its_study(
    tmp_path: Path, data_root: Path
) -> None:
    config = {"table2": {"databases": "auto"}, "data_root": str(data_root)}
    done = Workdir(tmp_path).run("--dry-run", "results/table2.csv", config=config)
    voxels = "modelnet10-voxels/ours/ModelNet10Voxels.json"
    assert f"results/evaluation/table2/{voxels}" in done.stdout
    assert "results/evaluation/table2/furniture" not in done.stdout
    config["table2_study"] = {"databases": ["modelnet10-voxels"], "seeds": [1]}
    done = Workdir(tmp_path).run("--dry-run", "results/table2_study.csv", config=config)
    assert f"results/evaluation/table2_study/{voxels}" in done.stdout
    assert "results/images/modelnet10-voxels/authalic/smooth-principal/upright/0.npz" in done.stdout


def test_what_is_there_to_be_mapped_is_not_classified(tmp_path: Path, data_root: Path) -> None:
    config = {
        "table1": {"databases": "auto"},
        "distortion": {"databases": "auto"},
        "data_root": str(data_root),
    }
    done = Workdir(tmp_path).run("--dry-run", config=config)
    assert "results/distortion/tosca/authalic.csv" in done.stdout
    assert "results/distortion/tosca-highres/conformal.csv" in done.stdout
    assert "results/distortion/shrec11" not in done.stdout
    assert "results/evaluation/table1/tosca" not in done.stdout


def test_the_variant_as_in_the_paper_can_be_chosen(tmp_path: Path) -> None:
    column = {**LEARNED, "descriptors": ["hks-raw"], "network": "shallow-2016"}
    config = {"table1": {"columns": [{"column": "2016", **column}]}}
    done = Workdir(tmp_path).run("--dry-run", config=config)
    assert done.returncode == 0, done.stdout
    assert "results/images/tiny/authalic/hks-raw/standard/0.npz" in done.stdout


def test_every_key_is_explained() -> None:
    schema = yaml.safe_load((REPOSITORY / "workflow/schemas/config.schema.yaml").read_text())
    text = (REPOSITORY / "config/README.md").read_text()
    assert [key for key in schema["properties"] if f"### `{key}`" not in text] == []
