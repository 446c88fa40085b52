"""``gipkg data``: what is at hand, whether it is whole, and where to get it."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from pathlib import Path

import pytest

from gipkg.datasets.modelnet import ModelNet10
from gipkg.datasets.shrec11 import Shrec11
from gipkg.plugin_refs import BUILTINS
from tests.cli.commands import records, run, run_well

ARCHIVE = "shrec11/shrec_16.tar.gz"
CONTENT = b"stands for the archive"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a data root whose one archive has the checksum that is asked for."""
    sha256 = hashlib.sha256(CONTENT).hexdigest()
    monkeypatch.setattr(Shrec11, "tags", replace(Shrec11.tags, files={ARCHIVE: sha256}))
    monkeypatch.setattr("gipkg.datasets.shrec11.SHA256", sha256)
    (tmp_path / "shrec11").mkdir()
    (tmp_path / ARCHIVE).write_bytes(CONTENT)
    return tmp_path


def test_list_says_what_there_is_and_what_is_at_hand(root: Path) -> None:
    result = run_well("data", "list", "--data-root", root, "--json")
    known = {record["database"]: record for record in records(result)}
    assert set(known) >= set(BUILTINS["dataset"])
    at_hand = {name for name in BUILTINS["dataset"] if known[name]["at_hand"]}
    assert at_hand == {"articulated", "furniture", "shrec11"}
    for record in known.values():
        assert record["licence"]
        assert record["source"]
        assert record["generated"] or record["files"] or record["shapes"] is None
    rows = run_well("data", "list", "--data-root", root).output.splitlines()
    assert [row.split()[0] for row in rows[1:]] == list(known)


def test_the_data_root_is_also_a_variable(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIPKG_DATA_ROOT", str(root))
    (record,) = records(run_well("data", "check", "shrec11", "--json"))
    assert record["files"] == {str(root / ARCHIVE): hashlib.sha256(CONTENT).hexdigest()}


def test_check_of_all_passes_over_what_is_not_at_hand(root: Path) -> None:
    checked = records(run_well("data", "check", "--data-root", root, "--json"))
    assert {record["database"] for record in checked} >= {"articulated", "shrec11"}
    assert "tosca" not in {record["database"] for record in checked}


def test_check_names_what_is_damaged_or_missing(root: Path) -> None:
    (root / ARCHIVE).write_bytes(CONTENT[1:])
    result = run("data", "check", "shrec11", "tosca", "articulated", "--data-root", root)
    assert result.exit_code == 1
    assert f"{root / ARCHIVE}: SHA-256" in result.stderr
    assert "nonrigid3d_mat.tar.gz: no such file" in result.stderr
    assert "2 of 3 failed" in result.stderr
    assert result.stdout.startswith("articulated -> 200 shapes in 10 classes")


def test_a_folder_in_place_of_its_archive_is_at_hand(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ModelNet10, "sizes", {"train": 1, "test": 1})
    for part, number in (("train", 1), ("test", 2)):
        folder = tmp_path / "modelnet10/ModelNet10/chair" / part
        folder.mkdir(parents=True)
        (folder / f"chair_{number:04}.off").write_text("OFF 0 0 0\n")
    listed = records(run_well("data", "list", "--data-root", tmp_path, "--json"))
    assert next(one for one in listed if one["database"] == "modelnet10")["at_hand"]
    checked = run_well("data", "check", "modelnet10", "--data-root", tmp_path)
    assert "whole: a folder without checksums" in checked.stdout


def test_fetch_says_where_to_get_what_has_no_address(root: Path) -> None:
    result = run("data", "fetch", "tosca", "shrec11", "--data-root", root, "--json")
    tosca, shrec11 = map(json.loads, result.stdout.splitlines())
    assert result.exit_code == 1
    assert tosca["status"] == "failed"
    assert str(root / "tosca") in tosca["message"]
    assert shrec11["status"] == "ok"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(("fetch",), "name what to fetch: articulated"), (("check", "shrec"), "mean 'shrec11'?")],
)
def test_wrong_usage(arguments: tuple[str, ...], said: str) -> None:
    result = run("data", *arguments)
    assert result.exit_code == 2
    assert said in " ".join(result.stderr.split())
