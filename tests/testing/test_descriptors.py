"""The suite of descriptors accepts a right one and has a wrong one for every check."""

from __future__ import annotations

import re
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from gipkg.api import Descriptor, DescriptorTags
from gipkg.plugin_refs import PluginRef, load
from gipkg.testing import descriptors as suite
from gipkg.testing import meshes, parametrize_with_checks, run_checks


class Height(Descriptor):
    summary: ClassVar[str] = "the height"
    citation: ClassVar[str] = "none"

    def channels(self):
        return ("height",)

    def describe(self, mesh, operators):
        return np.array(mesh.vertices[:, 2:])


@parametrize_with_checks([Height()])
def test_a_right_plugin_passes(check) -> None:
    check()


class Misnamed(Height):
    def channels(self):
        return ("height", "width")


class Mutating(Height):
    def describe(self, mesh, operators):
        mesh.vertices += 1.0
        return super().describe(mesh, operators)


class NanHeight(Height):
    def describe(self, mesh, operators):
        return super().describe(mesh, operators) / 0.0


class Spoiling(Height):
    def describe(self, mesh, operators):
        operators.mass[:] *= 2
        return operators.mass[:, None].copy()


class Indexed(Height):
    def describe(self, mesh, operators):
        return np.arange(float(len(mesh.vertices)))[:, None]


class DicingHeight(Height):
    def describe(self, mesh, operators):
        return super().describe(mesh, operators) + np.random.default_rng().normal()


class BoastingHeight(Height):
    tags: ClassVar[DescriptorTags] = DescriptorTags(True, True, True)


WRONG = {
    Misnamed: {"returns-an-array-of-channels"},
    Mutating: {"leaves-the-mesh-alone"},
    NanHeight: {"returns-an-array-of-channels"},
    Spoiling: {"leaves-the-operators-alone"},
    Indexed: {"follows-the-order-of-vertices"},
    DicingHeight: {"repeats-itself"},
    BoastingHeight: {
        "does-not-depend-on-position",
        "does-not-depend-on-scale",
        "is-constant-on-a-sphere",
        "does-not-see-an-isometry",
    },
}


@pytest.mark.parametrize("plugin", WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert WRONG[plugin] <= failed_checks(plugin())


def test_every_check_of_this_kind_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == set(suite.SUITE.checks) - common_checks


def test_the_isometric_pair_has_equal_edges_and_different_positions() -> None:
    first, second = meshes.isometric_pair()
    np.testing.assert_allclose(first.edges_unique_length, second.edges_unique_length, rtol=1e-12)
    assert first.is_watertight
    assert first.euler_number == 2
    assert abs(first.volume - second.volume) > 0.05 * abs(first.volume)


def test_the_worked_example_for_contributors_conforms(tmp_path: Path) -> None:
    text = (Path(__file__).resolve().parents[2] / "CONTRIBUTING.md").read_text()
    (code,) = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    file = tmp_path / "curvature.py"
    file.write_text(code)
    ref = PluginRef("descriptor", "curvature", f"{file}:GaussianCurvature", None, None, "local")
    report = run_checks(load(ref)())
    assert report.fault is None
    assert report.run == 15
