"""Where a network runs and in which arithmetic, and the promise that it does so repeatably."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import torch

from gipkg.errors import LearningError
from gipkg.learning.config import Precision


def choose_device(name: str) -> torch.device:
    """Resolve ``auto``: the first CUDA device where there is one, else the processor.

    Raises
    ------
    LearningError
        The device asked for is unknown or absent.
    """
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    try:
        device = torch.device(name)
        torch.empty(0, device=device)
    # torch raises AssertionError where it was built without the device.
    except (RuntimeError, AssertionError) as error:
        raise LearningError(f"device {name!r} cannot be used ({error}); try 'cpu'") from error
    return device


def computes_in_bfloat16(device: torch.device, precision: Precision) -> bool:
    """Whether a training on `device` uses bfloat16 where that is safe (autocast).

    On processors ``auto`` asks for native instructions (AVX-512 BF16 or AMX), since emulation
    is slower than float32; older versions of torch cannot tell and get float32.
    """
    if precision != "auto":
        return precision == "bfloat16"
    if device.type == "cuda":
        return torch.cuda.is_bf16_supported(including_emulation=False)
    if device.type != "cpu" or not hasattr(torch.cpu, "get_capabilities"):
        return False
    capabilities = torch.cpu.get_capabilities()
    return bool(capabilities.get("avx512_bf16") or capabilities.get("amx_bf16"))


@contextmanager
def reproducible(device: torch.device, threads: int) -> Iterator[None]:
    """Deterministic kernels on a fixed number of threads, and torch's global state put back."""
    # cuBLAS reads this at its first use and is not deterministic without it.
    os.environ.setdefault("CUBLAS_WORKSPACE_CONFIG", ":4096:8")
    threads_before = torch.get_num_threads()
    deterministic_before = torch.are_deterministic_algorithms_enabled()
    deterministic: Any = torch.utils.deterministic  # Its property is not annotated.
    filled_before = deterministic.fill_uninitialized_memory
    torch.set_num_threads(threads)
    torch.use_deterministic_algorithms(True)
    # Filling all new memory first takes time, and no kernel here reads what it has not written.
    deterministic.fill_uninitialized_memory = False
    try:
        with torch.random.fork_rng(devices=[device] if device.type == "cuda" else []):
            yield
    finally:
        deterministic.fill_uninitialized_memory = filled_before
        torch.use_deterministic_algorithms(deterministic_before)
        torch.set_num_threads(threads_before)
