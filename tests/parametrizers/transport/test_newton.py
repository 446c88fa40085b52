from itertools import pairwise

import numpy as np
import pytest

from gipkg.parametrizers.transport.newton import newton_step
from gipkg.parametrizers.transport.power_diagram import power_diagram
from tests.support.shapes import fibonacci


def test_steps_converge_quadratically_to_the_areas_wanted() -> None:
    sites = fibonacci(400)
    areas = np.random.default_rng(0).uniform(1, 3, 400)
    areas *= 4 * np.pi / areas.sum()
    weights, diagram = np.zeros(400), power_diagram(sites)
    errors = []
    for _ in range(8):
        step = newton_step(sites, areas, weights, diagram)
        assert step is not None
        assert step.kept.all()
        weights, diagram = step.weights, step.diagram
        errors.append(np.abs(diagram.areas / areas - 1).max())
    assert step.length == 1
    assert errors[-1] < 1e-10
    fast = [after for before, after in pairwise(errors) if before < 0.1]
    assert fast[0] < 0.02


def test_the_solution_depends_on_the_areas_and_not_on_the_start() -> None:
    sites = fibonacci(100)
    areas = np.random.default_rng(1).uniform(1, 2, 100)
    areas *= 4 * np.pi / areas.sum()
    ends = []
    for seed in (2, 3):
        weights = np.random.default_rng(seed).uniform(0, 2e-3, 100)
        diagram = power_diagram(np.exp(weights)[:, None] * sites)
        for _ in range(10):
            step = newton_step(sites, areas, weights, diagram)
            assert step is not None
            weights, diagram = step.weights, step.diagram
        ends.append(weights - weights.mean())
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)


def test_it_ends_where_there_is_no_solution() -> None:
    sites = fibonacci(50)
    areas = np.full(50, 1e-3)
    areas[0] = 4 * np.pi - areas[1:].sum()  # more than half of the sphere for one point
    weights, diagram = np.zeros(50), power_diagram(sites)
    for _ in range(200):
        step = newton_step(sites, areas, weights, diagram)
        if step is None:
            break
        weights, diagram = step.weights, step.diagram
    assert step is None
    assert 1 < diagram.areas[0] < 2 * np.pi
    assert diagram.areas.sum() == pytest.approx(4 * np.pi, abs=1e-9)
