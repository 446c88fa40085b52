"""The conformance suite of parametrizers.

Quality, not position, is compared where a mesh is permuted, moved or scaled: a method that
works on a hierarchy of the mesh may legitimately give another map, but not a worse one.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import trimesh
from numpy.typing import NDArray

from gipkg.api import Iteration, Parametrizer, SphericalMap
from gipkg.errors import UnsupportedMesh
from gipkg.evaluation.distortion import distortion
from gipkg.parametrizers.sphere.areas import flipped_faces, signed_spherical_areas
from gipkg.testing import meshes
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite, require

SUITE = Suite(floor=17)
add_common_checks(SUITE)

UNIT_NORM = 1e-12
"""Allowed distance of a vertex from the unit sphere."""
TOTAL_AREA = 1e-9
"""Allowed deviation of the summed signed areas from 4π."""
SAME_QUALITY = 0.25
"""Allowed relative change of std(r - 1) over faces when a mesh is permuted, moved or scaled."""
NO_QUALITY = 0.02
"""Changes of std(r - 1) below this are never held against a method."""
AREA_STD = 0.15
"""Bound of std(r - 1) over faces on the ellipsoid 1:1:4 for a method that promises areas."""
AREA_GAIN = 4.0
"""It must also be this much better there than the radial projection."""
ANGLE_RATIO = 1.06
"""Bound of the mean ratio of singular values on a fine ellipsoid 1:1:2 if angles are promised.

Flat triangles limit it: the conformal map of the smooth surface comes to about 1.03."""
ANGLE_GAIN = 2.0
"""The ratio must also be this much nearer to 1 there than that of the radial projection."""

SHAPES: dict[str, Callable[[], trimesh.Trimesh]] = {
    "sphere": meshes.sphere,
    "ellipsoid": meshes.ellipsoid,
    "limbed": meshes.limbed,
    "tetrahedron": meshes.tetrahedron,
}


def promises(guarantee: str) -> Callable[[Parametrizer], bool]:
    """Choose a check for the methods that promise something."""
    return lambda plugin: guarantee in plugin.tags.guarantees


@SUITE.check()
def returns_an_array_of_unit_vectors(plugin: Parametrizer) -> None:
    """Shape (V, 3), float64, finite, of norm 1, on every shape."""
    for name, shape in SHAPES.items():
        mesh = shape()
        sphere = plugin.parametrize(mesh)
        require(isinstance(sphere, np.ndarray), f"{name}: not an array but {type(sphere)}")
        require(sphere.shape == mesh.vertices.shape, f"{name}: the shape is {sphere.shape}")
        require(sphere.dtype == np.float64, f"{name}: the type is {sphere.dtype}")
        require(np.isfinite(sphere).all(), f"{name}: values are not finite")
        error = np.abs(np.linalg.norm(sphere, axis=1) - 1).max()
        require(error <= UNIT_NORM, f"{name}: norms deviate from 1 by {error:.1e}")


@SUITE.check()
def leaves_the_mesh_alone(plugin: Parametrizer) -> None:
    """A mesh whose arrays are read-only is no obstacle, and is the same afterwards."""
    mesh = meshes.read_only(meshes.ellipsoid())
    before = mesh.vertices.tobytes(), mesh.faces.tobytes()
    plugin.parametrize(mesh)
    require((mesh.vertices.tobytes(), mesh.faces.tobytes()) == before, "the mesh was changed")


@SUITE.check(when=lambda plugin: plugin.tags.deterministic)
def repeats_itself(plugin: Parametrizer) -> None:
    """The same mesh gives the same map, bit by bit."""
    first, second = (plugin.parametrize(meshes.limbed()) for _ in range(2))
    require(
        first.tobytes() == second.tobytes(),
        f"two runs differ by up to {np.abs(first - second).max():.1e}",
    )


@SUITE.check(when=lambda plugin: plugin.tags.iterative)
def tells_its_iterations(plugin: Parametrizer) -> None:
    """A callback is told the start and every iteration in order, and changes nothing."""
    mesh = meshes.ellipsoid()
    numbers: list[int] = []

    def note(iteration: Iteration) -> None:
        numbers.append(iteration.number)
        error = np.abs(np.linalg.norm(iteration.sphere, axis=1) - 1).max()
        require(error <= UNIT_NORM, f"iteration {iteration.number}: norms deviate by {error:.1e}")
        require(np.isfinite(iteration.objective), f"iteration {iteration.number}: no objective")

    told = plugin.parametrize(mesh, note)
    require(numbers == list(range(len(numbers))), f"the numbers are {numbers[:9]}")
    require(len(numbers) > 1, "no iteration was told")
    same = told.tobytes() == plugin.parametrize(mesh).tobytes()
    require(same or not plugin.tags.deterministic, "listening changes the map")


@SUITE.check()
def covers_the_sphere_once(plugin: Parametrizer) -> None:
    """The signed areas sum to 4π on shapes that are nearly round."""
    for axes in ((1.0, 1.0, 1.0), (1.0, 1.1, 1.2)):
        mesh = meshes.ellipsoid(axes)
        total = signed_spherical_areas(plugin.parametrize(mesh), mesh.faces).sum()
        require(abs(total - 4 * np.pi) <= TOTAL_AREA, f"axes {axes}: the areas sum to {total}")


@SUITE.check(when=promises("bijective"))
def keeps_every_face_unflipped(plugin: Parametrizer) -> None:
    """No face is flipped by an exact test and the map is of degree 1, on every shape."""
    for name, shape in SHAPES.items():
        mesh = shape()
        _require_bijective(name, plugin.parametrize(mesh), mesh)


@SUITE.check(when=promises("area"))
def keeps_areas(plugin: Parametrizer) -> None:
    """On an ellipsoid 1:1:4 areas are kept, absolutely and beside the radial projection."""
    mesh = meshes.ellipsoid()
    maps = (SphericalMap(mesh, sphere) for sphere in (plugin.parametrize(mesh), _radial(mesh)))
    ours, theirs = (distortion(one).face_std for one in maps)
    require(
        ours <= min(AREA_STD, theirs / AREA_GAIN),
        f"std(r - 1) is {ours:.3g}; radially {theirs:.3g}, and {AREA_STD} is allowed",
    )


@SUITE.check(when=promises("angle"))
def keeps_angles(plugin: Parametrizer) -> None:
    """On an ellipsoid 1:1:2 faces keep their shape, and better than under radial projection."""
    mesh = meshes.ellipsoid((1.0, 1.0, 2.0), subdivisions=4)
    ours, theirs = (
        np.average(stretch_ratios(map_, mesh), weights=mesh.area_faces)
        for map_ in (plugin.parametrize(mesh), _radial(mesh))
    )
    require(
        ours <= min(ANGLE_RATIO, 1 + (theirs - 1) / ANGLE_GAIN),
        f"the mean ratio of singular values is {ours:.3f}; radially {theirs:.3f}",
    )


@SUITE.check()
def does_not_depend_on_the_order_of_vertices(plugin: Parametrizer) -> None:
    """A permuted mesh is mapped as well as the mesh itself."""
    mesh = meshes.limbed()
    _require_same_quality(plugin, mesh, meshes.permuted(mesh, np.random.default_rng(1))[0])


@SUITE.check()
def does_not_depend_on_position(plugin: Parametrizer) -> None:
    """A turned and shifted mesh is mapped as well as the mesh itself."""
    mesh = meshes.limbed()
    _require_same_quality(plugin, mesh, meshes.moved(mesh, np.random.default_rng(2)))


@SUITE.check()
def does_not_depend_on_scale(plugin: Parametrizer) -> None:
    """Lengths in other units make no difference."""
    mesh = meshes.limbed()
    for factor in (1e-4, 1e4):
        _require_same_quality(plugin, mesh, meshes.scaled(mesh, factor))


@SUITE.check()
def refuses_a_torus(plugin: Parametrizer) -> None:
    """A surface with a handle is refused, and the handle named."""
    _require_refusal(plugin, meshes.torus(), "genus|handle")


@SUITE.check()
def refuses_an_open_surface(plugin: Parametrizer) -> None:
    """A surface with a hole is refused, and the hole named."""
    _require_refusal(plugin, meshes.open_sphere(), "open|boundary|border|hole|watertight")


@SUITE.check()
def refuses_two_components(plugin: Parametrizer) -> None:
    """Two surfaces at once are refused, and their number named."""
    _require_refusal(plugin, meshes.two_spheres(), "component")


@SUITE.check()
def refuses_a_turned_face(plugin: Parametrizer) -> None:
    """Faces that are not oriented alike are refused."""
    _require_refusal(plugin, meshes.turned_face(), "orient|winding")


@SUITE.check()
def refuses_what_is_not_finite(plugin: Parametrizer) -> None:
    """A vertex that is not a number is refused."""
    _require_refusal(plugin, meshes.not_finite(), "finite|nan")


def stretch_ratios(sphere: NDArray[np.float64], mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Return the (F,) ratios of the singular values of the map of each face; 1 is conformal."""
    (a, b, c), (p, q, r) = (_metric(points[mesh.faces]) for points in (mesh.vertices, sphere))
    # Trace and determinant of the inverse metric of the mesh times that of the sphere.
    determinant = a * c - b**2
    half_trace = (c * p - 2 * b * q + a * r) / (2 * determinant)
    root = np.sqrt(np.maximum(half_trace**2 - (p * r - q**2) / determinant, 0.0))
    ratio: NDArray[np.float64] = np.sqrt((half_trace + root) / (half_trace - root))
    return ratio


def _radial(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    direction: NDArray[np.float64] = np.asarray(mesh.vertices)
    return direction / np.linalg.norm(direction, axis=1, keepdims=True)


def _metric(corners: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    pairs = ((first, first), (first, second), (second, second))
    return tuple(np.einsum("ij,ij->i", left, right) for left, right in pairs)


def _require_bijective(name: str, sphere: NDArray[np.float64], mesh: trimesh.Trimesh) -> None:
    flips = int(flipped_faces(sphere, mesh.faces).sum())
    require(flips == 0, f"{name}: {flips} of {len(mesh.faces)} faces are flipped")
    total = signed_spherical_areas(sphere, mesh.faces).sum()
    require(abs(total - 4 * np.pi) <= TOTAL_AREA, f"{name}: the signed areas sum to {total}")


def _require_same_quality(
    plugin: Parametrizer, mesh: trimesh.Trimesh, changed: trimesh.Trimesh
) -> None:
    sphere = plugin.parametrize(changed)
    if "bijective" in plugin.tags.guarantees:
        _require_bijective("the changed mesh", sphere, changed)
    maps = SphericalMap(mesh, plugin.parametrize(mesh)), SphericalMap(changed, sphere)
    before, after = (distortion(one).face_std for one in maps)
    require(
        abs(after - before) <= max(SAME_QUALITY * before, NO_QUALITY),
        f"std(r - 1) changes from {before:.3g} to {after:.3g}",
    )


def _require_refusal(plugin: Parametrizer, mesh: trimesh.Trimesh, fault: str) -> None:
    try:
        plugin.parametrize(mesh)
    except UnsupportedMesh as error:
        named = re.search(fault, str(error), re.IGNORECASE)
        require(named, f"the error does not name the fault ({fault}): {error}")
    else:
        advice = "gipkg.surfaces.validation.check_genus_zero(mesh) does"
        require(False, f"no UnsupportedMesh was raised; {advice}")
