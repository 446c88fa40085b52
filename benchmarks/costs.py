"""What a shape costs in each stage, from a run that was made, and so what more shapes would.

    python -m benchmarks.costs RESULTS DATABASE [--shapes 12311 1000000] [--shard 200]

RESULTS is the folder of a run. Of every stage that has the database: shapes, CPU seconds and bytes
a shape, and the largest memory of a job. Then, for so many shapes of the same kind: core-hours,
bytes and files of all of these stages together, with --shard shapes in a job. Trainings are listed
apart: their cost is that of the views they are shown.
"""

from __future__ import annotations

import argparse
import csv
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from gipkg.files import read_csv, read_json
from gipkg.shards import Shard

FILES_A_JOB = 4
"""The shard, its log, its clock, and what Snakemake remembers of it."""


@dataclass
class Stage:
    """What the jobs of one stage took together."""

    shapes: int = 0
    seconds: float = 0.0
    size: int = 0
    memory: float = 0.0

    def add(self, shapes: int, seconds: float, size: int, memory: float) -> None:
        """Count one job."""
        self.shapes += shapes
        self.seconds += seconds
        self.size += size
        self.memory = max(self.memory, memory)


def main() -> None:
    """Print a row a stage, a row a training, and a row a number of shapes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path)
    parser.add_argument("database")
    parser.add_argument("--shapes", type=int, nargs="+", default=[12_311, 1_000_000])
    parser.add_argument("--shard", type=int, default=200, help="shapes a job works on")
    options = parser.parse_args()
    stages: dict[str, Stage] = defaultdict(Stage)
    for name, job in jobs(options.results, options.database):
        stages[name].add(*job)
    print("| stage | shapes | CPU s a shape | kB a shape | peak MB |\n|---|---|---|---|---|")
    for name, stage in stages.items():
        seconds, size = stage.seconds / stage.shapes, stage.size / stage.shapes / 1000
        print(f"| {name} | {stage.shapes} | {seconds:.3f} | {size:.0f} | {stage.memory:.0f} |")
    print("\n| training | CPU s | peak MB |\n|---|---|---|")
    for name, seconds, memory in trainings(options.results, options.database):
        print(f"| {name} | {seconds:.0f} | {memory:.0f} |")
    print("\n| shapes | core-hours | GB | files |\n|---|---|---|---|")
    for count in options.shapes:
        hours = sum(one.seconds / one.shapes for one in stages.values()) * count / 3600
        size = sum(one.size / one.shapes for one in stages.values()) * count / 1e9
        files = -(-count // options.shard) * len(stages) * FILES_A_JOB
        print(f"| {count} | {hours:.1f} | {size:.1f} | {files} |")


def jobs(results: Path, database: str) -> Iterator[tuple[str, tuple[int, float, int, float]]]:
    """Yield what every job on a shard took: stage, and shapes, CPU seconds, bytes, MB."""
    for clock in clocks(results, database):
        if clock.stem.isdigit():
            path = results / clock.relative_to(results / "benchmarks").with_suffix(".npz")
            stage = str(clock.parent.relative_to(results / "benchmarks"))
            shard, (seconds, memory) = Shard.open(path), took(clock)
            by_shape = clock.with_suffix(".csv")
            if by_shape.exists():
                seconds = sum(float(row["seconds"]) for row in read_csv(by_shape))
            yield (
                stage.replace(f"/{database}", ""),
                (len(shard), seconds, path.stat().st_size, memory),
            )


def trainings(results: Path, database: str) -> Iterator[tuple[str, float, float]]:
    """Yield what every training took: name, CPU seconds and MB."""
    for clock in clocks(results, database):
        # Trainings alone keep their exact seconds beside: other jobs have clocks here, too.
        exact = clock.with_suffix(".json")
        if exact.exists():
            seconds = read_json(exact, sealed=True)["cpu"]
            name = str(clock.relative_to(results / "benchmarks").with_suffix(""))
            yield name, seconds, took(clock)[1]


def clocks(results: Path, database: str) -> list[Path]:
    """Return the files in which Snakemake keeps what the jobs on a database took."""
    folder = results / "benchmarks"
    found = folder.glob(f"*/{database}/**/*.tsv")
    return sorted(found)


def took(clock: Path) -> tuple[float, float]:
    """Return the CPU seconds and the MB of a job's last run.

    Snakemake looks at a job every half minute: the share of a core that it saw, of the whole time.
    """
    with clock.open(newline="") as stream:
        row = list(csv.DictReader(stream, delimiter="\t"))[-1]
    return float(row["s"]) * float(row["mean_load"]) / 100, float(row["max_rss"])


if __name__ == "__main__":
    main()
