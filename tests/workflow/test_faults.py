"""A full disk, a folder that nothing can be written to, damaged files: named, not built upon."""

from __future__ import annotations

import resource
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.workflow.workdir import Workdir

IMAGES = "results/images/tiny/authalic/hks/standard"
TARGET = f"{IMAGES}/0.npz"


def in_a_mount(command: list[str], mounts: str) -> list[str]:
    """Return a command that runs with mounts that nobody else sees."""
    begin = ["unshare", "--mount", "--map-root-user", "sh", "-c", f'{mounts} && exec "$@"', "sh"]
    return [*begin, *command]


@pytest.fixture
def workdir(smoke: Workdir, tmp_path: Path) -> Workdir:
    return smoke.copy(tmp_path)


@pytest.mark.parametrize(
    ("mounts", "fault"),
    [
        ("mount -t tmpfs -o size=64k tmpfs '{}'", "No space left on device"),
        ("mount --bind '{0}' '{0}' && mount -o remount,bind,ro '{0}'", "Read-only file system"),
    ],
    ids=["full disk", "read-only"],
)
def test_a_disk_that_takes_nothing(
    smoke: Workdir, workdir: Workdir, mounts: str, fault: str
) -> None:
    mounts = mounts.format(workdir.path / IMAGES)
    if not shutil.which("unshare") or subprocess.run(in_a_mount(["true"], mounts)).returncode:
        pytest.skip("nothing can be mounted here: unshare --mount needs its permission")
    command = workdir.command(TARGET, "--forcerun", "images")
    done = subprocess.run(
        in_a_mount(command, mounts), cwd=workdir.path, capture_output=True, text=True, check=False
    )
    said = done.stdout + done.stderr
    assert done.returncode != 0
    assert fault in said
    assert IMAGES in said.partition(fault)[2].partition("\n")[0]

    # The same command goes on once there is room.
    assert workdir.run(TARGET).returncode == 0
    name = TARGET.removeprefix("results/")
    assert workdir.hashes()[name] == smoke.hashes()[name]


def test_a_file_that_may_not_grow(workdir: Workdir) -> None:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

    done = subprocess.run(
        workdir.command(TARGET, "--forcerun", "images"),
        cwd=workdir.path,
        preexec_fn=limit,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0
    assert "File too large: 'results/images/" in done.stdout + done.stderr
    assert not (workdir.path / TARGET).exists()


@pytest.mark.parametrize(
    ("damaged", "target", "rule"),
    [
        ("results/surfaces/tiny/0.npz", "results/parametrizers/tiny/authalic/0.npz", "parametrize"),
        ("results/datasets/tiny/splits/Tiny1-0.csv", "results/table1.csv", "evaluate"),
        ("results/evaluation/table1/tiny/ours/Tiny1.json", "results/table1.csv", "score_table"),
    ],
)
def test_a_truncated_file_is_named(workdir: Workdir, damaged: str, target: str, rule: str) -> None:
    path = workdir.path / damaged
    content = path.read_bytes()
    path.unlink()  # It is linked to the undisturbed run's.
    path.write_bytes(content[: len(content) - len(content) // 3])
    done = workdir.run(target, "--forcerun", rule, "--rerun-triggers", "input")
    assert done.returncode != 0
    assert f"DamagedFileError: {damaged}: not a whole" in done.stdout
