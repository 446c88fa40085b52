"""The smoke run on one core and on two, with one shard a database and with four: is it the same.

    git clone --quiet . ../frozen && cd ../frozen
    python -m benchmarks.same_twice FOLDER [TARGET ...]

With more cores every file has to be the same, byte for byte, but for logs, clocks and the columns
of seconds in tables. With more shards the shapes are in other files: what is said of each shape is
compared, array by array, and what is made of all shapes file by file. The exit status is the
number of differences. FOLDER keeps the four runs: started again, it goes on where it was. In a
clone of its own, since the provenance files name the commit, which must not change meanwhile.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

import yaml

from gipkg.shards import Shard
from tests.workflow.workdir import SMOKE, Workdir

DATABASES = list(yaml.safe_load(SMOKE.read_text(encoding="utf-8"))["datasets"])


def main() -> int:
    """Print a line a comparison, and what differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("targets", nargs="*", help="of the smoke run; all of it by default")
    options = parser.parse_intermixed_args()
    folder, targets = options.folder.resolve(), options.targets
    first = run(folder / "two-cores", targets, cores=2, shards=None)
    second = run(folder / "one-core", targets, cores=1, shards=None)
    different = compare("two cores and one", first.hashes(), second.hashes())
    one = run(folder / "one-shard", targets, cores=2, shards=1)
    four = run(folder / "four-shards", targets, cores=2, shards=4)
    different += compare("one shard and four, shapes", contents(one), contents(four))
    different += compare("one shard and four, files", together(one), together(four))
    return min(different, 100)


def run(folder: Path, targets: list[str], cores: int, shards: int | None) -> Workdir:
    """Run all of the smoke configuration in a folder, or what it takes for some targets."""
    folder.mkdir(parents=True, exist_ok=True)
    config = {"datasets": {name: {"shards": shards} for name in DATABASES}} if shards else None
    began = time.monotonic()
    workdir = Workdir(folder)
    done = workdir.run(*targets, "--cores", str(cores), config=config)
    if done.returncode:
        raise SystemExit(f"the run in {folder} failed:\n{done.stdout[-3000:]}")
    print(f"{folder.name}: {time.monotonic() - began:.0f} s", flush=True)
    return workdir


def contents(workdir: Workdir) -> dict[str, str]:
    """Return a hash of every array of every shape: stage, shape and name -> hash."""
    found = {}
    for path in shards_in(workdir):
        shard = Shard.open(path)
        stage = path.parent.relative_to(workdir.path / "results")
        for shape_id in shard:
            for name, array in shard[shape_id].items():
                content = f"{array.dtype} {array.shape} ".encode() + array.tobytes()
                found[f"{stage}: {shape_id}/{name}"] = sha256(content).hexdigest()
        found |= {f"{stage}: {one}": reason for one, reason in shard.failures.items()}
    return found


def together(workdir: Workdir) -> dict[str, str]:
    """Return the hashes of the files that are made of all shapes.

    Left out are what names the shards: the listings, and the configuration in provenance files.
    """
    results = workdir.path / "results"
    apart = {path.relative_to(results).as_posix() for path in shards_in(workdir)}
    return {
        name: value
        for name, value in workdir.hashes().items()
        if name not in apart
        and not name.endswith("shapes.csv")
        and not is_provenance(results, name)
    }


def is_provenance(results: Path, name: str) -> bool:
    """Tell whether a file says what made a table or figure."""
    return "/" not in name and name.endswith(".json") and (results / name).exists()


def shards_in(workdir: Workdir) -> list[Path]:
    """Return the files that hold shapes, each of them in one."""
    found = (workdir.path / "results").rglob("*.npz")
    return sorted(path for path in found if path.stem.isdigit())


def compare(label: str, one: Mapping[str, str], other: Mapping[str, str]) -> int:
    """Print how many of two mappings are equal, and the first few that are not."""
    differ = sorted(name for name in one | other if one.get(name) != other.get(name))
    print(f"{label}: {len(one | other) - len(differ)} of {len(one | other)} equal", flush=True)
    for name in differ[:20]:
        print(f"  {name}", flush=True)
    return len(differ)


if __name__ == "__main__":
    sys.exit(main())
