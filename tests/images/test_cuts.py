"""The paper's 36 cuts, and uniform random ones."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.images.cuts import random_cuts, standard_cuts


def test_six_polar_axes_with_six_turns_of_sixty_degrees() -> None:
    cuts = standard_cuts()
    assert len(cuts) == 36
    assert_array_equal(cuts[0].as_matrix(), np.eye(3))
    poles = cuts.inv().apply([0, 0, 1]).reshape(6, 6, 3)
    assert_allclose(poles, np.repeat(poles[:, :1], 6, axis=1), atol=1e-15)
    assert {tuple(p) for p in np.rint(poles[:, 0]).astype(int).tolist()} == {
        (sign if k == 0 else 0, sign if k == 1 else 0, sign if k == 2 else 0)
        for k in range(3)
        for sign in (-1, 1)
    }
    turns = cuts.as_matrix().reshape(6, 6, 3, 3)
    steps = turns[:, 1:] @ np.swapaxes(turns[:, :-1], -1, -2)
    sixty = [[0.5, -np.sqrt(0.75), 0], [np.sqrt(0.75), 0.5, 0], [0, 0, 1]]
    assert_allclose(steps, np.broadcast_to(sixty, steps.shape), atol=1e-15)


def test_random_cuts_are_uniform_and_repeatable() -> None:
    cuts = random_cuts(20_000, np.random.default_rng(0))
    assert_array_equal(
        cuts[:5].as_quat(), random_cuts(20_000, np.random.default_rng(0))[:5].as_quat()
    )
    # Haar measure: the rotation angle has density (1 - cos a) / π, mean π/2 + 2/π.
    assert_allclose(cuts.magnitude().mean(), np.pi / 2 + 2 / np.pi, atol=0.02)
    assert_allclose(cuts.apply([0, 0, 1]).mean(axis=0), 0, atol=0.02)
