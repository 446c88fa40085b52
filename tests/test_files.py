from __future__ import annotations

import errno
import json
import os
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

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


CONTENT = {"b": [0.1, 2, None], "a": {"10": "é", "2": "\n"}}


def test_a_sealed_table_names_any_change(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    rows = [["a", "0.25"], ["# sha256", "two\n\nlines"], ["c", ""]]
    files.write_csv(path, ["id", "value"], rows, sealed=True)
    assert [list(row.values()) for row in files.read_csv(path)] == rows
    for damaged in one_byte_less_or_changed(path.read_bytes()):
        path.write_bytes(damaged)
        with pytest.raises(DamagedFileError, match=r"t\.csv: not a whole table; delete it"):
            files.read_csv(path)


def test_a_sealed_document_names_any_change(tmp_path: Path) -> None:
    path = tmp_path / "t.json"
    files.write_json(path, CONTENT, sealed=True)
    assert files.read_json(path, sealed=True) == CONTENT
    survived = 0
    for damaged in one_byte_less_or_changed(path.read_bytes()):
        path.write_bytes(damaged)
        with suppress(DamagedFileError):
            # Spaces between the values are no content.
            assert files.read_json(path, sealed=True) == CONTENT
            survived += 1
    assert survived < 100


def test_what_is_not_sealed_is_not_taken_for_it(tmp_path: Path) -> None:
    files.write_json(tmp_path / "t.json", CONTENT)
    with pytest.raises(DamagedFileError, match=r"t\.json: not a whole JSON document"):
        files.read_json(tmp_path / "t.json", sealed=True)


KEYS = st.text(), st.integers()
VALUES = st.none() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text()


@settings(max_examples=30)
@given(
    st.recursive(
        VALUES,
        lambda inner: st.lists(inner) | st.one_of(*(st.dictionaries(key, inner) for key in KEYS)),
        max_leaves=10,
    )
)
def test_any_content_can_be_sealed(content: object) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "t.json"
        files.write_json(path, content, sealed=True)
        assert files.read_json(path, sealed=True) == json.loads(json.dumps(content))


def one_byte_less_or_changed(content: bytes) -> Iterator[bytes]:
    for place in range(len(content)):
        yield content[:place] + content[place + 1 :]
        yield content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


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


def test_the_checksum_of_a_file_is_that_of_its_content(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"content" * 10**5)
    assert files.sha256_of(tmp_path / "a") == sha256(b"content" * 10**5).hexdigest()
