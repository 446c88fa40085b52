from __future__ import annotations

import errno
import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from gipkg import files
from gipkg.errors import DamagedFileError

KILLED_WHILE_WRITING = """
import os, signal, sys
from pathlib import Path
from gipkg.files import atomic

with atomic(Path(sys.argv[1])) as stream:
    stream.write(b"half of the new content")
    stream.flush()
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_kill_inside_the_write_leaves_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "target"
    target.write_bytes(b"old")
    ended = subprocess.run([sys.executable, "-c", KILLED_WHILE_WRITING, str(target)], check=False)
    assert ended.returncode < 0
    assert target.read_bytes() == b"old"
    with files.atomic(target) as stream:
        stream.write(b"new")
    assert target.read_bytes() == b"new"


def test_an_error_inside_the_block_leaves_nothing_behind(tmp_path: Path) -> None:
    def fail() -> None:
        with files.atomic(tmp_path / "target") as stream:
            stream.write(b"half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert list(tmp_path.iterdir()) == []


def test_a_reader_sees_the_old_file_until_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "target"
    target.write_bytes(b"old")
    with files.atomic(target) as stream:
        stream.write(b"new")
        stream.flush()
        assert target.read_bytes() == b"old"
    assert target.read_bytes() == b"new"


def test_permissions_follow_the_umask_and_folders_are_made(tmp_path: Path) -> None:
    target = tmp_path / "a" / "b" / "target"
    before = os.umask(0o027)
    try:
        files.write_text(target, "text")
    finally:
        os.umask(before)
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


def test_a_name_as_long_as_the_file_system_allows(tmp_path: Path) -> None:
    target = tmp_path / ("n" * 255)
    files.write_text(target, "text")
    assert target.read_text() == "text"


def test_json_has_one_spelling(tmp_path: Path) -> None:
    files.write_json(tmp_path / "1", {"b": 1, "a": "é"})
    files.write_json(tmp_path / "2", {"a": "é", "b": 1})
    assert (tmp_path / "1").read_bytes() == (tmp_path / "2").read_bytes()
    assert json.loads((tmp_path / "1").read_text(encoding="utf-8")) == {"a": "é", "b": 1}
    with pytest.raises(ValueError, match="JSON"):
        files.write_json(tmp_path / "3", float("nan"))


def test_csv_survives_separators_quotes_and_line_breaks(tmp_path: Path) -> None:
    rows = [['a,"b"', "é\nü"], ["", " x "]]
    files.write_csv(tmp_path / "t.csv", ["id", "label"], rows)
    assert [list(row.values()) for row in files.read_csv(tmp_path / "t.csv")] == rows
    with pytest.raises(ValueError, match="3 values for 2 columns"):
        files.write_csv(tmp_path / "t.csv", ["id", "label"], [[1, 2, 3]])


def test_a_table_that_is_cut_off_anywhere_is_named(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    files.write_csv(path, ["id", "label"], [["a", "one"], ["b", "two\n\nlines"], ["c", ""]])
    content = path.read_bytes()
    for keep in range(len(content)):
        path.write_bytes(content[:keep])
        with pytest.raises(DamagedFileError, match=r"t\.csv: not a whole table; delete it"):
            files.read_csv(path)


def test_a_document_that_ends_early_is_named(tmp_path: Path) -> None:
    path = tmp_path / "t.json"
    files.write_json(path, {"a": [1, 2]})
    assert files.read_json(path) == {"a": [1, 2]}
    path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(DamagedFileError, match=r"t\.json: not a whole JSON document"):
        files.read_json(path)


def test_a_fault_of_the_disk_names_the_file(tmp_path: Path) -> None:
    def fill() -> None:
        with files.atomic(tmp_path / "target"):
            raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(OSError, match=r"No space left on device: '.*target'"):
        fill()
    assert list(tmp_path.iterdir()) == []


def test_arrays_round_trip_without_pickles(tmp_path: Path) -> None:
    arrays = {"x": np.arange(6.0).reshape(2, 3), "names": np.array(["ä", "b"])}
    files.write_arrays(tmp_path / "a.npz", arrays)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as loaded:
        assert set(loaded.files) == set(arrays)
        for name, array in arrays.items():
            np.testing.assert_array_equal(loaded[name], array)
    with pytest.raises(ValueError, match="Object arrays"):
        files.write_arrays(tmp_path / "b.npz", {"x": np.array([{}])})
    assert not (tmp_path / "b.npz").exists()
