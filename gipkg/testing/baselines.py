"""The conformance suite of baselines."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Baseline
from gipkg.baselines.vectors import VectorBaseline
from gipkg.descriptors.operators import Operators
from gipkg.learning.prediction import Prediction
from gipkg.testing import meshes
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite, require

SUITE = Suite(floor=13)
add_common_checks(SUITE)

SAME = 1e-3
"""Allowed distance, beside that to another shape, where only the order of vertices changes."""
ALIKE = 0.1
"""Allowed distance under a motion or scaling, beside that to another shape.

A representation that passes through a grid of voxels may change a little when turned."""

_TRAIN = {"bent": "limbed", "broad": "limbed", "round": "compact", "oval": "compact"}
_TEST = ("limbed", "permuted", "moved", "small", "large", "ellipsoid")


def _shapes() -> dict[str, trimesh.Trimesh]:
    """Return a training part of two classes, and a test part of one limbed body in many forms."""
    limbed = meshes.limbed()
    x, y, z = limbed.vertices.T
    return {
        "bent": meshes.mesh_of(np.stack([x, y + 0.2 * x * x, z], axis=1), limbed.faces),
        "broad": meshes.mesh_of(limbed.vertices * [1.2, 1.0, 0.9], limbed.faces),
        "round": meshes.sphere(),
        "oval": meshes.ellipsoid((1.0, 1.2, 1.5)),
        "limbed": limbed,
        "permuted": meshes.permuted(limbed, np.random.default_rng(1))[0],
        "moved": meshes.moved(limbed, np.random.default_rng(2)),
        "small": meshes.scaled(limbed, 1e-3),
        "large": meshes.scaled(limbed, 1e3),
        "ellipsoid": meshes.ellipsoid(),
    }


@SUITE.check()
def returns_an_array(plugin: Baseline) -> None:
    """Finite numbers, of one type and, but for the number of rows, of one shape."""
    kinds = set()
    for mesh in (meshes.ellipsoid(), meshes.limbed(), meshes.sphere(2)):
        array = _represent(plugin, mesh)
        require(isinstance(array, np.ndarray), f"not an array but {type(array)}")
        require(array.ndim > 0 and array.size > 0, f"the shape is {array.shape}")
        require(array.dtype.kind in "biuf", f"the type is {array.dtype}")
        require(np.isfinite(array).all(), "values are not finite")
        kinds.add((array.dtype.name, array.shape[1:]))
    require(len(kinds) == 1, f"type and shape of a row depend on the mesh: {sorted(kinds)}")


@SUITE.check(when=lambda plugin: isinstance(plugin, VectorBaseline))
def returns_a_vector(plugin: Baseline) -> None:
    """Shape (D,), float64, of the same length for every mesh."""
    vectors = [_represent(plugin, mesh) for mesh in (meshes.limbed(), meshes.sphere(2))]
    shapes = sorted({vector.shape for vector in vectors})
    require(len(shapes) == len(shapes[0]) == 1, f"the shapes are {shapes}, not (D,)")
    require(vectors[0].dtype == np.float64, f"the type is {vectors[0].dtype}")


@SUITE.check()
def leaves_the_mesh_alone(plugin: Baseline) -> None:
    """A mesh whose arrays are read-only is no obstacle, and is the same afterwards."""
    mesh = meshes.read_only(meshes.limbed())
    before = mesh.vertices.tobytes(), mesh.faces.tobytes()
    _represent(plugin, mesh)
    require((mesh.vertices.tobytes(), mesh.faces.tobytes()) == before, "the mesh was changed")


@SUITE.check()
def repeats_itself(plugin: Baseline) -> None:
    """The same mesh gives the same representation, bit by bit."""
    first, second = (_represent(plugin, meshes.limbed()) for _ in range(2))
    require(first.tobytes() == second.tobytes(), "two runs on the same mesh differ")


@SUITE.check()
def predicts_every_shape_asked_for(plugin: Baseline) -> None:
    """Scores for the classes of the training part, sorted, and usable distances."""
    prediction = _prediction(plugin)
    require(prediction.ids == _TEST, f"the shapes are {prediction.ids}, not {_TEST}")
    classes = tuple(sorted(set(_TRAIN.values())))
    require(prediction.classes == classes, f"the classes are {prediction.classes}, not {classes}")
    fields = {"scores": prediction.scores, "embeddings": prediction.embeddings}
    if prediction.distances is not None:
        fields["distances"] = prediction.distances
    for name, array in fields.items():
        require(array.dtype == np.float32, f"the type of the {name} is {array.dtype}")
        require(np.isfinite(array).all(), f"{name} are not finite")
    require((prediction.pairwise_distances() >= 0).all(), "a distance is negative")


@SUITE.check()
def the_test_part_chooses_nothing(plugin: Baseline) -> None:
    """Another test shape beside them changes no bit of what is said of the others.

    This holds two trainings against each other, so that it also finds one that is random.
    """
    changed = _predict(plugin, instead={"ellipsoid": "round"})
    expected = _prediction(plugin)
    for name in ("scores", "embeddings"):
        same = np.array_equal(getattr(changed, name)[:-1], getattr(expected, name)[:-1])
        require(same, f"{name} of a test shape depend on another one, or on chance")
    before, after = (one.pairwise_distances()[:-1, :-1] for one in (expected, changed))
    require(np.array_equal(before, after), "a distance depends on a third shape, or on chance")


@SUITE.check()
def does_not_depend_on_the_order_of_vertices(plugin: Baseline) -> None:
    """A permuted mesh is the same shape."""
    _require_near(plugin, "permuted", SAME)


@SUITE.check()
def tells_shapes_apart(plugin: Baseline) -> None:
    """An ellipsoid and a limbed body are at a distance."""
    require(_distance(plugin, "ellipsoid") > 0, "an ellipsoid and a limbed body are the same")


@SUITE.check(when=lambda plugin: plugin.tags.rigid_invariant)
def does_not_depend_on_position(plugin: Baseline) -> None:
    """A turned and shifted mesh is the same shape."""
    _require_near(plugin, "moved", ALIKE)


@SUITE.check(when=lambda plugin: plugin.tags.scale_invariant)
def does_not_depend_on_scale(plugin: Baseline) -> None:
    """Lengths in other units make no difference."""
    for shape in ("small", "large"):
        _require_near(plugin, shape, ALIKE)


def _represent(plugin: Baseline, mesh: trimesh.Trimesh) -> NDArray[np.generic]:
    return plugin.represent(mesh, Operators(mesh))


def _prediction(plugin: Baseline) -> Prediction:
    """Return the prediction of the suite's shapes, from one training for all checks."""
    return _trained(type(plugin), plugin.model_dump_json())


@lru_cache(maxsize=1)
def _trained(kind: type[Baseline], parameters: str) -> Prediction:
    return _predict(kind.model_validate_json(parameters))


def _predict(plugin: Baseline, instead: dict[str, str] | None = None) -> Prediction:
    """Train and predict, some shapes put in place of others."""
    shapes = {name: _represent(plugin, mesh) for name, mesh in _shapes().items()}
    for array in shapes.values():
        array.flags.writeable = False
    for name, other in (instead or {}).items():
        shapes[name] = shapes[other]
    return plugin.predict(shapes, _TRAIN, _TEST, device="cpu")


def _distance(plugin: Baseline, shape: str) -> float:
    """Distance from the limbed body to another test shape."""
    distances = _prediction(plugin).pairwise_distances()
    return float(distances[_TEST.index("limbed"), _TEST.index(shape)])


def _require_near(plugin: Baseline, shape: str, share: float) -> None:
    found, other = _distance(plugin, shape), _distance(plugin, "ellipsoid")
    require(
        found <= share * other,
        f"the distance is {found:.2g}; that to another shape is {other:.2g}",
    )
