"""Many files: none is lost for another, none is overwritten, and the exit code says so."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import click
import pytest
import trimesh

from gipkg.cli import _batch
from gipkg.formats.mesh_reading import read_mesh
from tests.cli.commands import records, run, run_well


def write(folder: Path, *names: str) -> list[Path]:
    folder.mkdir(exist_ok=True)
    for name in names:
        trimesh.creation.box().export(folder / name)
    return [folder / name for name in names]


def test_a_bad_file_is_named_and_the_others_finish(tmp_path: Path) -> None:
    good = write(tmp_path / "in", "a.off", "c.obj")
    bad = tmp_path / "in" / "b.off"
    bad.write_text("OFF\n1 2")
    absent = tmp_path / "in" / "d.stl"
    files = (good[0], bad, good[1], absent)
    result = run("prepare", *files, "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["a.ply", "c.ply"]
    assert f"{bad}: not readable as .off" in result.stderr
    assert f"{absent}: there is no such file" in result.stderr
    assert "2 of 4 failed" in result.stderr
    assert [line.split(" -> ")[0] for line in result.stdout.splitlines()] == [*map(str, good)]


def test_json_is_one_object_a_file_and_nothing_else(tmp_path: Path) -> None:
    (good,) = write(tmp_path, "a\n\u00e9.off")
    (tmp_path / "b.off").write_bytes(b"")
    files = (good, tmp_path / "b.off")
    result = run("prepare", *files, "-o", tmp_path / "out", "--json")
    ok, failed = records(result)
    assert result.exit_code == 1
    assert (ok["file"], ok["status"]) == (str(good), "ok")
    assert ok["output"] == str(tmp_path / "out" / "a\n\u00e9.ply")
    assert ok["seconds"] >= 0
    assert set(failed) == {"file", "status", "error", "message"}
    assert failed["error"] == "MeshFormatError"
    assert "empty" in failed["message"]


def test_a_name_does_nothing_to_the_terminal(tmp_path: Path) -> None:
    files = write(tmp_path, "a\x1b[31m.off", "b\n.off")
    files[1].write_text("OFF")
    result = run("prepare", *files, "-o", tmp_path / "out")
    assert "a\\x1b[31m.off -> " in result.stdout
    assert "b\\n.off: " in result.stderr
    assert "\x1b" not in result.output


def test_a_figure_that_json_cannot_hold_fails_that_file_alone(
    capsys: pytest.CaptureFixture[str],
) -> None:
    figures = {"a": 1.0, "b": float("nan"), "c": 2.0}
    with pytest.raises(click.exceptions.Exit):
        _batch.for_each(
            "test", [*figures], lambda name: {"x": figures[name]}, say=str, as_json=True
        )
    said = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [record["status"] for record in said] == ["ok", "failed", "ok"]


def test_nothing_is_overwritten_unless_forced(tmp_path: Path) -> None:
    (source,) = write(tmp_path / "in", "a.off")
    target = tmp_path / "a.ply"
    target.write_text("precious")
    result = run("prepare", source, "-o", target)
    assert result.exit_code == 1
    assert "a.ply exists already; --force replaces it" in result.stderr
    assert target.read_text() == "precious"
    run_well("prepare", source, "-o", target, "--force")
    assert len(read_mesh(target).vertices) == 8


def test_a_failure_leaves_what_was_there_even_if_forced(tmp_path: Path) -> None:
    target = tmp_path / "a.ply"
    target.write_text("precious")
    (tmp_path / "a.off").write_text("OFF")
    assert run("prepare", tmp_path / "a.off", "-o", target, "--force").exit_code == 1
    assert target.read_text() == "precious"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.off", "a.ply"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("prepare",), "Missing argument"),
        (("prepare", "a.off"), "Missing option '-o'"),
        (("prepare", "a.off", "-o", "x", "--format", "3ds"), "'3ds' is not one of"),
        (("prepare", "a.off", "b.off", "-o", "x.ply"), "2 files do not fit into one"),
        (("prepare", "1/a.off", "2/a.obj", "-o", "x"), "would both become"),
        (("image", "a.off", "-o", "x.jpg"), "x.jpg: the suffix is none of .npy, .tiff, .png"),
        (("parametrise", "a.off"), "did you mean 'parametrize'?"),
        (("parametrize", "a.off", "-o", "x", "-m", "mine.py"), "is named mine.py:CLASS"),
        (("prepare", "a.off", "-o", "x.ply", "--format", "off"), "not named as a .off file"),
        (("prepare", "a.off", "-o", "x", "-p", "smallest_part=2"), "less than or equal to 1"),
        (("prepare", "a.off", "-o", "x", "-p", "smalest_part=1"), "mean 'smallest_part'?"),
        (("distort", "a.off", "-p", "prepare.method=magic"), "'auto', 'repair' or 'volume'"),
        (("parametrize", "a.off", "-o", "x", "-m", "autalic"), "did you mean 'authalic'?"),
        (("parametrize", "a.off", "-o", "x", "-p", "shape_wait=1"), "mean 'shape_weight'?"),
        (("parametrize", "a.off", "-o", "x", "-p", "shape_weight=2"), "<= 1"),
        (("parametrize", "a.off", "-o", "x", "-p", "shape_weight"), "not KEY=VALUE"),
        (("parametrize", "a.off", "-o", "x", "-p", ".shape_weight=1"), "not KEY=VALUE"),
        (
            ("parametrize", "a.off", "-o", "x", "-p", "hks.times=1"),
            "'hks' takes no part here (authalic, prepare)",
        ),
        (("parametrize", "a.off", "-o", "x", "-m", "absent.py:Mine"), "there is no file"),
        (("describe", "a.off", "-o", "x", "-d", "hsk"), "did you mean 'hks'?"),
        (("image", "a.off", "-o", "x.png", "-d", "hks"), "a PNG holds 1 or 3 channels, not 5"),
        (("image", "a.off", "-o", "x", "--size", "2"), "not in the range"),
        (("distort", "a.off", "-p", "rounds=many"), "valid integer"),
    ],
)
def test_wrong_usage_is_exit_code_2_before_any_file_is_read(
    arguments: tuple[str, ...], said: str
) -> None:
    result = run(*arguments)
    assert result.exit_code == 2, result.output
    assert said in " ".join(result.stderr.split())
    assert result.stdout == ""


def test_a_method_in_one_file(mesh_file: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("gipkg.registry._local", {})
    (tmp_path / "mine.py").write_text(
        "from gipkg.parametrizers.conformal import Conformal\nclass Mine(Conformal): pass\n"
    )
    method = f"{tmp_path / 'mine.py'}:Mine"
    (record,) = records(
        run_well("parametrize", mesh_file, "-o", tmp_path / "a.npz", "-m", method, "--json")
    )
    assert record["method"] == "mine"


def test_a_fault_of_the_program_is_said_to_be_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("nothing to share")

    monkeypatch.setattr("gipkg.surfaces.prepare", broken)
    files = write(tmp_path, "a.off", "b.off")
    result = run("prepare", *files, "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert result.stderr.count("ZeroDivisionError: nothing to share; this is a fault of gipkg") == 2


def test_a_fault_of_the_machine_is_worded_with_its_place(tmp_path: Path) -> None:
    (source,) = write(tmp_path, "a.off")
    (tmp_path / "file").touch()
    result = run("prepare", source, "-o", tmp_path / "file" / "a.ply")
    assert result.exit_code == 1
    assert result.stderr == f"{source}: File exists ({tmp_path / 'file'})\n"


def test_a_progress_line_for_many_files_and_none_for_one(tmp_path: Path) -> None:
    files = write(tmp_path, "a.off", "b.off")
    assert run_well("prepare", files[0], "-o", tmp_path / "one").stderr == ""
    assert "prepare: 2/2" in run_well("prepare", *files, "-o", tmp_path / "two").stderr


def test_counting() -> None:
    assert _batch.counted(1, "vertex") == "1 vertex"
    assert _batch.counted(1234, "vertex") == "1,234 vertices"
    assert _batch.counted(2, "flipped face") == "2 flipped faces"


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; from gipkg.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "heavy = {'torch', 'numpy', 'pydantic', 'trimesh', 'scipy'} & set(sys.modules)\n"
        "sys.exit(str(heavy) if heavy else 0)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("gipkg para", {"parametrize"}),
        ("gipkg parametrize -m auth", {"authalic", "authalic-flow"}),
        ("gipkg data check shr", {"shrec11"}),
        ("gipkg image --format t", {"tiff"}),
    ],
)
def test_the_shell_completes(words: str, expected: set[str]) -> None:
    from click.shell_completion import BashComplete

    from gipkg import cli

    *before, incomplete = words.split()[1:]
    completion = BashComplete(cli.main, {}, "gipkg", "_GIPKG_COMPLETE")
    assert {item.value for item in completion.get_completions(before, incomplete)} == expected
