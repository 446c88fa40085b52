"""The suite of baselines accepts a right one and has a wrong one for every check."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest

from gipkg.api import Baseline, BaselineTags
from gipkg.testing import baselines as suite
from gipkg.testing import parametrize_with_checks


class Extents(Baseline):
    summary: ClassVar[str] = "the sides of the bounding box"
    citation: ClassVar[str] = "none"

    def represent(self, mesh, operators):
        return np.ptp(mesh.vertices, axis=0)


@parametrize_with_checks([Extents()])
def test_a_right_plugin_passes(check) -> None:
    check()


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


class BoastingExtents(Extents):
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)


WRONG = {
    Growing: {"returns-a-vector"},
    Mutating: {"leaves-the-mesh-alone"},
    Blind: {"tells-shapes-apart"},
    FirstVertex: {"does-not-depend-on-the-order-of-vertices"},
    DicingExtents: {"repeats-itself"},
    BoastingExtents: {"does-not-depend-on-position", "does-not-depend-on-scale"},
}


@pytest.mark.parametrize("plugin", WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert WRONG[plugin] <= failed_checks(plugin())


def test_every_check_of_this_kind_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == set(suite.SUITE.checks) - common_checks
