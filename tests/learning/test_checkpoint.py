"""A training that was killed goes on from its checkpoint, and from no other file."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from gipkg.errors import DamagedFileError
from gipkg.learning import checkpoint as checkpoints
from gipkg.learning import training as loop
from gipkg.learning.config import NetworkConfig
from gipkg.learning.prediction import Prediction
from tests.learning.trainings import (
    IMAGES,
    LONGER,
    SHORT,
    SMALL,
    TOGETHER,
    TRAIN,
    assert_equal,
    run,
)


class Killed(Exception):
    pass


@pytest.mark.parametrize(
    ("at", "network", "fixture"),
    [
        (1, SMALL, "undisturbed"),
        (23, SMALL, "undisturbed"),
        (7, TOGETHER, "undisturbed_together"),
    ],
)
def test_a_killed_training_ends_as_an_undisturbed_one(
    at: int,
    network: NetworkConfig,
    fixture: str,
    request: pytest.FixtureRequest,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    undisturbed = request.getfixturevalue(fixture)
    monkeypatch.setattr(loop, "SECONDS_BETWEEN_CHECKPOINTS", 0.0)
    path = tmp_path / "work" / "state.pt"
    save = checkpoints.Checkpoint.save

    def killed(self: Any, step: int, *state: Any) -> None:
        save(self, step, *state)
        if step == at:
            raise Killed

    with monkeypatch.context() as patch:
        patch.setattr(checkpoints.Checkpoint, "save", killed)
        with pytest.raises(Killed):
            run(checkpoint=path, network=network)
    steps: list[int] = []
    monkeypatch.setattr(
        checkpoints.Checkpoint,
        "save",
        lambda self, step, *state: (steps.append(step), save(self, step, *state)),
    )
    assert_equal(run(checkpoint=path, network=network), undisturbed)
    assert steps[0] == at + 1
    assert [file.name for file in path.parent.iterdir()] == ["state.pt"]


def test_a_process_killed_by_the_system_is_resumed(tmp_path: Path) -> None:
    path, out = tmp_path / "state.pt", tmp_path / "embeddings.npy"
    program = f"""
import numpy as np
from pathlib import Path
from gipkg.learning import training as loop
from tests.learning.trainings import LONGER, run
loop.SECONDS_BETWEEN_CHECKPOINTS = 0.0
np.save({str(out)!r}, run(training=LONGER, checkpoint=Path({str(path)!r})).embeddings)
"""
    repository = Path(__file__).parents[2]
    command = [sys.executable, "-c", program]
    process = subprocess.Popen(command, cwd=repository, stderr=subprocess.DEVNULL)
    while not path.exists():
        assert process.poll() is None, "ended before its first checkpoint"
        time.sleep(0.01)
    process.kill()
    process.wait()
    assert not out.exists()
    subprocess.run(command, cwd=repository, stderr=subprocess.DEVNULL, check=True)
    np.testing.assert_array_equal(np.load(out), run(training=LONGER).embeddings)


def test_a_finished_training_is_not_repeated(
    undisturbed: Prediction, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "state.pt"
    run(checkpoint=path)
    monkeypatch.setattr(loop, "_descend", None)
    assert_equal(run(checkpoint=path), undisturbed)


def test_the_checkpoint_of_another_training_is_not_used(
    undisturbed: Prediction, tmp_path: Path
) -> None:
    path = tmp_path / "state.pt"
    run(checkpoint=path, training=SHORT.model_copy(update={"epochs": 2}))
    assert_equal(run(checkpoint=path), undisturbed)
    run(checkpoint=path, network=SMALL.model_copy(update={"dropout": 0.3}))
    assert_equal(run(checkpoint=path), undisturbed)
    run(checkpoint=path, network=SMALL.model_copy(update={"together": 2}))
    assert_equal(run(checkpoint=path), undisturbed)
    run({**IMAGES, TRAIN[0]: IMAGES[TRAIN[0]] + 1e-3}, checkpoint=path)
    assert_equal(run(checkpoint=path), undisturbed)


@pytest.mark.parametrize("content", [b"", b"not a checkpoint", None], ids=["empty", "other", "cut"])
def test_a_damaged_checkpoint_is_named(content: bytes | None, tmp_path: Path) -> None:
    path = tmp_path / "state.pt"
    quick = SHORT.model_copy(update={"epochs": 1})
    if content is None:
        run(checkpoint=path, training=quick)
        content = path.read_bytes()[:-1000]
    path.write_bytes(content)
    with pytest.raises(DamagedFileError, match=r"state\.pt.*delete it"):
        run(checkpoint=path, training=quick)


def test_a_checkpoint_that_holds_code_is_not_run(tmp_path: Path) -> None:
    class Bomb:
        def __reduce__(self) -> tuple:
            return (Path.touch, (tmp_path / "went-off",))

    path = tmp_path / "state.pt"
    torch.save({"fingerprint": Bomb()}, path)
    with pytest.raises(DamagedFileError, match=r"state\.pt: cannot be read"):
        run(checkpoint=path)
    assert not (tmp_path / "went-off").exists()
