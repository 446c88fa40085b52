"""The suite of parametrizers accepts a right one and has a wrong one for every check."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from pydantic import Field

from gipkg.api import Parametrizer, ParametrizerTags
from gipkg.errors import UnsupportedMesh
from gipkg.surfaces.validation import check_genus_zero
from gipkg.testing import meshes, parametrize_with_checks
from gipkg.testing import parametrizers as suite


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


class Radial(Parametrizer):
    summary: ClassVar[str] = "radial projection"
    citation: ClassVar[str] = "none"
    shift: float = Field(0.0, ge=0, lt=1, description="of the centre")

    def parametrize(self, mesh):
        check_genus_zero(mesh)
        return unit(np.asarray(mesh.vertices) - mesh.vertices.mean(0) - self.shift * mesh.scale)


@parametrize_with_checks([Radial(), Radial(shift=0.01)])
def test_a_right_plugin_passes(check) -> None:
    check()


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


class Silent(Radial):
    tags: ClassVar[ParametrizerTags] = ParametrizerTags(iterative=True)

    def parametrize(self, mesh, callback=None):
        return super().parametrize(mesh)


WRONG = {
    Silent: {"tells-its-iterations"},
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
}


@pytest.mark.parametrize("plugin", WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert WRONG[plugin] <= failed_checks(plugin())


def test_every_check_of_this_kind_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == set(suite.SUITE.checks) - common_checks


def test_a_small_ellipsoid_maps_conformally_as_well_as_flat_triangles_allow() -> None:
    """The exact conformal map of the spheroid 1:1:2 is what the bound on angles is made for."""
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
    ratio = np.average(suite.stretch_ratios(sphere, mesh), weights=mesh.area_faces)
    assert 1.02 < ratio < 1.04 < suite.ANGLE_RATIO
