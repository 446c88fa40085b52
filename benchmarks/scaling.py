"""What planning a run costs as a database grows: seconds and memory of a dry run of Table 1.

    python -m benchmarks.scaling 1000 10000 100000

The database is a listing: so many names in ten classes, and no shape behind them. A shard holds
`--shard` shapes, as the configuration would for a database of that size.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path

from tests.workflow.workdir import Workdir

LISTING = '''
from pathlib import Path
from typing import ClassVar

from pydantic import Field

from gipkg.api import Dataset, DatasetTags, Protocol, Shape


class Listing(Dataset):
    """Names and classes of shapes that are nowhere."""

    summary: ClassVar[str] = "a listing without shapes"
    citation: ClassVar[str] = "none"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=1000, classes=10, licence="none", source="none"
    )
    protocols: ClassVar[dict[str, Protocol]] = {"Half": Protocol(0.5)}
    count: int = Field(1000, description="shapes")

    def available(self, root: Path) -> bool:
        return True

    def fetch(self, root: Path) -> None:
        pass

    def shapes(self, root: Path) -> tuple[Shape, ...]:
        return tuple(Shape(f"{i:07d}", f"class{i % 10}") for i in range(self.count))

    def load(self, root: Path, shape_id: str):
        raise LookupError(shape_id)
'''


def main() -> None:
    """Print a line a size."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sizes", nargs="*", type=int, default=[1_000, 10_000, 100_000])
    parser.add_argument("--shard", type=int, default=200, help="shapes a job works on")
    options = parser.parse_args()
    print("| shapes | shards | jobs | seconds | peak MB |\n|---|---|---|---|---|")
    for count in options.sizes:
        shards = -(-count // options.shard)
        jobs, seconds, peak = plan(count, shards)
        print(f"| {count} | {shards} | {jobs} | {seconds:.1f} | {peak:.0f} |", flush=True)


def plan(count: int, shards: int) -> tuple[int, float, float]:
    """Return the jobs of a dry run, its wall seconds and its peak memory in MB."""
    with tempfile.TemporaryDirectory(prefix="scaling-") as scratch:
        (Path(scratch) / "listing.py").write_text(textwrap.dedent(LISTING))
        config = {
            "datasets": {
                "listing": {"plugin": "listing.py:Listing", "count": count, "shards": shards}
            },
            "table1": {
                "databases": ["listing"],
                "columns": [
                    {
                        "column": "Ours",
                        "parametrizer": "authalic",
                        "descriptors": ["hks"],
                        "network": "shallow",
                    }
                ],
                "seeds": [0],
            },
        }
        workdir = Workdir(Path(scratch))
        command = workdir.command(
            "results/table1.csv", "--dry-run", "--quiet", "rules", config=config
        )
        began = time.monotonic()
        measured = subprocess.run(
            [sys.executable, "-c", MEASURE, *command],
            cwd=scratch,
            capture_output=True,
            text=True,
            check=False,
        )
        seconds = time.monotonic() - began
    if measured.returncode:
        raise SystemExit(measured.stdout[-2000:] + measured.stderr[-2000:])
    total = next(line for line in measured.stdout.splitlines() if line.startswith("total"))
    return int(total.split()[1]), seconds, float(measured.stderr.split()[-1]) / 1024


MEASURE = """
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:])
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=sys.stderr)
sys.exit(done.returncode)
"""


if __name__ == "__main__":
    main()
