"""Names that a database brings are neither paths nor markup nor lines, all through the workflow."""

from __future__ import annotations

import json
import re
from pathlib import Path

from gipkg.files import read_csv
from gipkg.shards import Shard
from tests.workflow.workdir import Workdir

HOSTILE = """
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

import trimesh

from gipkg.api import Dataset, DatasetTags, Protocol, Shape

NAMES = ("../../up", "/gipkg-absolute", "a\\nb", "<script>alert(1)</script>", "'\\"it\\"", "|")


class Hostile(Dataset):
    summary: ClassVar[str] = "names that want to be something else"
    citation: ClassVar[str] = "none"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=12, classes=2, licence="none", source="none"
    )
    protocols: ClassVar[Mapping[str, Protocol]] = {"Half": Protocol(3)}

    def available(self, root: Path) -> bool:
        return True

    def fetch(self, root: Path) -> None:
        pass

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        both = [Shape(f"{n}{k}", ("../<b>", "a\\nb")[k]) for k in (0, 1) for n in NAMES]
        return tuple(sorted(both, key=lambda shape: shape.id))

    def load(self, root: Path, shape_id: str) -> trimesh.Trimesh:
        if shape_id == "a\\nb0":
            raise ValueError("<script>alert(2)</script> is at fault")
        scale = 1 + sum(map(ord, shape_id)) % 7 / 10
        if shape_id.endswith("1"):
            return trimesh.creation.box((1, scale, 2)).subdivide().subdivide()
        return trimesh.creation.icosphere(2).apply_scale((1, 1, scale))
"""
CONFIG = {
    "datasets": {"hostile": {"plugin": "hostile.py:Hostile", "shards": 1}},
    "eigenpairs": 40,
    "max_failures": 1,
    "table1": {
        "databases": ["hostile"],
        "columns": [{"column": "ShapeDNA", "baseline": "shapedna"}],
        "seeds": [0],
    },
}


def test_names_stay_names(tmp_path: Path) -> None:
    folder = tmp_path / "outer" / "run"
    folder.mkdir(parents=True)
    (folder / "hostile.py").write_text(HOSTILE)
    done = Workdir(folder).run("results/table1.csv", config=CONFIG)
    assert done.returncode == 0, done.stdout

    assert sorted(path.name for path in (tmp_path / "outer").iterdir()) == ["run"]
    assert not list(Path("/").glob("gipkg-absolute*"))
    made = [
        path.relative_to(folder) for path in folder.rglob("*") if ".snakemake" not in path.parts
    ]
    assert not [path for path in made if set(path.name) & set("<>|\n\"'")]

    rows = read_csv(folder / "results/datasets/hostile/shapes.csv")
    listed = {row["id"]: row["label"] for row in rows}
    assert len(listed) == 12
    shard = Shard.open(folder / "results/baselines/hostile/shapedna/0.npz")
    assert set(shard) | set(shard.failures) == set(listed)
    assert set(shard.failures) == {"a\nb0"}
    note = (folder / "results/table1.md").read_text()
    assert "alert(2)" in note
    assert "<" not in re.sub("`[^`]*`", "", note)
    failures = json.loads((folder / "results/table1.json").read_text())["databases"]["hostile"]
    assert list(failures["failures"]["ShapeDNA"]) == ["a\nb0"]
