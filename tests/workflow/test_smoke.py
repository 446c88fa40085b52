from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from gipkg.files import read_csv, read_json
from gipkg.shards import Shard
from tests.workflow.workdir import Workdir


def test_the_table_has_a_row_a_split_and_every_figure_in_its_range(smoke: Workdir) -> None:
    (row,) = read_csv(smoke.path / "results/table1.csv")
    assert (row.pop("database"), row.pop("split")) == ("tiny", "Tiny1")
    assert len(row) == 16
    for name, value in row.items():
        upper = 100 if "accuracy" in name else 1
        assert 0 <= float(value) <= upper, name
    # Ten classes: guessing reaches 10 %.
    assert float(row["Ours accuracy mean"]) > 30
    assert float(row["ShapeDNA accuracy mean"]) > 30


def test_the_tables_keep_their_columns_of_one_heading_apart(smoke: Workdir) -> None:
    (row,) = read_csv(smoke.path / "results/table2.csv")
    assert (row["database"], row["split"]) == ("tiny-furniture", "Tiny2")
    assert list(row)[2::4] == ["SH accuracy mean", "Ours accuracy mean"]
    # Ten classes: guessing reaches 10 %.
    assert float(row["SH accuracy mean"]) > 30
    assert "rigid shapes" in (smoke.path / "results/table2.md").read_text().splitlines()[0]
    channels = ["gravity-angle", "smooth-principal", "topological-mask"]
    for table, descriptors in (("table1", ["hks"]), ("table2", channels)):
        provenance = json.loads((smoke.path / f"results/{table}.json").read_text())
        assert list(provenance["plugins"]["descriptor"]) == descriptors


def test_upright_shapes_have_twelve_turns_and_a_mask_of_what_closed_them(smoke: Workdir) -> None:
    (folder,) = (smoke.path / "results/images/tiny-furniture/authalic").iterdir()
    shards = [Shard.open(path) for path in sorted((folder / "upright").iterdir())]
    images = {shape_id: shard[shape_id]["images"] for shard in shards for shape_id in shard}
    assert len(images) == 40
    assert {of_a_shape.shape for of_a_shape in images.values()} == {(12, 4, 56, 56)}
    mask = {shape_id: of_a_shape[:, 2] for shape_id, of_a_shape in images.items()}
    assert min(values.min() for values in mask.values()) == 0
    assert max(values.max() for values in mask.values()) == 1
    for of_a_shape in images.values():
        turned = np.rot90(of_a_shape[:-3], axes=(2, 3))
        np.testing.assert_allclose(of_a_shape[3:], turned, atol=1e-5)


def test_what_training_took_is_said_for_every_column(smoke: Workdir) -> None:
    rows = read_csv(smoke.path / "results/table1_seconds.csv")
    assert [row["column"] for row in rows] == ["Zernike", "ShapeDNA", "Conformal", "Ours"]
    for row in rows:
        assert (row["database"], row["split"], row["seconds_trainings"]) == ("tiny", "Tiny1", "2")
        assert float(row["seconds_cpu"]) > 0
        assert float(row["seconds_wall"]) > 0


def test_the_note_says_who_is_ahead(smoke: Workdir) -> None:
    (row,) = read_csv(smoke.path / "results/table1.csv")
    (note,) = [
        line
        for line in (smoke.path / "results/table1.md").read_text().splitlines()
        if "**Ours**" in line and ("ahead of" in line or "On no row" in line)
    ]
    for column in ("Zernike", "ShapeDNA", "Conformal"):
        for metric in ("accuracy", "mAP"):
            theirs, ours = (float(row[f"{one} {metric} mean"]) for one in (column, "Ours"))
            assert (f"Tiny1 {metric}, {column} " in note) == (theirs > ours)


def test_figure_8_shows_the_curves_of_the_table(smoke: Workdir) -> None:
    points = read_csv(smoke.path / "results/figure8.csv")
    table = json.loads((smoke.path / "results/figure8.json").read_text())["config"]
    columns = [column["column"] for column in table["columns"]]
    assert len(points) == 11 * len(columns)
    for column in columns:
        curve = [point for point in points if point["column"] == column]
        assert [float(point["recall"]) for point in curve] == [n / 10 for n in range(11)]
        precision = [float(point["precision"]) for point in curve]
        assert precision == sorted(precision, reverse=True)
        scores = read_json(
            smoke.path / f"results/evaluation/table1/tiny/{column.lower()}/Tiny1.json", sealed=True
        )
        assert precision[5] == pytest.approx(np.mean([one["precision"][5] for one in scores]))
    assert (smoke.path / "results/figure8.png").stat().st_size > 10_000


def test_faults_are_those_of_test_shapes_and_nothing_learns_from_them(smoke: Workdir) -> None:
    results = smoke.path / "results"
    rows = read_csv(results / "table1_beyond.csv")
    assert [(row["setting"], row["amount"], row["splits"]) for row in rows] == [
        ("training shapes a class", "1", "1"),
        ("training shapes a class", "2", "1"),
        ("as they are", "", "1"),
        ("noise", "0.2", "1"),
    ]
    for row in rows:
        for column in ("ShapeDNA", "Ours"):
            assert 10 < float(row[f"{column} accuracy mean"]) <= 100
            assert 0 < float(row[f"{column} mAP mean"]) <= 1
    # The same networks and test shapes as in the table, for the first of its seeds.
    (shared, *_) = read_json(results / "evaluation/table1/tiny/ours/Tiny1.json", sealed=True)
    assert float(rows[2]["Ours accuracy mean"]) == pytest.approx(100 * shared["accuracy"], abs=0.01)

    split = read_csv(results / "datasets/tiny/splits/Tiny1-0.csv")
    tested = {row["id"] for row in split if row["part"] == "test"}
    faulty = Shard.open(results / "surfaces/tiny~noise-0.2/0.npz")
    assert set(faulty) == tested
    clean = {
        shape_id: shard[shape_id]["vertices"]
        for shard in map(Shard.open, sorted((results / "surfaces/tiny").glob("*.npz")))
        for shape_id in set(shard) & tested
    }
    for shape_id, arrays in faulty.items():
        moved = np.linalg.norm(arrays["vertices"] - clean[shape_id], axis=1)
        assert 0 < np.median(moved) < 0.1 * np.linalg.norm(np.ptp(clean[shape_id], axis=0))


def test_every_shape_went_all_the_way(smoke: Workdir) -> None:
    ids = {row["id"] for row in read_csv(smoke.path / "results/datasets/tiny/shapes.csv")}
    assert len(ids) == 40
    for column in ("conformal", "authalic"):
        folder = smoke.path / "results/images/tiny" / column / "hks/standard"
        shards = [Shard.open(path) for path in sorted(folder.iterdir())]
        assert len(shards) == 2
        assert {shape_id for shard in shards for shape_id in shard} == ids
        images = next(iter(shards[0].values()))["images"]
        assert images.shape == (36, 5, 56, 56)
        assert images.dtype == np.float32


def test_the_distortion_of_every_shape_is_said(smoke: Workdir) -> None:
    results = smoke.path / "results"
    rows = {row["parametrizer"]: row for row in read_csv(results / "table_distortion.csv")}
    assert list(rows) == ["authalic", "conformal"]
    for method, row in rows.items():
        shapes = read_csv(results / f"distortion/tiny/{method}.csv")
        assert len(shapes) == int(row["shapes"]) == 40
        assert {shape["flips"] for shape in shapes} == {row["flips"]} == {"0"}
        assert {float(shape["degree"]) for shape in shapes} == {1}
        assert min(float(shape["seconds"]) for shape in shapes) > 0
        repaired = [shape["surface"] for shape in shapes if shape["surface"] != "as it was"]
        assert any("cut handles" in steps for steps in repaired)
        bins = read_csv(results / f"distortion/tiny/{method}.histogram.csv")
        faces = sum(int(shape["faces"]) for shape in shapes)
        assert sum(int(one["triangles"]) for one in bins) == faces
    assert float(rows["authalic"]["variance"]) < float(rows["conformal"]["variance"]) / 10


def test_images_of_equal_areas_keep_more_of_a_shape(smoke: Workdir) -> None:
    rows = read_csv(smoke.path / "results/table_reconstruction.csv")
    assert [int(row["size"]) for row in rows] == [16, 32, 16, 32]
    for row in rows:
        for figure in ("hausdorff", "mean"):
            assert 0 < float(row[f"authalic {figure}"]) < float(row[f"conformal {figure}"])
    # Figure 7 shows the same shapes through images of the larger size.
    shown = {
        (row["shape"], row["parametrizer"]): row["hausdorff"]
        for row in read_csv(smoke.path / "results/figure7_shapes.csv")
    }
    for row in rows[1::2]:
        for method in ("authalic", "conformal"):
            assert shown[row["shape"], method] == row[f"{method} hausdorff"]


PICKY = """
import numpy as np
from gipkg.errors import ParametrizationError
from gipkg.parametrizers.conformal import Conformal


class Picky(Conformal):
    def parametrize(self, mesh, callback=None):
        sphere = super().parametrize(mesh, callback)
        if len(mesh.vertices) % 2:
            raise ParametrizationError("an odd number of vertices")
        return np.abs(sphere)
"""


def test_what_a_method_fails_on_and_what_it_folds_is_said(smoke: Workdir, tmp_path: Path) -> None:
    workdir = smoke.copy(tmp_path)
    (tmp_path / "picky.py").write_text(PICKY)
    targets = [f"results/{name}" for name in ("table_distortion.csv", "table_reconstruction.csv")]
    done = workdir.run(
        *targets,
        "results/figure7.png",
        config={
            "parametrizers": {"picky": {"plugin": "picky.py:Picky"}},
            "distortion": {"methods": [{"parametrizer": "picky"}]},
            "reconstruction": {"parametrizers": ["picky"]},
        },
    )
    assert done.returncode == 0, done.stdout
    shapes = read_csv(tmp_path / "results/distortion/tiny/picky.csv")
    assert len(shapes) == 40
    (row,) = read_csv(tmp_path / "results/table_distortion.csv")
    failed = [shape for shape in shapes if shape["failure"]]
    assert 0 < len(failed) == int(row["failures"]) == 40 - int(row["shapes"])
    for shape in failed:
        assert shape["failure"] == "ParametrizationError: an odd number of vertices"
        assert int(shape["vertices"]) % 2
        assert shape["face_std"] == shape["seconds"] == ""
    # Folded onto an octant, a map covers nothing as often as it covers anything back.
    assert int(row["flipped shapes"]) == int(row["other degrees"]) == int(row["shapes"])
    note = (tmp_path / "results/table_distortion.md").read_text()
    assert f"gives nothing for {len(failed)} of the shapes of `tiny`" in note
    assert "`ParametrizationError: an odd number of vertices`" in note
    distances = read_csv(tmp_path / "results/table_reconstruction.csv")
    assert {row["picky hausdorff"] for row in distances} == {""}
    note = (tmp_path / "results/table_reconstruction.md").read_text()
    assert "it is not a map of degree 1" in note
    assert (tmp_path / "results/figure7.png").stat().st_size > 10_000


def test_every_training_left_its_seconds_among_the_timings(smoke: Workdir) -> None:
    results = smoke.path / "results"
    parts = (("tiny", "Tiny1", 8), ("tiny-furniture", "Tiny2", 2))
    trained = []
    for database, protocol, count in parts:
        learned = [*results.glob(f"learning/{database}/*/*/*/*/{protocol}-?.npz")]
        found = [*learned, *results.glob(f"baselines/{database}/*/{protocol}-?.npz")]
        assert len(found) == count
        trained += found
    for prediction in trained:
        timing = results / "benchmarks" / prediction.relative_to(results).with_suffix(".json")
        seconds = read_json(timing, sealed=True)
        assert seconds["cpu"] > 0
        assert not seconds["resumed"]


def test_unfinished_work_is_gone(smoke: Workdir) -> None:
    names = [path.name for path in (smoke.path / "results").rglob("*")]
    assert not [name for name in names if name.endswith((".work", ".part"))]


def test_the_provenance_says_what_made_the_table(smoke: Workdir) -> None:
    provenance = json.loads((smoke.path / "results/table1.json").read_text())
    assert provenance["gipkg"]["version"]
    assert provenance["libraries"]["numpy"] == np.__version__
    assert provenance["config"]["table1"]["seeds"] == [0, 1]
    assert "table2" not in provenance["config"]
    assert provenance["plugins"]["parametrizer"]["authalic"]["code"]
    assert provenance["networks"]["ours"]["training"]["minimum_steps"] == 20
    assert provenance["databases"]["tiny"]["failures"]["Ours"] == {}
    assert provenance["databases"]["tiny"]["survey"]["surfaces"] == 40


def test_a_second_run_does_nothing(smoke: Workdir) -> None:
    assert smoke.planned() == {}


def test_a_killed_run_is_taken_up_by_the_same_command(smoke: Workdir, tmp_path: Path) -> None:
    # Enough of the whole: `python -m benchmarks.kills` kills all of it, and at any moment.
    trained = "results/evaluation/table1/tiny/ours/Tiny1.json"
    workdir, targets = Workdir(tmp_path), (trained, "results/table_distortion.csv")
    run = subprocess.Popen(
        workdir.command(*targets),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    maps = tmp_path / "results" / "parametrizers"
    while run.poll() is None and not list(maps.rglob("*.work/*/*.npz")):
        time.sleep(0.01)
    os.killpg(run.pid, signal.SIGKILL)
    assert run.wait() == -signal.SIGKILL
    assert not (tmp_path / trained).exists()

    done = workdir.run(*targets)
    assert done.returncode == 0, done.stdout
    undisturbed, found = smoke.hashes(), workdir.hashes()
    assert len(found) > 25
    assert found == {name: undisturbed.get(name) for name in found}


def test_a_damaged_intermediate_file_is_named(smoke: Workdir, tmp_path: Path) -> None:
    workdir = smoke.copy(tmp_path)
    damaged = "results/images/tiny/authalic/hks/standard/0.npz"
    content = (tmp_path / damaged).read_bytes()
    (tmp_path / damaged).unlink()
    (tmp_path / damaged).write_bytes(content[: len(content) // 2])
    done = workdir.run(
        "results/learning/tiny/authalic/hks/standard/shallow/Tiny1-0.npz", "--forcerun", "learn"
    )
    assert done.returncode != 0
    assert f"DamagedFileError: {damaged}" in done.stdout
