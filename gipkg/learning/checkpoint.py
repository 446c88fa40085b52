"""State of a training on disk, from which it goes on as if it had never been interrupted."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from pickle import UnpicklingError

import torch
from torch import Tensor, nn
from torch.optim import Optimizer

from gipkg.errors import DamagedFileError
from gipkg.files import atomic


def fingerprint(description: str, *tensors: Tensor) -> str:
    """Identify a training by all that determines its result."""
    digest = hashlib.sha256(f"{torch.__version__}\n{description}".encode())
    for tensor in tensors:
        digest.update(tensor.contiguous().flatten().view(torch.uint8).numpy().data)
    return digest.hexdigest()


@dataclass(frozen=True)
class Checkpoint:
    """A file that holds the latest state of one training.

    Random numbers are no part of the state: the training derives them from seed and step.

    Attributes
    ----------
    path : Path
        Replaced atomically at every save.
    fingerprint : str
        Of the training; a file that another training left is ignored and replaced.
    """

    path: Path
    fingerprint: str

    def save(self, step: int, network: nn.Module, optimiser: Optimizer) -> None:
        """Write the state after `step` steps."""
        state = {
            "fingerprint": self.fingerprint,
            "step": step,
            "network": network.state_dict(),
            "optimiser": optimiser.state_dict(),
        }
        with atomic(self.path) as stream:
            torch.save(state, stream)

    def restore(self, network: nn.Module, optimiser: Optimizer, device: torch.device) -> int:
        """Put the saved state back and return its step; 0 where there is none.

        Raises
        ------
        DamagedFileError
            The file cannot be read.
        """
        if not self.path.exists():
            return 0
        try:
            state = torch.load(self.path, map_location=device, weights_only=True)
            is_ours = state["fingerprint"] == self.fingerprint
        except (RuntimeError, UnpicklingError, EOFError, OSError, LookupError, TypeError) as error:
            # The error's own text would advise to load the file unsafely.
            raise DamagedFileError(
                f"{self.path}: cannot be read as a checkpoint; delete it to train afresh"
            ) from error
        if not is_ours:
            return 0
        network.load_state_dict(state["network"])
        optimiser.load_state_dict(state["optimiser"])
        return int(state["step"])
