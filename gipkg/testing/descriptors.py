"""The conformance suite of descriptors."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Descriptor
from gipkg.descriptors.operators import Operators
from gipkg.testing import meshes
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite, require

SUITE = Suite(floor=11)
add_common_checks(SUITE)

SAME = 1e-5
"""Allowed change of a value, beside the spread of its channel, where none is expected.

It leaves room for iterative eigensolvers, which stop near 1e-8 and depend on the order."""
ROUND = 0.05
"""Allowed spread on a sphere, beside the spread on a limbed body, for an intrinsic channel."""


@SUITE.check()
def returns_an_array_of_channels(plugin: Descriptor) -> None:
    """Shape (V, C) with a name a channel, float64, finite."""
    names = plugin.channels()
    require(len(set(names)) == len(names) > 0, f"the channels' names are {names}")
    for mesh in (meshes.ellipsoid(), meshes.limbed(), meshes.sphere()):
        values = _describe(plugin, mesh)
        require(isinstance(values, np.ndarray), f"not an array but {type(values)}")
        expected = (len(mesh.vertices), len(names))
        require(values.shape == expected, f"the shape is {values.shape}, not {expected}")
        require(values.dtype == np.float64, f"the type is {values.dtype}")
        require(np.isfinite(values).all(), "values are not finite")


@SUITE.check()
def leaves_the_mesh_alone(plugin: Descriptor) -> None:
    """A mesh whose arrays are read-only is no obstacle, and is the same afterwards."""
    mesh = meshes.read_only(meshes.limbed())
    before = mesh.vertices.tobytes(), mesh.faces.tobytes()
    _describe(plugin, mesh)
    require((mesh.vertices.tobytes(), mesh.faces.tobytes()) == before, "the mesh was changed")


@SUITE.check()
def leaves_the_operators_alone(plugin: Descriptor) -> None:
    """Operators are shared: a second description from the same ones is the same."""
    mesh = meshes.limbed()
    operators = Operators(mesh)
    first, second = (plugin.describe(mesh, operators) for _ in range(2))
    require(first.tobytes() == second.tobytes(), "two runs on the same operators differ")


@SUITE.check()
def repeats_itself(plugin: Descriptor) -> None:
    """The same mesh gives the same channels, bit by bit."""
    first, second = (_describe(plugin, meshes.limbed()) for _ in range(2))
    require(first.tobytes() == second.tobytes(), "two runs on the same mesh differ")


@SUITE.check()
def follows_the_order_of_vertices(plugin: Descriptor) -> None:
    """A permuted mesh gives the permuted channels."""
    mesh = meshes.limbed()
    changed, order = meshes.permuted(mesh, np.random.default_rng(1))
    _require_same(_describe(plugin, changed), _describe(plugin, mesh)[order])


@SUITE.check(when=lambda plugin: plugin.tags.rigid_invariant)
def does_not_depend_on_position(plugin: Descriptor) -> None:
    """A turned and shifted mesh gives the same channels."""
    mesh = meshes.limbed()
    changed = meshes.moved(mesh, np.random.default_rng(2))
    _require_same(_describe(plugin, changed), _describe(plugin, mesh))


@SUITE.check(when=lambda plugin: plugin.tags.scale_invariant)
def does_not_depend_on_scale(plugin: Descriptor) -> None:
    """Lengths in other units make no difference."""
    mesh = meshes.limbed()
    for factor in (1e-3, 1e3):
        _require_same(_describe(plugin, meshes.scaled(mesh, factor)), _describe(plugin, mesh))


@SUITE.check(when=lambda plugin: plugin.tags.intrinsic)
def is_constant_on_a_sphere(plugin: Descriptor) -> None:
    """All points of a sphere are alike, up to the mesh, which is finer here for that reason."""
    spread = np.ptp(_describe(plugin, meshes.sphere(4)), axis=0)
    elsewhere = np.ptp(_describe(plugin, meshes.limbed()), axis=0)
    require(
        (spread <= ROUND * elsewhere).all(),
        f"it spreads by {spread} on a sphere and by {elsewhere} on a limbed body",
    )


@SUITE.check(when=lambda plugin: plugin.tags.intrinsic)
def does_not_see_an_isometry(plugin: Descriptor) -> None:
    """A cap pushed in, with all edge lengths kept, makes no difference."""
    bulged, dented = meshes.isometric_pair()
    _require_same(_describe(plugin, dented), _describe(plugin, bulged))


def _describe(plugin: Descriptor, mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    return plugin.describe(mesh, Operators(mesh))


def _require_same(values: NDArray[np.float64], expected: NDArray[np.float64]) -> None:
    allowed = SAME * np.maximum(np.ptp(expected, axis=0), np.abs(expected).max(axis=0) * 1e-3)
    change = np.abs(values - expected).max(axis=0)
    require((change <= allowed).all(), f"the channels change by {change}, and {allowed} is allowed")
