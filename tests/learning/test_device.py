from __future__ import annotations

import pytest
import torch

from gipkg.errors import LearningError
from gipkg.learning.device import choose_device, computes_in_bfloat16, reproducible

CPU = torch.device("cpu")


def test_auto_takes_cuda_where_there_is_one() -> None:
    expected = "cuda" if torch.cuda.is_available() else "cpu"
    assert choose_device("auto").type == expected


@pytest.mark.parametrize("name", ["cuda:63", "toaster"])
def test_a_device_that_is_not_there_is_refused(name: str) -> None:
    with pytest.raises(LearningError, match=name):
        choose_device(name)


def test_bfloat16_follows_the_processor_unless_told(monkeypatch: pytest.MonkeyPatch) -> None:
    assert computes_in_bfloat16(CPU, "bfloat16")
    assert not computes_in_bfloat16(CPU, "float32")
    for capabilities, expected in [
        ({"avx512_bf16": True}, True),
        ({"amx_bf16": True, "avx512_bf16": False}, True),
        ({"avx2": True}, False),
    ]:
        monkeypatch.setattr(torch.cpu, "get_capabilities", lambda c=capabilities: c, raising=False)
        assert computes_in_bfloat16(CPU, "auto") == expected
    monkeypatch.delattr(torch.cpu, "get_capabilities")
    assert not computes_in_bfloat16(CPU, "auto")


def global_state() -> tuple[int, bool, bool]:
    deterministic = torch.are_deterministic_algorithms_enabled()
    filled = torch.utils.deterministic.fill_uninitialized_memory
    return torch.get_num_threads(), deterministic, filled


def test_the_global_state_of_torch_is_put_back() -> None:
    before = global_state()
    state = torch.get_rng_state()
    with reproducible(CPU, threads=1):
        assert torch.get_num_threads() == 1
        assert torch.are_deterministic_algorithms_enabled()
        torch.manual_seed(123)
        torch.rand(3)
        assert not torch.utils.deterministic.fill_uninitialized_memory
    assert global_state() == before
    assert torch.equal(torch.get_rng_state(), state)
