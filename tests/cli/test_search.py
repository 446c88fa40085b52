"""``gipkg index`` and ``gipkg search``: from a folder of meshes to the nearest ones."""

from __future__ import annotations

import io
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gipkg.cli import index as index_command
from gipkg.errors import UnsupportedMesh
from gipkg.search.index import Index
from gipkg.search.network import SignatureNetwork
from tests.cli.commands import records, run, run_well
from tests.search.trained import SHAPES, mesh, write_meshes, write_network


@pytest.fixture(scope="module")
def network_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("network") / "trained.model.npz"
    write_network(path)
    return path


@pytest.fixture(scope="module")
def indexed(network_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return an indexed folder, not to be changed."""
    folder = tmp_path_factory.mktemp("indexed")
    write_meshes(folder)
    run_well("index", folder, "--network", network_file)
    return folder


@pytest.fixture
def folder(indexed: Path, tmp_path: Path) -> Path:
    """Return a copy of the indexed folder."""
    return shutil.copytree(indexed, tmp_path / "shapes")


def test_the_nearest_are_of_the_same_kind(indexed: Path, tmp_path: Path) -> None:
    query = mesh("plates/1")
    query.apply_scale([1.05, 1.0, 1.0])
    query.export(tmp_path / "query.stl")
    arguments = ("search", tmp_path / "query.stl", "--index", indexed / "gipkg-index.npz")
    (record,) = records(run_well(*arguments, "-n", "3", "--json"))
    assert record["class"] == "plates"
    assert {hit["name"] for hit in record["hits"][:2]} == {"plates/1.off", "plates/2.off"}
    distances = [hit["distance"] for hit in record["hits"]]
    assert distances == sorted(distances)
    assert record["output"] is None
    said = run_well(*arguments, "-n", "1").stdout.splitlines()
    assert said[0].endswith("looks like plates; nearest:")
    assert len(said) == 2


def test_a_shape_of_the_folder_finds_itself(indexed: Path) -> None:
    queries = [indexed / f"{name}.off" for name in SHAPES]
    found = records(run_well("search", *queries, "--index", indexed / "gipkg-index.npz", "--json"))
    for name, record in zip(SHAPES, found, strict=True):
        assert record["hits"][0] == {
            "name": f"{name}.off",
            "distance": 0.0,
            "label": record["class"],
        }
        assert len(record["hits"]) == len(SHAPES)


def test_an_index_takes_in_what_is_new_or_changed_and_drops_what_is_gone(folder: Path) -> None:
    before = (folder / "gipkg-index.npz").read_bytes()
    again = records(run_well("index", folder, "--json"))
    assert all(record["known"] for record in again)
    assert (folder / "gipkg-index.npz").read_bytes() == before
    shutil.copy(folder / "plates" / "1.off", folder / "needles" / "1.off")
    shutil.copy(folder / "plates" / "1.off", folder / "new.off")
    (folder / "plates" / "2.off").unlink()
    changed = {record["file"]: record for record in records(run_well("index", folder, "--json"))}
    assert {name for name, record in changed.items() if not record["known"]} == {
        "needles/1.off",
        "new.off",
    }
    assert changed["needles/1.off"]["class"] == "plates"
    assert set(Index.read(folder / "gipkg-index.npz").entries) == {
        "needles/1.off",
        "needles/2.off",
        "new.off",
        "plates/1.off",
    }


def test_a_bad_file_is_named_every_time_and_the_others_are_indexed(
    folder: Path, network_file: Path
) -> None:
    (folder / "a.ply").write_text("ply, they said")
    for _ in range(2):
        result = run("index", folder)
        assert result.exit_code == 1
        assert "a.ply: not readable as .ply" in result.stderr
        assert "1 of 5 failed" in result.stderr
    assert len(Index.read(folder / "gipkg-index.npz").nearest(np.zeros(48), 9)) == 4


def test_what_was_done_is_kept_when_the_work_is_stopped(
    folder: Path, network_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = SignatureNetwork.signature
    seen: list[Path] = []

    def stopped(self: SignatureNetwork, source: Path) -> object:
        seen.append(source)
        if len(seen) == 3:
            raise KeyboardInterrupt
        return whole(self, source)

    monkeypatch.setattr(SignatureNetwork, "signature", stopped)
    arguments = ("index", folder, "--network", network_file, "-o", folder / "fresh.npz")
    assert run(*arguments).exit_code == 1
    assert len(Index.read(folder / "fresh.npz").entries) == 2
    rest = records(run_well(*arguments, "--json"))
    assert [record["known"] for record in rest] == [True, True, False, False]
    assert (folder / "fresh.npz").read_bytes() == (folder / "gipkg-index.npz").read_bytes()


def test_an_index_is_written_on_the_way_though_shapes_fail(
    folder: Path, network_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target, there = tmp_path / "new.npz", []

    def failing(self: SignatureNetwork, source: Path) -> None:
        there.append(target.exists())
        raise UnsupportedMesh("not today")

    monkeypatch.setattr(index_command, "SECONDS_BETWEEN_WRITES", -1.0)
    monkeypatch.setattr(SignatureNetwork, "signature", failing)
    assert run("index", folder, "--network", network_file, "-o", target).exit_code == 1
    assert there == [False, *[True] * (len(SHAPES) - 1)]


def test_an_index_elsewhere_and_a_sheet_of_pictures(
    folder: Path, network_file: Path, tmp_path: Path
) -> None:
    index = tmp_path / "elsewhere" / "shapes.npz"
    run_well("index", folder, "--network", network_file, "-o", index)
    query, sheet = folder / "plates" / "1.off", tmp_path / "sheet.png"
    arguments = ("search", query, "--index", index, "-n", "2", "-o", sheet)
    run_well(*arguments)
    picture = np.asarray(Image.open(io.BytesIO(sheet.read_bytes())).convert("RGB"))
    panels = [panel[100:300] for panel in np.array_split(picture, 4, axis=1)]
    drawn = [(panel < 240).any(axis=2).mean() > 0.2 for panel in panels]
    assert drawn == [True, True, True, False]
    assert run(*arguments).exit_code == 1
    run_well(*arguments, "--force")


def test_another_network_replaces_an_index_only_by_force(folder: Path, tmp_path: Path) -> None:
    write_network(tmp_path / "other.npz", seed=1)
    arguments = ("index", folder, "--network", tmp_path / "other.npz")
    before = (folder / "gipkg-index.npz").read_bytes()
    result = run(*arguments)
    assert result.exit_code == 1
    assert "another network or version of gipkg; --force replaces it" in result.stderr
    assert (folder / "gipkg-index.npz").read_bytes() == before
    run_well(*arguments, "--force")


def test_an_index_of_another_version_is_not_searched(folder: Path) -> None:
    path = folder / "gipkg-index.npz"
    index = Index.read(path)
    index.key = "of another version"
    index.write(path)
    result = run("search", folder / "plates" / "1.off", "--index", path)
    assert result.exit_code == 1
    assert "gipkg index --force makes it again" in result.stderr


def test_what_is_needed_is_said(folder: Path, tmp_path: Path) -> None:
    (folder / "gipkg-index.npz").unlink()
    assert "a new index needs --network" in run("index", folder).stderr
    result = run("search", folder / "plates" / "1.off", "--index", folder)
    assert result.exit_code == 1
    assert "gipkg index makes one" in result.stderr
    (tmp_path / "empty").mkdir()
    result = run("index", tmp_path / "empty")
    assert result.exit_code == 2
    assert "there is no mesh in" in result.stderr
    (tmp_path / "junk.npz").write_bytes(b"junk")
    result = run("index", folder, "--network", tmp_path / "junk.npz")
    assert result.exit_code == 1
    assert "junk.npz: not a whole trained network" in result.stderr
