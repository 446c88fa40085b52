"""Kill the smoke run at random moments, go on with the same command, and compare the results.

    python -m benchmarks.kills --times 20 --seed 0

Every time, the whole process group is killed (SIGKILL) at a moment drawn evenly over what an
undisturbed run takes, and the plain command is given again in the same folder. The exit status is
the number of times that the files did not come out equal to those of the undisturbed run.
Commit nothing meanwhile: the provenance files name the commit.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.workflow.workdir import Workdir


def main() -> int:
    """Print a line a kill, and the sum."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("targets", nargs="*", help="of the smoke run; all of it by default")
    options = parser.parse_args()
    moments = random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix="kills-") as scratch:
        undisturbed = Workdir(Path(scratch) / "undisturbed")
        undisturbed.path.mkdir()
        began = time.monotonic()
        finish(undisturbed, options.targets)
        seconds = time.monotonic() - began
        expected = undisturbed.hashes()
        print(f"undisturbed: {len(expected)} files in {seconds:.0f} s", flush=True)
        different = 0
        for number in range(1, options.times + 1):
            workdir = Workdir(Path(scratch) / str(number))
            workdir.path.mkdir()
            moment = moments.uniform(0, seconds)
            left = kill_after(workdir, options.targets, moment)
            finish(workdir, options.targets)
            found = workdir.hashes()
            wrong = sorted(
                name for name in expected | found if expected.get(name) != found.get(name)
            )
            different += bool(wrong)
            verdict = f"DIFFERENT: {', '.join(wrong[:5])}" if wrong else "equal"
            print(f"kill {number} at {moment:.1f} s with {left} files: {verdict}", flush=True)
            shutil.rmtree(workdir.path)
    print(f"{options.times - different} of {options.times} equal")
    return different


def kill_after(workdir: Workdir, targets: list[str], seconds: float) -> int:
    """Start a run, kill all of it, and return how many files it had written."""
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
    return sum(path.is_file() for path in (workdir.path / "results").rglob("*"))


def finish(workdir: Workdir, targets: list[str]) -> None:
    """Give the plain command and let it end."""
    done = workdir.run(*targets)
    if done.returncode:
        raise SystemExit(f"the run in {workdir.path} failed:\n{done.stdout[-3000:]}")


if __name__ == "__main__":
    sys.exit(main())
