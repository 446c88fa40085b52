"""A full disk, a folder that nothing can be written to, damaged files: named, not built upon."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
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
        ("mount -t tmpfs -o size=64k tmpfs '{}'", "No space left on device: '"),
        (
            "mount --bind '{0}' '{0}' && mount -o remount,bind,ro '{0}'",
            "Write-protected output files for rule images:\n *output: ",
        ),
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
    assert re.search(fault + IMAGES, said), said

    # The same command goes on once there is room.
    assert workdir.run(TARGET).returncode == 0
    name = TARGET.removeprefix("results/")
    assert workdir.hashes()[name] == smoke.hashes()[name]


def cut_off(content: bytes) -> bytes:
    return content[: len(content) - len(content) // 3]


def changed(content: bytes) -> bytes:
    """Change the first digit after the first line."""
    start = content.index(b"\n")
    place = next(i for i, byte in enumerate(content) if i > start and byte in b"0123456789")
    return content[:place] + (b"8" if content[place] == ord("7") else b"7") + content[place + 1 :]


@pytest.mark.parametrize("damage", [cut_off, changed])
@pytest.mark.parametrize(
    ("damaged", "rule"),
    [
        ("results/datasets/tiny/splits/Tiny1-0.csv", "evaluate"),
        ("results/evaluation/table1/tiny/ours/Tiny1.json", "score_table"),
    ],
)
def test_a_damaged_text_is_named(
    workdir: Workdir, damaged: str, rule: str, damage: Callable[[bytes], bytes]
) -> None:
    path = workdir.path / damaged
    content = path.read_bytes()
    path.unlink()  # It is linked to the undisturbed run's.
    path.write_bytes(damage(content))
    targets = ("results/table1.csv", "--forcerun", rule, "--rerun-triggers", "input")
    done = workdir.run(*targets)
    assert done.returncode != 0
    assert f"DamagedFileError: {damaged}: not a whole" in done.stdout
