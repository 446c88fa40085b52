from __future__ import annotations

import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gipkg.errors import DamagedFileError
from gipkg.files import read_csv
from gipkg.shards import Arrays, Shard, content_key, join, map_shard, shard_of
from tests.support.zip_bits import with_a_changed_bit, with_a_changed_bit_of_a_header

HOSTILE = [
    "../x",
    "/etc/passwd",
    "..",
    ".",
    "",
    "a/b",
    "é☃",
    "a b",
    "%2E",
    "x.npy",
    "failures",
    "n" * 300,
]

KILLED_AT_THE_THIRD = """
import os, signal, sys
from pathlib import Path
import numpy as np
from gipkg import files
from gipkg.shards import map_shard

def compute(shape_id):
    if shape_id == "c":
        with files.atomic(Path(sys.argv[1]) / "work" / sys.argv[2] / "c.npz") as stream:
            stream.write(b"half")
            stream.flush()
            os.kill(os.getpid(), signal.SIGKILL)
    return {"x": np.array([ord(shape_id)])}

map_shard("abcd", compute, Path(sys.argv[1]) / "out.npz", Path(sys.argv[1]) / "work", "killed",
          key=sys.argv[2])
"""


class Computed:
    """Arrays of a shape by its identifier; remembers what it was asked for."""

    def __init__(self) -> None:
        self.ids: list[str] = []

    def __call__(self, shape_id: str) -> Arrays:
        self.ids.append(shape_id)
        if shape_id == "bad":
            raise ValueError("no such surface")
        return {"x": np.frombuffer(shape_id.encode(), np.uint8), "size": np.array(len(shape_id))}


def run(folder: Path, ids: list[str], compute: Computed | None = None, key: str = "k") -> Shard:
    map_shard(ids, compute or Computed(), folder / "out.npz", folder / "work", "test", key=key)
    return Shard.open(folder / "out.npz")


def test_a_shard_gives_back_what_was_computed(tmp_path: Path) -> None:
    shard = run(tmp_path, ["b", "a"])
    assert shard.ids == tuple(shard) == ("a", "b")
    assert len(shard) == 2
    assert set(shard["a"]) == {"x", "size"}
    assert shard["b"]["x"].tobytes() == b"b"
    assert shard.failures == {}
    with pytest.raises(KeyError):
        shard["c"]


def test_hostile_identifiers_stay_inside_the_folder(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    shard = run(tmp_path / "in", HOSTILE)
    assert shard.ids == tuple(sorted(HOSTILE))
    for shape_id in HOSTILE:
        assert shard[shape_id]["x"].tobytes() == shape_id.encode()
    assert [path.name for path in tmp_path.iterdir()] == ["in"]
    assert [path.name for path in (tmp_path / "in").iterdir()] == ["out.npz"]
    with np.load(tmp_path / "in" / "out.npz") as archive:
        assert not any(
            part in {"", ".", ".."} for name in archive.files for part in name.split("/")[1:]
        )


def test_a_failing_shape_is_recorded_and_loses_no_other(tmp_path: Path) -> None:
    shard = run(tmp_path, ["a", "bad", "z"])
    assert shard.ids == ("a", "z")
    assert shard.failures == {"bad": "ValueError: no such surface"}


def test_failures_are_carried_on(tmp_path: Path) -> None:
    map_shard(
        ["a", "bad"],
        Computed(),
        tmp_path / "out.npz",
        tmp_path / "work",
        "test",
        key="k",
        failures={"lost": "UnsupportedMesh: open"},
    )
    assert Shard.open(tmp_path / "out.npz").failures == {
        "bad": "ValueError: no such surface",
        "lost": "UnsupportedMesh: open",
    }


def test_a_shape_without_arrays_has_failed(tmp_path: Path) -> None:
    map_shard(["a"], lambda _: {}, tmp_path / "o.npz", tmp_path / "work", "test", key="k")
    assert Shard.open(tmp_path / "o.npz").failures == {"a": "ValueError: nothing was computed"}


@pytest.mark.parametrize("fault", [OSError("disk full"), MemoryError(), ModuleNotFoundError("x")])
def test_a_fault_of_the_machine_ends_the_job(tmp_path: Path, fault: Exception) -> None:
    def compute(_: str) -> Arrays:
        raise fault

    with pytest.raises(type(fault)):
        map_shard(["a"], compute, tmp_path / "o.npz", tmp_path / "work", "test", key="k")
    assert not (tmp_path / "o.npz").exists()


def test_the_same_arrays_give_the_same_bytes(tmp_path: Path) -> None:
    digests = set()
    for name, ids in [("1", ["a", "bad", "é"]), ("2", ["é", "bad", "a"])]:
        run(tmp_path / name, ids)
        digests.add(sha256((tmp_path / name / "out.npz").read_bytes()).hexdigest())
    assert len(digests) == 1


def kill_at_the_third(folder: Path, key: str) -> None:
    command = [sys.executable, "-c", KILLED_AT_THE_THIRD, str(folder), key]
    assert subprocess.run(command, check=False).returncode < 0
    assert not (folder / "out.npz").exists()


def test_a_killed_job_goes_on_where_it_was(tmp_path: Path) -> None:
    kill_at_the_third(tmp_path, "k")
    compute = Computed()
    shard = run(tmp_path, list("abcd"), compute, key="k")
    assert compute.ids == ["c", "d"]
    assert shard.ids == ("a", "b", "c", "d")
    assert shard["a"]["x"].tolist() == [ord("a")]
    assert not (tmp_path / "work").exists()


def test_unfinished_work_of_other_parameters_is_not_used(tmp_path: Path) -> None:
    kill_at_the_third(tmp_path, "old")
    compute = Computed()
    run(tmp_path, list("abcd"), compute, key="new")
    assert compute.ids == ["a", "b", "c", "d"]
    assert not (tmp_path / "work").exists()


def test_the_key_depends_on_parameters_and_on_bytes(tmp_path: Path) -> None:
    one, two = tmp_path / "1", tmp_path / "2"
    one.write_bytes(b"same")
    two.write_bytes(b"same")
    key = content_key({"a": 1, "b": [2.0]}, [one])
    assert key == content_key({"b": [2.0], "a": 1}, [two])
    two.write_bytes(b"other")
    others = {
        content_key({"a": 1, "b": [2.0]}, [two]),
        content_key({"a": 1, "b": [2.5]}, [one]),
        content_key({"a": 1, "b": [2.0]}, [one, one]),
    }
    assert len({key, *others}) == 4


@pytest.mark.parametrize("keep", [0, 100, -40])
def test_a_truncated_shard_is_named(tmp_path: Path, keep: int) -> None:
    run(tmp_path, ["a", "b"])
    path = tmp_path / "out.npz"
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(DamagedFileError, match=str(path)):
        Shard.open(path)


def test_a_flipped_bit_is_found_and_does_not_count_as_a_failed_shape(tmp_path: Path) -> None:
    map_shard(
        ["a"], lambda _: {"x": np.zeros(500)}, tmp_path / "in.npz", tmp_path / "work", "", key="k"
    )
    content = bytearray((tmp_path / "in.npz").read_bytes())
    content[content.index(bytes(2000)) + 1000] ^= 1
    (tmp_path / "in.npz").write_bytes(content)
    damaged = Shard.open(tmp_path / "in.npz")
    with pytest.raises(DamagedFileError, match=r"in\.npz"):
        map_shard(["a"], damaged.__getitem__, tmp_path / "out.npz", tmp_path / "work", "", key="k")


def test_a_flipped_bit_in_the_directory_is_found_or_changes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "out.npz"
    shard = run(tmp_path, ["a", "bad", "é"])
    known = {shape_id: shard[shape_id] for shape_id in shard}
    said = []
    for damaged in with_a_changed_bit(path.read_bytes()):
        path.write_bytes(damaged)
        try:
            again = Shard.open(path)
            assert again.failures == shard.failures
            np.testing.assert_equal({shape_id: again[shape_id] for shape_id in again}, known)
        except DamagedFileError as error:
            said.append(str(error))
    assert len(said) > 500
    assert all(text.startswith(f"{path}: not a whole shard") for text in said)


def test_a_flipped_bit_in_the_header_of_an_array_is_found(tmp_path: Path) -> None:
    path = tmp_path / "out.npz"
    shape = {"long": np.arange(6000.0).reshape(2000, 3)}
    map_shard(["a"], lambda _: shape, path, tmp_path / "work", "made", key="k")
    for damaged in with_a_changed_bit_of_a_header(path.read_bytes()):
        path.write_bytes(damaged)
        with pytest.raises(DamagedFileError, match="not a whole shard"):
            Shard.open(path)["a"]


def test_a_damaged_part_is_found_when_it_is_packed(tmp_path: Path) -> None:
    kill_at_the_third(tmp_path, "k")
    (part, *_) = sorted((tmp_path / "work" / "k").glob("*.npz"))
    whole = part.read_bytes()
    renamed = bytearray(whole)
    renamed[whole.index(b"PK\1\2") + 46] ^= 1
    for damaged in (renamed, whole[:-1]):
        part.write_bytes(damaged)
        with pytest.raises(DamagedFileError, match=part.name):
            run(tmp_path, list("abcd"), key="k")
    part.unlink()
    assert run(tmp_path, list("abcd"), key="k").ids == ("a", "b", "c", "d")


def test_pickles_are_neither_written_nor_read(tmp_path: Path) -> None:
    map_shard(
        ["a"], lambda _: {"x": np.array([{}])}, tmp_path / "o.npz", tmp_path / "w", "", key="k"
    )
    assert "Object arrays" in Shard.open(tmp_path / "o.npz").failures["a"]
    np.savez(tmp_path / "evil.npz", **{"a/x": np.array([{}]), "failures": np.array("{}")})
    with pytest.raises(DamagedFileError, match="Python objects"):
        Shard.open(tmp_path / "evil.npz")["a"]


def test_join_keeps_the_shapes_that_all_have_and_every_failure(tmp_path: Path) -> None:
    one = run(tmp_path / "1", ["a", "b", "c"])
    two = run(tmp_path / "2", ["b", "c", "bad"])
    assert join(one, two) == (("b", "c"), {"bad": "ValueError: no such surface"})


@given(st.text(), st.integers(1, 1000))
def test_a_shape_has_one_shard(shape_id: str, count: int) -> None:
    assert 0 <= shard_of(shape_id, count) < count
    assert shard_of(shape_id, 1) == 0


def test_shards_are_even_and_fixed() -> None:
    counts = np.bincount([shard_of(f"T{i}", 8) for i in range(4000)], minlength=8)
    assert (np.abs(counts - 500) < 100).all()
    assert [shard_of(f"T{i}", 8) for i in range(6)] == [1, 5, 2, 3, 4, 3]


def test_what_each_shape_took_outlasts_a_run_that_was_stopped(tmp_path: Path) -> None:
    out, work, seconds = tmp_path / "out.npz", tmp_path / "work", tmp_path / "seconds.csv"
    compute = Computed()

    def stopped(shape_id: str) -> Arrays:
        if shape_id == "c":
            raise OSError("the disk is full")
        return compute(shape_id)

    with pytest.raises(OSError, match="the disk"):
        map_shard("abc", stopped, out, work, "first", key="k", seconds=seconds)
    assert not seconds.exists()
    kept = {path.name: path.read_text() for path in work.rglob("*.seconds")}
    assert len(kept) == 2
    map_shard(["a", "b", "bad", "c"], compute, out, work, "again", key="k", seconds=seconds)
    rows = read_csv(seconds)
    # What failed has no time, and what was done is not done again.
    assert [row["id"] for row in rows] == ["a", "b", "c"]
    assert {row["seconds"] for row in rows} >= set(kept.values())
    assert all(float(row["seconds"]) >= 0 for row in rows)
    assert compute.ids == ["a", "b", "bad", "c"]
    assert not work.exists()


def test_times_leave_the_shard_as_it_is(tmp_path: Path) -> None:
    plain, timed = tmp_path / "plain.npz", tmp_path / "timed.npz"
    map_shard("ab", Computed(), plain, tmp_path / "w", "plain", key="k")
    map_shard("ab", Computed(), timed, tmp_path / "w", "timed", key="k", seconds=tmp_path / "s")
    assert timed.read_bytes() == plain.read_bytes()
