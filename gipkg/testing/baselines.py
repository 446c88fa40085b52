"""The conformance suite of baselines."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Baseline
from gipkg.descriptors.operators import Operators
from gipkg.testing import meshes
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite, require

SUITE = Suite(floor=11)
add_common_checks(SUITE)

SAME = 1e-5
"""Allowed L2 change beside the L2 norm where only the order of vertices changes."""
ALIKE = 0.1
"""Allowed L2 change under a motion or scaling, beside the distance to another shape.

A representation that passes through a grid of voxels may change a little when turned."""


@SUITE.check()
def returns_a_vector(plugin: Baseline) -> None:
    """Shape (D,), float64, finite, and of the same length for every mesh."""
    lengths = set()
    for mesh in (meshes.ellipsoid(), meshes.limbed(), meshes.sphere(2)):
        vector = _represent(plugin, mesh)
        require(isinstance(vector, np.ndarray), f"not an array but {type(vector)}")
        require(vector.ndim == 1 and vector.size > 0, f"the shape is {vector.shape}, not (D,)")
        require(vector.dtype == np.float64, f"the type is {vector.dtype}")
        require(np.isfinite(vector).all(), "values are not finite")
        lengths.add(len(vector))
    require(len(lengths) == 1, f"the length depends on the mesh: {sorted(lengths)}")


@SUITE.check()
def leaves_the_mesh_alone(plugin: Baseline) -> None:
    """A mesh whose arrays are read-only is no obstacle, and is the same afterwards."""
    mesh = meshes.read_only(meshes.limbed())
    before = mesh.vertices.tobytes(), mesh.faces.tobytes()
    _represent(plugin, mesh)
    require((mesh.vertices.tobytes(), mesh.faces.tobytes()) == before, "the mesh was changed")


@SUITE.check()
def repeats_itself(plugin: Baseline) -> None:
    """The same mesh gives the same vector, bit by bit."""
    first, second = (_represent(plugin, meshes.limbed()) for _ in range(2))
    require(first.tobytes() == second.tobytes(), "two runs on the same mesh differ")


@SUITE.check()
def does_not_depend_on_the_order_of_vertices(plugin: Baseline) -> None:
    """A permuted mesh is the same shape."""
    mesh = meshes.limbed()
    changed, _ = meshes.permuted(mesh, np.random.default_rng(1))
    expected = _represent(plugin, mesh)
    change = np.linalg.norm(_represent(plugin, changed) - expected)
    require(change <= SAME * np.linalg.norm(expected), f"the vector changes by {change:.2g} in L2")


@SUITE.check()
def tells_shapes_apart(plugin: Baseline) -> None:
    """An ellipsoid and a limbed body have different vectors."""
    require(_distance_between_shapes(plugin) > 0, "an ellipsoid and a limbed body are the same")


@SUITE.check(when=lambda plugin: plugin.tags.rigid_invariant)
def does_not_depend_on_position(plugin: Baseline) -> None:
    """A turned and shifted mesh is the same shape."""
    _require_alike(plugin, meshes.moved(meshes.limbed(), np.random.default_rng(2)))


@SUITE.check(when=lambda plugin: plugin.tags.scale_invariant)
def does_not_depend_on_scale(plugin: Baseline) -> None:
    """Lengths in other units make no difference."""
    for factor in (1e-3, 1e3):
        _require_alike(plugin, meshes.scaled(meshes.limbed(), factor))


def _represent(plugin: Baseline, mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    return plugin.represent(mesh, Operators(mesh))


def _distance_between_shapes(plugin: Baseline) -> float:
    shapes = (meshes.limbed(), meshes.ellipsoid())
    return float(np.linalg.norm(np.subtract(*(_represent(plugin, mesh) for mesh in shapes))))


def _require_alike(plugin: Baseline, changed: trimesh.Trimesh) -> None:
    change = np.linalg.norm(_represent(plugin, changed) - _represent(plugin, meshes.limbed()))
    distance = _distance_between_shapes(plugin)
    require(
        change <= ALIKE * distance,
        f"the vector changes by {change:.2g}; to another shape it is {distance:.2g}",
    )
