"""The suites accept what is right and name what is wrong: a wrong plugin for every check."""

from __future__ import annotations

import re
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from pydantic import ConfigDict, Field

from gipkg.api import (
    Baseline,
    BaselineTags,
    Dataset,
    DatasetTags,
    Descriptor,
    DescriptorTags,
    Parametrizer,
    ParametrizerTags,
    Protocol,
    Shape,
)
from gipkg.errors import DatasetNotFound, UnsupportedMesh
from gipkg.plugin_refs import PluginRef, load
from gipkg.surfaces.validation import check_genus_zero
from gipkg.testing import meshes, parametrize_with_checks, require, run_checks, suite_of
from gipkg.testing.suite import Suite, run_suite


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


class Radial(Parametrizer):
    summary: ClassVar[str] = "radial projection"
    citation: ClassVar[str] = "none"
    shift: float = Field(0.0, ge=0, lt=1, description="of the centre")

    def parametrize(self, mesh):
        check_genus_zero(mesh)
        return unit(np.asarray(mesh.vertices) - mesh.vertices.mean(0) - self.shift * mesh.scale)


class Height(Descriptor):
    summary: ClassVar[str] = "the height"
    citation: ClassVar[str] = "none"

    def channels(self):
        return ("height",)

    def describe(self, mesh, operators):
        return np.array(mesh.vertices[:, 2:])


class Extents(Baseline):
    summary: ClassVar[str] = "the sides of the bounding box"
    citation: ClassVar[str] = "none"

    def represent(self, mesh, operators):
        return np.ptp(mesh.vertices, axis=0)


class Balls(Dataset):
    summary: ClassVar[str] = "balls and eggs"
    citation: ClassVar[str] = "none"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=8, classes=2, licence="CC0-1.0", source="generated"
    )
    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol(2)}

    def available(self, root):
        return True

    def fetch(self, root):
        pass

    def shapes(self, root):
        return tuple(Shape(f"{name}{i}", name) for name in ("ball", "egg") for i in range(4))

    def load(self, root, shape_id):
        if shape_id not in {shape.id for shape in self.shapes(root)}:
            raise DatasetNotFound(f"there is no {shape_id}")
        size = 1.0 + int(shape_id[-1])
        return meshes.ellipsoid((size, size, size if "ball" in shape_id else 2 * size))


GOOD = [Radial(), Radial(shift=0.01), Height(), Extents(), Balls()]


@parametrize_with_checks(GOOD)
def test_a_right_plugin_passes(check) -> None:
    check()


# Wrong parametrizers


class NotUnit(Radial):
    def parametrize(self, mesh):
        return 1.001 * super().parametrize(mesh)


class Single(Radial):
    def parametrize(self, mesh):
        return super().parametrize(mesh).astype(np.float32)


class Mutating(Radial):
    def parametrize(self, mesh):
        mesh.vertices -= mesh.vertices.mean(axis=0)
        return super().parametrize(mesh)


class Dicing(Radial):
    def parametrize(self, mesh):
        noise = np.random.default_rng().normal(scale=1e-9, size=mesh.vertices.shape)
        return unit(super().parametrize(mesh) + noise)


class Boasting(Radial):
    """Promises everything; from a centre outside the body most of it is untrue."""

    tags: ClassVar[ParametrizerTags] = ParametrizerTags(
        guarantees=frozenset({"bijective", "area", "angle"})
    )

    def parametrize(self, mesh):
        check_genus_zero(mesh)
        return unit(mesh.vertices - np.array([0.0, 0.0, 0.9 * np.max(mesh.vertices[:, 2])]))


class Mirroring(Radial):
    def parametrize(self, mesh):
        return -super().parametrize(mesh)


class Ordered(Radial):
    """Treats the first hundred vertices differently."""

    def parametrize(self, mesh):
        sphere = super().parametrize(mesh)
        sphere[: len(sphere) // 2, 2] *= 0.2
        return unit(sphere)


class Placed(Radial):
    def parametrize(self, mesh):
        check_genus_zero(mesh)
        return unit(np.asarray(mesh.vertices))


class Sized(Radial):
    def parametrize(self, mesh):
        sphere = super().parametrize(mesh)
        return unit(sphere * [1, 1, np.clip(mesh.scale, 0.05, 20)])


class Unrefusing(Radial):
    def parametrize(self, mesh):
        return unit(np.asarray(mesh.vertices) - mesh.vertices.mean(axis=0))


class Mumbling(Radial):
    def parametrize(self, mesh):
        try:
            return super().parametrize(mesh)
        except UnsupportedMesh:
            raise UnsupportedMesh("it does not work") from None


# Wrong in what all kinds share


class Silent(Height):
    citation: ClassVar[str] = " "


class Lenient(Height):
    model_config = ConfigDict(extra="ignore")


class Thawed(Height):
    model_config = ConfigDict(frozen=False)
    factor: float = Field(1.0, description="a factor")


class Unbounded(Height):
    factor: int = Field(1, description="a factor", json_schema_extra={"minimum": 0})


class Unjson(Height):
    limits: float = Field(float("inf"), description="JSON has no infinity")


class Local(Height):
    @cached_property
    def held(self):
        return lambda: None

    def __getstate__(self):
        raise TypeError("it holds a lambda")


# Wrong descriptors


class Misnamed(Height):
    def channels(self):
        return ("height", "width")


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


# Wrong baselines


class Growing(Extents):
    def represent(self, mesh, operators):
        return np.asarray(mesh.vertices[:, 0])


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


# Wrong datasets


class Unsorted(Balls):
    def shapes(self, root):
        return super().shapes(root)[::-1]


class Miscounted(Balls):
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=9, classes=2, licence="CC0-1.0", source="generated"
    )


class Unlicensed(Balls):
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=8, classes=2, licence="", source="generated"
    )


class Unfiled(Balls):
    """Claims to be real, yet names no files and is there without any."""

    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False, shapes=8, classes=2, licence="CC0-1.0", source="somewhere"
    )


class Unsplittable(Balls):
    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol(4)}


class Absent(Balls):
    def available(self, root):
        return False


class Littering(Balls):
    def fetch(self, root):
        (root / "litter").touch()


class DicingBalls(Balls):
    def load(self, root, shape_id):
        return meshes.scaled(super().load(root, shape_id), np.random.default_rng().uniform())


class Repeating(Balls):
    def load(self, root, shape_id):
        return super().load(root, "ball0" if shape_id.startswith("ball") else shape_id)


class Inventing(Balls):
    def load(self, root, shape_id):
        return meshes.sphere(1)


WRONG = {
    NotUnit: {"returns-an-array-of-unit-vectors"},
    Single: {"returns-an-array-of-unit-vectors"},
    Mutating: {"leaves-the-mesh-alone"},
    Dicing: {"repeats-itself"},
    Boasting: {"keeps-every-face-unflipped", "keeps-areas", "keeps-angles"},
    Mirroring: {"covers-the-sphere-once"},
    Ordered: {"does-not-depend-on-the-order-of-vertices"},
    Placed: {"does-not-depend-on-position"},
    Sized: {"does-not-depend-on-scale"},
    Unrefusing: {
        "refuses-a-torus",
        "refuses-an-open-surface",
        "refuses-two-components",
        "refuses-a-turned-face",
        "refuses-what-is-not-finite",
    },
    Mumbling: {"refuses-a-torus", "refuses-an-open-surface", "refuses-two-components"},
    Silent: {"metadata-is-complete"},
    Lenient: {"refuses-unknown-parameters"},
    Thawed: {"cannot-be-changed"},
    Unbounded: {"enforces-bounds"},
    Unjson: {"parameters-survive-json"},
    Local: {"survives-pickling"},
    Misnamed: {"returns-an-array-of-channels"},
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
    Growing: {"returns-a-vector"},
    Blind: {"tells-shapes-apart"},
    FirstVertex: {"does-not-depend-on-the-order-of-vertices"},
    DicingExtents: {"repeats-itself"},
    BoastingExtents: {"does-not-depend-on-position", "does-not-depend-on-scale"},
    Unsorted: {"lists-shapes-in-one-order"},
    Miscounted: {"counts-what-its-tags-say"},
    Unlicensed: {"tags-are-complete"},
    Unfiled: {"tags-are-complete", "is-absent-from-an-empty-folder"},
    Unsplittable: {"names-its-protocols", "splits-by-its-protocols"},
    Absent: {"is-available-anywhere"},
    Littering: {"is-available-anywhere"},
    DicingBalls: {"loads-the-same-mesh-twice"},
    Repeating: {"holds-different-shapes"},
    Inventing: {"refuses-an-unknown-shape"},
}


@pytest.mark.parametrize(
    ("plugin", "checks"), WRONG.items(), ids=lambda x: getattr(x, "__name__", "")
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, checks: set[str]) -> None:
    report = run_checks(plugin())
    failed = {outcome.name for outcome in report.outcomes if outcome.status == "failed"}
    assert checks <= failed
    assert report.fault is not None


def test_every_check_of_every_suite_has_a_wrong_plugin() -> None:
    names = {name for plugin in GOOD for name in suite_of(plugin).checks}
    covered = set().union(*WRONG.values())
    assert names == covered


def test_a_small_ellipsoid_maps_conformally_as_well_as_flat_triangles_allow() -> None:
    """The exact conformal map of the spheroid 1:1:2 is what the bound on angles is made for."""
    from gipkg.testing import parametrizers

    mesh = meshes.ellipsoid((1.0, 1.0, 2.0), subdivisions=4)
    x, y, z = mesh.vertices.T
    angle = np.arctan2(np.hypot(x, y), z / 2)
    grid = np.linspace(0, np.pi, 20_001)[1:-1]
    slope = (np.sqrt(np.cos(grid) ** 2 + 4 * np.sin(grid) ** 2) - 1) / np.sin(grid)
    integral = np.cumsum((slope + np.roll(slope, 1)) / 2 * (grid[1] - grid[0]))
    integral -= np.interp(np.pi / 2, grid, integral)
    with np.errstate(divide="ignore"):
        isometric = np.interp(angle, grid, integral) + np.log(np.tan(angle / 2))
        colatitude = 2 * np.arctan(np.exp(isometric))
    radius = np.sin(colatitude)
    turn = np.arctan2(y, x)
    sphere = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.cos(colatitude)], axis=1)
    ratio = np.average(parametrizers.stretch_ratios(sphere, mesh), weights=mesh.area_faces)
    assert 1.02 < ratio < 1.04 < parametrizers.ANGLE_RATIO


def test_the_isometric_pair_has_equal_edges_and_different_positions() -> None:
    first, second = meshes.isometric_pair()
    np.testing.assert_allclose(first.edges_unique_length, second.edges_unique_length, rtol=1e-12)
    assert first.is_watertight
    assert first.euler_number == 2
    assert abs(first.volume - second.volume) > 0.05 * abs(first.volume)


def test_the_summary_counts_what_ran() -> None:
    report = run_checks(Height(), "height")
    assert report.summary() == "height: 11 run, 11 passed, 0 expected failures, 0 skipped"


def test_an_expected_failure_must_fail() -> None:
    fails = run_checks(Misnamed(), expected_failures={"returns-an-array-of-channels": "on purpose"})
    passes = run_checks(Height(), expected_failures={"repeats-itself": "a guess"})
    assert fails.fault is None
    assert fails.count("expected failure") == 1
    assert "failed: repeats-itself" in str(passes.fault)


def test_an_expected_failure_must_name_a_check() -> None:
    with pytest.raises(ValueError, match="no such check: repeats-itsself"):
        run_checks(Height(), expected_failures={"repeats-itsself": "misspelt"})
    with pytest.raises(ValueError, match="no such check"):
        parametrize_with_checks([Height()], {"covers-the-sphere-once": "of another kind"})


def test_too_few_checks_are_a_fault() -> None:
    suite = Suite(floor=2)
    suite.check()(lambda plugin: require(True, ""))
    report = run_suite(suite, Height(), "height", {}, None)
    assert report.fault == "only 1 checks ran; its kind needs 2"


def test_pytest_parametrization_counts_and_marks_strictly() -> None:
    mark = parametrize_with_checks([Misnamed()], {"returns-an-array-of-channels": "on purpose"})
    name, cases = mark.args
    ids = {case.id: case.marks for case in cases}
    assert name == "check"
    assert len(ids) == len(suite_of(Misnamed()).cases(Misnamed())) + 1
    (xfail,) = ids["Misnamed-returns-an-array-of-channels"]
    assert xfail.kwargs == {"reason": "on purpose", "strict": True}
    assert "Misnamed-enough-checks" in ids


def test_skipped_checks_do_not_count_as_run(tmp_path: Path) -> None:
    report = run_checks(Absent(), data_root=tmp_path)
    assert report.count("skipped") == sum(
        check.needs_data for check in suite_of(Absent()).checks.values()
    )
    assert report.run == len(report.outcomes) - report.count("skipped")


def test_the_worked_example_for_contributors_conforms(tmp_path: Path) -> None:
    text = (Path(__file__).resolve().parents[2] / "CONTRIBUTING.md").read_text()
    (code,) = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    file = tmp_path / "curvature.py"
    file.write_text(code)
    ref = PluginRef("descriptor", "curvature", f"{file}:GaussianCurvature", None, None, "local")
    report = run_checks(load(ref)())
    assert report.fault is None
    assert report.run == 15
