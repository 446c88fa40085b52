from dataclasses import replace

import numpy as np
import pytest

from gipkg.parametrizers.variational.optimal_map import _of_both_measures


def test_rounds_weigh_both_measures_of_area_distortion_alike(small_problem) -> None:
    energy, _ = small_problem
    rng = np.random.default_rng(0)
    targets = energy.targets * rng.lognormal(size=len(energy.targets))
    energy = replace(energy, targets=targets, weights=rng.random(len(targets)))
    weights = _of_both_measures(energy).weights
    errors = rng.standard_normal(len(targets))  # of the area ratios
    mean_square, variance = np.mean(errors**2), np.mean((targets * errors) ** 2)
    expected = 0.5 * mean_square + 0.5 * variance / np.mean(targets**2)
    found = np.mean(weights * errors**2) / energy.weights.mean()
    assert found == pytest.approx(expected)
    assert weights.mean() == pytest.approx(energy.weights.mean())
