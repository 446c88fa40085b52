"""A folder that the workflow runs in, and what can be asked of it."""

from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import yaml

REPOSITORY = Path(__file__).resolve().parents[2]
SMOKE = REPOSITORY / "config" / "smoke.yaml"


@dataclass(frozen=True)
class Workdir:
    """A folder that the workflow runs in.

    Attributes
    ----------
    path : Path
    checkout : Path
        The code: a working copy of the repository, whose own package its Snakefile finds first.
    """

    path: Path
    checkout: Path = REPOSITORY

    def command(
        self, *arguments: str | Path, config: Mapping[str, object] | None = None
    ) -> list[str]:
        """Return the command line of a run of the smoke configuration, changed by `config`."""
        files = [str(SMOKE)]
        if config is not None:
            # Tests that share a folder may ask at the same time.
            changes = self.path / f"changes-{os.getpid()}.yaml"
            changes.write_text(yaml.safe_dump(dict(config)), encoding="utf-8")
            files.append(str(changes))
        return [
            *(sys.executable, "-m", "snakemake", "--snakefile", str(self.checkout / "Snakefile")),
            *("--directory", str(self.path), "--cores", "2", "--nolock"),
            *map(str, arguments),
            *("--configfile", *files),
        ]

    def run(
        self,
        *arguments: str | Path,
        config: Mapping[str, object] | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> subprocess.CompletedProcess[str]:
        """Run the workflow to its end."""
        return subprocess.run(
            self.command(*arguments, config=config),
            cwd=self.path,
            env={**os.environ, **(environment or {})},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )

    def planned(
        self,
        config: Mapping[str, object] | None = None,
        environment: Mapping[str, str] | None = None,
        targets: Sequence[str] = (),
    ) -> dict[str, int]:
        """Return the jobs that a run would do, of all or for some targets: rule -> how many."""
        done = self.run(*targets, "--dry-run", config=config, environment=environment)
        assert done.returncode == 0, done.stdout
        listing = done.stdout.partition("Job stats:")[2].partition("\n\n")[0]
        counts = {name: int(count) for name, count in re.findall(r"^(\w+) +(\d+)$", listing, re.M)}
        counts.pop("total", None)
        return counts

    def hashes(self) -> dict[str, str]:
        """Return the hash of every result but logs and what clocks said."""
        results = self.path / "results"
        apart = {"logs", "benchmarks", "table_distortion.md", "index.html"}
        return {
            str(path.relative_to(results)): sha256(_without_clocks(path)).hexdigest()
            for path in sorted(results.rglob("*"))
            if path.is_file() and path.relative_to(results).parts[0] not in apart
        }

    def copy(self, target: Path) -> Workdir:
        """Return a folder with the same results: linked, since results are only ever replaced."""
        shutil.copytree(self.path / "results", target / "results", copy_function=os.link)
        shutil.copytree(self.path / ".snakemake", target / ".snakemake")
        return Workdir(target)


def _without_clocks(path: Path) -> bytes:
    """Return the content of a file; of a table, without its columns of seconds."""
    if path.suffix != ".csv":
        return path.read_bytes()
    with path.open(newline="") as stream:
        header, *rows = filter(None, csv.reader(stream))
    if rows and rows[-1][0].startswith("# sha256"):
        rows.pop()
    kept = [number for number, name in enumerate(header) if not name.startswith("seconds")]
    return repr([[row[number] for number in kept] for row in (header, *rows)]).encode()
