from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from gipkg.baselines.deeppano import baseline as baseline_module
from gipkg.baselines.deeppano.baseline import COLUMNS, ROWS, DeepPano
from gipkg.baselines.deeppano.network import (
    STRIDE,
    AroundCylinder,
    PanoramaNetwork,
    every_shift,
    turned,
)
from gipkg.baselines.deeppano.panorama import farthest_intersections
from gipkg.descriptors.operators import Operators
from gipkg.learning import training
from gipkg.learning.classifier import Classifier
from gipkg.testing import meshes

SMALL = DeepPano(maps=(4, 8, 8, 8), features=32, epochs=1, learning_rate=0.01)


def represent(mesh: trimesh.Trimesh, baseline: DeepPano = SMALL) -> np.ndarray:
    return baseline.represent(mesh, Operators(mesh))


def panorama(mesh: trimesh.Trimesh, rows: int = 24, columns: int = 40) -> np.ndarray:
    return farthest_intersections(np.asarray(mesh.triangles), rows, columns)


def ellipsoids() -> dict[str, np.ndarray]:
    """Panoramas of long and flat ones, whose first letter is their class."""
    sides = {"l": np.array((1.0, 1.0, 2.0)), "f": np.array((1.0, 2.0, 2.0))}
    return {
        f"{label}{n}": represent(meshes.ellipsoid(tuple(sides[label] + 0.1 * n), subdivisions=2))
        for label in sides
        for n in range(4)
    }


SHAPES = ellipsoids()
TRAIN = {i: i[0] for i in SHAPES if i[1] in "02"}
TEST = tuple(i for i in SHAPES if i not in TRAIN)


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1))
def test_rays_leave_a_convex_body_where_they_leave_the_first_half_space(seed: int) -> None:
    """Second route, for bodies that the axis passes through, grazes or misses."""
    rng = np.random.default_rng(seed)
    body = trimesh.convex.convex_hull(rng.uniform(-1, 1, (10, 3)) * 0.6 + rng.uniform(-0.4, 0.4, 3))
    found = panorama(body)
    heights = 1 - (2 * np.arange(24) + 1) / 24
    angles = 2 * np.pi * np.arange(40) / 40
    offsets = np.einsum("fi,fi->f", body.triangles[:, 0], body.face_normals)
    gaps = offsets - heights[:, None, None] * body.face_normals[:, 2]
    along = np.outer(np.cos(angles), body.face_normals[:, 0])
    along += np.outer(np.sin(angles), body.face_normals[:, 1])
    with np.errstate(divide="ignore"):
        bounds = gaps / along
    leaves = np.where(along > 0, bounds, np.inf).min(axis=2)
    enters = np.where(along < 0, bounds, -np.inf).max(axis=2)
    sure = np.abs(leaves - np.maximum(enters, 0)) > 1e-9
    expected = np.where((leaves > enters) & (leaves > 0), leaves, 0)
    assert_allclose(found[sure], expected[sure], atol=1e-9)


def test_of_several_intersections_the_farthest_counts() -> None:
    near = trimesh.creation.icosphere(2, radius=0.3)
    far = trimesh.creation.icosphere(2, radius=0.4)
    far.apply_translation((0.5, 0.1, 0.2))
    both = panorama(trimesh.util.concatenate([near, far]))
    assert_array_equal(both, np.maximum(panorama(near), panorama(far)))


def test_a_cylinder_has_its_radius_on_every_side_and_its_rim() -> None:
    cylinder = trimesh.creation.cylinder(radius=0.5, height=1.0, sections=400)
    found = panorama(cylinder)
    heights = 1 - (2 * np.arange(24) + 1) / 24
    assert_allclose(found[np.abs(heights) < 0.5], 0.5, rtol=1e-4)
    assert not found[np.abs(heights) > 0.5].any()


def test_panoramas_keep_proportions_and_forget_place_and_size() -> None:
    box = trimesh.creation.box(extents=(2, 3, 6))  # 7 from corner to corner.
    upright = DeepPano(upright="z")
    found = represent(box, upright)
    assert (found.shape, found.dtype) == ((ROWS, COLUMNS), np.uint8)
    assert_array_equal(found[ROWS // 2, [0, COLUMNS // 4]], np.rint([255 * 2 / 7, 255 * 3 / 7]))
    filled = np.flatnonzero(found.any(axis=1))
    assert len(filled) == pytest.approx(ROWS * 6 / 7, abs=2)
    box.apply_scale(1e3)
    box.apply_translation((1e6, -1e6, 0))
    assert np.abs(represent(box, upright).astype(int) - found).max() <= 1


def test_a_turn_about_the_upright_axis_shifts_the_columns() -> None:
    mesh, upright = meshes.limbed(), DeepPano(upright="z")
    turn = trimesh.transformations.rotation_matrix(2 * np.pi * 13 / COLUMNS, (0, 0, 1))
    again = mesh.copy()
    again.apply_transform(turn)
    expected = np.roll(represent(mesh, upright).astype(int), 13, axis=1)
    changed = np.abs(represent(again, upright) - expected) > 1
    assert changed.mean() < 1e-3


def test_without_an_upright_axis_a_turned_shape_is_the_same_but_for_half_a_turn() -> None:
    mesh = meshes.limbed()
    expected = represent(mesh).astype(int)
    found = represent(meshes.moved(mesh, np.random.default_rng(3)))
    ways = [np.abs(np.roll(found, k, axis=1) - expected) > 1 for k in (0, COLUMNS // 2)]
    assert min(way.mean() for way in ways) < 1e-3


def test_a_cyclic_shift_of_the_panorama_changes_no_prediction() -> None:
    torch.manual_seed(0)
    network = PanoramaNetwork(ROWS, COLUMNS, (4, 8, 8, 8), 16, 2).eval()
    one = torch.from_numpy(represent(meshes.limbed()))[None, :, :, None]
    shifts = {str(k): one.roll(k, 2) for k in (0, 1, 7, STRIDE, 93, COLUMNS - 1)}
    found = Classifier(network, ("a", "b")).predict(lambda i: every_shift(shifts[i]), [*shifts])
    assert np.ptp(found.embeddings, axis=1).min() > 0
    assert_allclose(found.embeddings, found.embeddings[[0] * 6], rtol=1e-5, atol=1e-6)
    assert_allclose(found.scores, found.scores[[0] * 6], rtol=1e-5)
    with torch.inference_mode():
        whole = [network(shifts[k].permute(0, 3, 1, 2))[1] for k in ("0", str(STRIDE))]
    assert torch.equal(*whole)


def test_a_convolution_around_the_cylinder_knows_no_border() -> None:
    layer = AroundCylinder(1, 3, 5)
    maps = torch.rand(1, 1, 8, 20, generator=torch.Generator().manual_seed(0))
    with torch.inference_mode():
        found = layer(maps)
        torch.testing.assert_close(layer(maps.roll(3, 3)), found.roll(3, 3))
        valid = torch.nn.functional.conv2d(maps, layer.weight, layer.bias)
    torch.testing.assert_close(found[..., 2:-2, 2:-2], valid)


def test_every_panorama_is_turned_by_itself_and_every_other_one_mirrored() -> None:
    torch.manual_seed(0)
    row = torch.arange(20, dtype=torch.uint8)
    found = turned(row.expand(64, 1, 3, 20))
    steps = (found.int().diff(dim=3) % 20).flatten(1)
    assert (steps[::2] == 19).all()
    assert (steps[1::2] == 1).all()
    assert len(found[:, 0, 0, 0].unique()) > 15


def test_a_network_learns_panoramas_and_shapes_of_a_class_are_near(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(baseline_module, "MINIMUM_STEPS", 40)
    found = SMALL.predict(SHAPES, TRAIN, TEST, device="cpu")
    assert [found.classes[k] for k in found.scores.argmax(axis=1)] == [i[0] for i in TEST]
    distances = found.pairwise_distances()
    assert distances[0, 1] < distances[0, 2:].min()


def test_a_killed_training_ends_as_an_undisturbed_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With dropout, random turns and all."""
    monkeypatch.setattr(baseline_module, "MINIMUM_STEPS", 4)
    expected = SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu")
    monkeypatch.setattr(training, "SECONDS_BETWEEN_CHECKPOINTS", 0.0)
    descend, steps = training._descend, []

    def killed(*arguments: object) -> None:
        if len(steps) == 2:
            raise KeyboardInterrupt
        steps.append(descend(*arguments))

    monkeypatch.setattr(training, "_descend", killed)
    checkpoint = tmp_path / "state.pt"
    with pytest.raises(KeyboardInterrupt):
        SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    monkeypatch.setattr(training, "_descend", descend)
    found = SMALL.predict(SHAPES, TRAIN, TEST, seed=1, device="cpu", checkpoint=checkpoint)
    assert_array_equal(found.scores, expected.scores)
    assert_array_equal(found.embeddings, expected.embeddings)
