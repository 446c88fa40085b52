"""The suite of baselines accepts a right one and has a wrong one for every check."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest

from gipkg.api import BaselineTags
from gipkg.baselines.vectors import VectorBaseline
from gipkg.testing import baselines as suite
from gipkg.testing import parametrize_with_checks


class Extents(VectorBaseline):
    summary: ClassVar[str] = "the sides of the bounding box"
    citation: ClassVar[str] = "none"

    def represent(self, mesh, operators):
        return np.ptp(mesh.vertices, axis=0)


@parametrize_with_checks([Extents()])
def test_a_right_plugin_passes(check) -> None:
    check()


class Ragged(Extents):
    def represent(self, mesh, operators):
        return np.asarray(mesh.vertices.T)


class Growing(Extents):
    def represent(self, mesh, operators):
        return np.asarray(mesh.vertices[:, 0])


class Mutating(Extents):
    def represent(self, mesh, operators):
        mesh.vertices += 1.0
        return super().represent(mesh, operators)


class Blind(Extents):
    def represent(self, mesh, operators):
        return np.ones(3)


class FirstVertex(Extents):
    def represent(self, mesh, operators):
        return np.array(mesh.vertices[0])


class DicingExtents(Extents):
    def represent(self, mesh, operators):
        return super().represent(mesh, operators) + np.random.default_rng().normal()


class Misspelling(Extents):
    def predict(self, representations, train, test, **options):
        prediction = super().predict(representations, train, test, **options)
        return replace(prediction, classes=tuple(map(str.upper, prediction.classes)))


class Peeping(Extents):
    """Scales every shape by the mean of the test part."""

    def predict(self, representations, train, test, **options):
        unit = np.mean([representations[i] for i in test])
        scaled = {i: array / unit for i, array in representations.items()}
        return super().predict(scaled, train, test, **options)


class Comparing(Extents):
    """Compares shapes by how many others lie between them."""

    def predict(self, representations, train, test, **options):
        prediction = super().predict(representations, train, test, **options)
        ranks = prediction.pairwise_distances().argsort(axis=1).argsort(axis=1)
        return replace(prediction, distances=ranks.astype(np.float32))


class BoastingExtents(Extents):
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)


WRONG = {
    Ragged: {"returns-an-array"},
    Growing: {"returns-a-vector"},
    Mutating: {"leaves-the-mesh-alone"},
    Blind: {"tells-shapes-apart"},
    FirstVertex: {"does-not-depend-on-the-order-of-vertices"},
    DicingExtents: {"repeats-itself", "the-test-part-chooses-nothing"},
    Misspelling: {"predicts-every-shape-asked-for"},
    Peeping: {"the-test-part-chooses-nothing"},
    Comparing: {"the-test-part-chooses-nothing"},
    BoastingExtents: {"does-not-depend-on-position", "does-not-depend-on-scale"},
}


@pytest.mark.parametrize("plugin", WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert WRONG[plugin] <= failed_checks(plugin())


def test_every_check_of_this_kind_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == set(suite.SUITE.checks) - common_checks
