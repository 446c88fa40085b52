import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.cholesky import Cholesky, NotPositiveDefinite
from gipkg.errors import ParametrizationError


def _definite(seed: int, size: int) -> sp.csr_array:
    """Build a sparse positive definite matrix whose diagonal spans eight decades."""
    rng = np.random.default_rng(seed)
    factor = sp.random_array((size, size), density=0.2, rng=rng) + sp.eye_array(size)
    scale = sp.diags_array(10.0 ** rng.uniform(-4, 4, size))
    return (scale @ (factor @ factor.T) @ scale).tocsr()


@given(st.integers(0, 1000), st.integers(1, 40), st.integers(1, 3))
@settings(deadline=None, max_examples=25)
def test_solutions_satisfy_their_systems(seed: int, size: int, columns: int) -> None:
    matrix = _definite(seed, size)
    wanted = np.random.default_rng(seed).normal(size=(size, columns))
    wanted /= np.sqrt(matrix.diagonal())[:, None]
    found = Cholesky.of(matrix).solve(matrix @ wanted)
    scale = np.sqrt(matrix.diagonal())[:, None]
    np.testing.assert_allclose(found * scale, wanted * scale, atol=1e-6)


def test_one_analysis_serves_many_matrices() -> None:
    rows, columns = np.array([0, 1, 1]), np.array([0, 0, 1])
    cholesky = Cholesky(rows, columns, 2)
    for values in ([4.0, 1.0, 3.0], [1.0, -0.5, 2.0]):
        cholesky.factorize(np.array(values))
        full = np.array([[values[0], values[1]], [values[1], values[2]]])
        np.testing.assert_allclose(full @ cholesky.solve(np.array([1.0, 2.0])), [1, 2])


@pytest.mark.parametrize("values", [[1.0, 2.0, 1.0], [1.0, 0.0, -1.0], [np.nan, 0.0, 1.0]])
def test_what_is_not_positive_definite_is_refused(values: list[float]) -> None:
    cholesky = Cholesky(np.array([0, 1, 1]), np.array([0, 0, 1]), 2)
    with pytest.raises(NotPositiveDefinite, match="remesh it, or choose another start") as caught:
        cholesky.factorize(np.array(values))
    assert isinstance(caught.value, ParametrizationError)
