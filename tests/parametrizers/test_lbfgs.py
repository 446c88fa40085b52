import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gipkg.parametrizers.lbfgs import Memory


@given(seed=st.integers(0, 2**32 - 1), size=st.integers(1, 6))
def test_a_quadratic_s_conjugate_steps_give_its_inverse_whatever_the_first_guess(
    seed: int, size: int
) -> None:
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((size, size))
    hessian, guess = root @ root.T + np.eye(size), 10 ** rng.uniform(-1, 1)
    memory = Memory(size)
    # Steps that are conjugate to each other leave every earlier pair's equation true.
    for direction in np.linalg.eigh(hessian)[1].T:
        memory.add(direction, hessian @ direction)
    gradient = rng.standard_normal(size)
    product = memory.inverse_hessian(gradient, lambda vector: guess * vector)
    np.testing.assert_allclose(hessian @ product, gradient, atol=1e-9 * np.linalg.cond(hessian))


def test_without_pairs_it_is_the_first_guess_and_leaves_the_gradient_alone() -> None:
    gradient = np.arange(6.0).reshape(2, 3)
    product = Memory(3).inverse_hessian(gradient, lambda vectors: 2 * vectors)
    np.testing.assert_array_equal(product, 2 * gradient)
    np.testing.assert_array_equal(gradient, np.arange(6.0).reshape(2, 3))


def test_only_convex_pairs_are_kept_and_only_the_last_ones() -> None:
    memory = Memory(1)
    memory.add(np.array([1.0, 0]), np.array([-1.0, 0]))
    assert memory.latest is None
    memory.add(np.zeros(2), np.zeros(2))
    assert memory.latest is None
    memory.add(np.array([1.0, 0]), np.array([4.0, 0]))
    memory.add(np.array([0, 1.0]), np.array([0, 8.0]))
    np.testing.assert_array_equal(memory.latest, ([0, 1], [0, 8]))
    product = memory.inverse_hessian(np.array([1.0, 1]), lambda vector: vector)
    np.testing.assert_allclose(product, [1, 1 / 8])
