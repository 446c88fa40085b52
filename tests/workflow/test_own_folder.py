"""A folder of meshes by class is enough for a row of Table 1, and a changed mesh is noticed."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from gipkg.files import read_csv
from tests.workflow.workdir import Workdir

CONFIG = {
    "datasets": {"mine": {"plugin": "folder", "path": "my/meshes", "shards": 2}},
    "table1": {"databases": ["mine"]},
}


@pytest.fixture
def workdir(tmp_path: Path) -> Workdir:
    for label, ball in (
        ("balls", trimesh.creation.icosphere(2)),
        ("boxes", trimesh.creation.box()),
    ):
        folder = tmp_path / "my" / "meshes" / label
        folder.mkdir(parents=True)
        for number in range(5):
            ball.apply_scale((1.0, 1.0, 1.2))
            ball.export(folder / f"{number}.ply")
    return Workdir(tmp_path)


def test_table_1_is_planned_from_a_folder(workdir: Workdir) -> None:
    done = workdir.run("--dry-run", "results/table1.csv", config=CONFIG)
    assert done.returncode == 0, done.stdout
    for name in ("surfaces/mine/1.npz", "evaluation/table1/mine/ours/Own.json"):
        assert f"results/{name}" in done.stdout


def test_a_changed_mesh_is_noticed(workdir: Workdir) -> None:
    listing = "results/datasets/mine/shapes.csv"
    assert workdir.run(listing, config=CONFIG).returncode == 0
    rows = read_csv(workdir.path / listing)
    assert len(rows) == 10
    shard = rows[0].pop("shard")
    assert rows[0] == {"id": "balls-0", "label": "balls", "part": ""}
    assert shard.isdigit()
    (workdir.path / "my/meshes/balls/0.ply").unlink()
    again = workdir.run("--dry-run", listing, config=CONFIG).stdout
    assert "Params have changed since last execution" in again
