"""Kill the smoke run at random moments, go on with the same command, and compare the results.

    git clone --quiet . ../frozen && cd ../frozen
    python -m benchmarks.kills FOLDER [--times 20] [--seed 0] [TARGET ...]

Every time, the whole process group is killed (SIGKILL) at a moment drawn evenly over what a run
takes, and the plain command is given again in the same folder. A run that ends before its moment
counts in nothing but this time: the undisturbed one had code to compile. The exit status is
the number of times that the files did not come out equal to those of the undisturbed run. FOLDER
keeps the undisturbed run and what became of each kill: started again, it goes on at the next one.
In a clone of its own, since the provenance files name the commit, which must not change meanwhile.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from gipkg.files import read_csv, write_csv
from tests.workflow.workdir import Workdir

COLUMNS = ("number", "moment", "files", "verdict")


def main() -> int:
    """Print a line a kill, and the sum."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("targets", nargs="*", help="of the smoke run; all of it by default")
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_intermixed_args()
    folder = options.folder.resolve()
    undisturbed = Workdir(folder / "undisturbed")
    seconds = undisturbed_seconds(undisturbed, options.targets)
    expected = undisturbed.hashes()
    print(f"undisturbed: {len(expected)} files in {seconds:.0f} s", flush=True)
    table = folder / "kills.csv"
    rows = [tuple(row.values()) for row in read_csv(table)] if table.exists() else []
    while len(rows) < options.times:
        number = len(rows) + 1
        moment = random.Random(f"{options.seed} {number} {seconds}").uniform(0, seconds)
        workdir = Workdir(folder / str(number))
        shutil.rmtree(workdir.path, ignore_errors=True)
        workdir.path.mkdir()
        ended = ended_before(workdir, options.targets, moment)
        if ended:
            seconds = ended
            clock_of(undisturbed).write_text(str(seconds))
            continue
        left = sum(path.is_file() for path in (workdir.path / "results").rglob("*"))
        finish(workdir, options.targets)
        found = workdir.hashes()
        wrong = sorted(name for name in expected | found if expected.get(name) != found.get(name))
        verdict = f"DIFFERENT: {' '.join(wrong[:5])}" if wrong else "equal"
        rows.append((str(number), f"{moment:.1f}", str(left), verdict))
        write_csv(table, COLUMNS, rows)
        print(f"kill {number} at {moment:.1f} s with {left} files: {verdict}", flush=True)
        shutil.rmtree(workdir.path)
    different = sum(row[-1] != "equal" for row in rows)
    print(f"{len(rows) - different} of {len(rows)} equal")
    return different


def clock_of(workdir: Workdir) -> Path:
    """Return where the seconds of a run are kept, beside its folder."""
    return workdir.path.with_suffix(".seconds")


def undisturbed_seconds(workdir: Workdir, targets: list[str]) -> float:
    """Return what a run takes that nothing disturbs, making it if there is none."""
    clock = clock_of(workdir)
    if not clock.exists():
        shutil.rmtree(workdir.path, ignore_errors=True)
        workdir.path.mkdir(parents=True)
        began = time.monotonic()
        finish(workdir, targets)
        clock.write_text(str(time.monotonic() - began))
    return float(clock.read_text())


def ended_before(workdir: Workdir, targets: list[str], seconds: float) -> float:
    """Start a run and kill all of it, or return the seconds it took if it ended before: else 0."""
    began = time.monotonic()
    run = subprocess.Popen(
        workdir.command(*targets),
        cwd=workdir.path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        run.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        return 0.0
    return time.monotonic() - began


def finish(workdir: Workdir, targets: list[str]) -> None:
    """Give the plain command and let it end."""
    done = workdir.run(*targets)
    if done.returncode:
        raise SystemExit(f"the run in {workdir.path} failed:\n{done.stdout[-3000:]}")


if __name__ == "__main__":
    sys.exit(main())
