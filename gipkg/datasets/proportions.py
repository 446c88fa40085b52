"""Random proportions of the generated databases."""

from __future__ import annotations

import numpy as np


def vary(rng: np.random.Generator, value: float, spread: float) -> float:
    """Multiply `value` by a factor log-uniform in [exp(-spread), exp(spread)]."""
    return value * float(np.exp(rng.uniform(-spread, spread)))
