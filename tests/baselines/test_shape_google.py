from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
import trimesh
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.baselines.shape_google import SCALES, ShapeGoogle
from gipkg.baselines.vocabulary import Vocabulary, learn_vocabulary
from gipkg.descriptors.operators import Operators
from gipkg.testing import meshes

BAGS = ShapeGoogle(words=5, modes=8)


def points(label: int, number: int, vertices: int = 60) -> np.ndarray:
    """A representation whose points have signatures around two of six places."""
    rng = np.random.default_rng([label, number])
    share = rng.dirichlet(np.full(vertices, 3.0))
    places = np.eye(SCALES)[rng.choice([label, label + 1], vertices)]
    factors = rng.standard_normal((vertices, BAGS.modes))
    factors[:, 0] = 1.0  # The constant mode; the others have mean 0.
    factors[:, 1:] -= share @ factors[:, 1:]
    signatures = places + 0.05 * rng.standard_normal((vertices, SCALES))
    return np.column_stack([share, signatures, factors]).astype(np.float32)


SHAPES = {f"{label}-{n}": points(label, n, 50 + n) for label in (0, 2, 4) for n in range(8)}
TRAIN = {i: i[0] for i in SHAPES if int(i[2:]) < 4}
TEST = tuple(i for i in SHAPES if i not in TRAIN)


@pytest.mark.parametrize("spatially_sensitive", [True, False])
def test_classes_that_say_different_words_are_told_apart(spatially_sensitive: bool) -> None:
    baseline = BAGS.model_copy(update={"spatially_sensitive": spatially_sensitive})
    found = baseline.predict(SHAPES, TRAIN, TEST)
    assert [found.classes[k] for k in found.scores.argmax(axis=1)] == [i[0] for i in TEST]
    assert found.embeddings.shape == (len(TEST), 25 if spatially_sensitive else 5)


def test_a_bag_and_a_bag_of_pairs_have_the_mean_one() -> None:
    """No heat is lost: the integral of K_t over both points is the area, which is 1."""
    for spatially_sensitive in (True, False):
        baseline = BAGS.model_copy(update={"spatially_sensitive": spatially_sensitive})
        bags = baseline.predict(SHAPES, TRAIN, TEST).embeddings
        assert_allclose(bags.sum(axis=1), 1, rtol=1e-5)


def test_the_vocabulary_does_not_see_the_test_part() -> None:
    expected = BAGS.predict(SHAPES, TRAIN, TEST)
    strange = {**SHAPES, TEST[-1]: SHAPES[TEST[-1]] * 100}
    changed = BAGS.predict(strange, TRAIN, TEST)
    assert_array_equal(changed.embeddings[:-1], expected.embeddings[:-1])
    assert_array_equal(changed.scores[:-1], expected.scores[:-1])
    fewer = BAGS.predict(SHAPES, TRAIN, TEST[:3])
    assert_array_equal(fewer.embeddings, expected.embeddings[:3])


def test_another_seed_learns_another_vocabulary() -> None:
    one, same, other = (BAGS.predict(SHAPES, TRAIN, TEST, seed=s).embeddings for s in (0, 0, 1))
    assert_array_equal(one, same)
    assert (one != other).any()


def test_the_factors_are_those_of_the_heat_kernel() -> None:
    """Second route: exp(-t M⁻¹ L) M⁻¹ by scaling and squaring, without eigenpairs."""
    mesh = meshes.ellipsoid((1.0, 1.3, 1.7), subdivisions=2)
    operators = Operators(mesh, eigenpairs=161)
    baseline = ShapeGoogle(modes=161, time=0.02)
    columns = baseline.represent(mesh, operators).astype(float)
    factors = columns[:, 1 + SCALES :]
    area = operators.mass.sum()
    generator = operators.laplacian.toarray() / operators.mass[:, None]
    kernel = area * scipy.linalg.expm(-0.02 * area * generator) / operators.mass
    assert_allclose(factors @ factors.T, kernel, rtol=1e-4, atol=1e-4)
    assert_allclose(columns[:, 0], operators.mass / area, rtol=1e-6)


@pytest.mark.parametrize("signature", ["hks", "si-hks"])
def test_a_surface_bent_without_stretching_keeps_its_bag(signature: str) -> None:
    bulged, dented = meshes.isometric_pair()
    shapes = {"bulged": bulged, "dented": dented}
    shapes |= {"sphere": meshes.sphere(), "limbed": meshes.limbed()}
    baseline = ShapeGoogle(signature=signature, words=12)
    rows = {i: baseline.represent(mesh, Operators(mesh)) for i, mesh in shapes.items()}
    train = {"sphere": "a", "limbed": "b"}
    distances = baseline.predict(rows, train, tuple(shapes)).pairwise_distances()
    assert distances[0, 1] < 1e-4 * distances[0, 3]


def test_a_mesh_with_fewer_modes_fills_up_with_nothing() -> None:
    mesh = trimesh.creation.icosphere(1)
    columns = ShapeGoogle(modes=60).represent(mesh, Operators(mesh))
    assert columns.shape == (42, 1 + SCALES + 60)
    assert not columns[:, 1 + SCALES + 41 :].any()


def test_assignment_is_soft_and_takes_the_nearest_word_from_far_away() -> None:
    words = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]])
    vocabulary = Vocabulary(np.zeros(2), np.ones(2), words, sigma=0.5)
    assigned = vocabulary.assign(np.array([[0.5, 0.0], [0.0, 0.0], [1e6, 0.0]]))
    assert_allclose(assigned.sum(axis=1), 1)
    assert assigned[0, 0] == pytest.approx(assigned[0, 1])
    assert assigned[1, 1] / assigned[1, 0] == pytest.approx(np.exp(-1 / (2 * 0.5**2)))
    assert_allclose(assigned[2], [0, 1, 0], atol=1e-12)


def test_words_stand_where_points_are_whatever_the_units() -> None:
    rng = np.random.default_rng(0)
    places = np.array([[0.0, 0.0], [1.0, 5.0], [2.0, 0.0]])
    units = np.array([1e-3, 1e4])
    rows = {
        str(n): np.column_stack(
            [
                np.full(90, 1 / 90),
                (np.repeat(places, 30, axis=0) + 0.01 * rng.standard_normal((90, 2))) * units,
            ]
        )
        for n in range(4)
    }
    vocabulary = learn_vocabulary(rows, words=3, softness=2.0, seed=0)
    found = (vocabulary.words * vocabulary.deviation + vocabulary.mean) / units
    assert_allclose(found[found[:, 0].argsort()], places, atol=0.01)
    assert 0 < vocabulary.sigma < 0.1
