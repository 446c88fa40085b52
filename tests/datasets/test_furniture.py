"""The generated furniture: parts that are solids, models that stand, soups that are soups."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy import ndimage
from skimage.measure import euler_number
from sklearn.model_selection import StratifiedKFold, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.svm import SVC

from gipkg.api import Protocol
from gipkg.datasets import split
from gipkg.datasets.furniture import CLASSES, Furniture
from gipkg.datasets.furniture.parts import box, loft, ring, slab, tube, turned_profile, unite
from gipkg.errors import DatasetNotFound

ROOT = Path("nothing-is-read")

spans = st.tuples(st.integers(0, 3), st.integers(1, 3)).map(lambda one: (one[0], sum(one)))


@pytest.fixture(scope="module")
def meshes():
    dataset = Furniture()
    return {shape.id: dataset.load(ROOT, shape.id) for shape in dataset.shapes(ROOT)}


def mesh_of(part) -> trimesh.Trimesh:
    return trimesh.Trimesh(part.vertices, part.faces, process=False)


@given(st.lists(st.tuples(spans, spans, spans), min_size=1, max_size=6))
@settings(max_examples=60)
def test_united_boxes_bound_the_cells_that_any_of_them_fills(boxes):
    filled = np.zeros((8, 8, 8), dtype=int)
    for one in boxes:
        filled[tuple(slice(low + 1, high + 1) for low, high in one)] = 1
    mesh = mesh_of(unite(boxes))
    assert mesh.volume == pytest.approx(filled.sum())
    assert mesh.area == pytest.approx(sum(np.abs(np.diff(filled, axis=k)).sum() for k in range(3)))
    directed = Counter(map(tuple, mesh.edges))
    assert all(directed[edge] == directed[edge[::-1]] for edge in directed)
    assert len(np.unique(mesh.faces)) == len(mesh.vertices)


@pytest.mark.parametrize(
    ("part", "volume"),
    [
        (box(((0, 1), (0, 2), (0, 3))), 6),
        (turned_profile([(2, 0), (2, 3)], corners=400), 3 * np.pi),
        (turned_profile([(2, 0), (0, 3)], stretch=0.5, corners=400), np.pi / 2),
        (turned_profile([(4, 0), (4, 3), (2, 3), (2, 1)], corners=400), 12 * np.pi - 2 * np.pi),
        (tube([[0, 0, 0], [0, 2, 0]], 1.0, corners=400), np.pi / 2),
        (slab([(0, 0), (0, 1), (0, 2)], 0.1, (1, 4)), 0.6),
        (loft([ring(2, 2, 0, 0.999), ring(2, 2, 3, 0.999)]), 12),
        (loft([ring(2, 2, 3), ring(2, 2, 0)]), 3 * 20 / 2 * np.sin(2 * np.pi / 20)),
    ],
    ids=["box", "cylinder", "cone", "basin", "tube", "slab", "block", "downwards"],
)
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_part_is_closed_turned_outward_and_as_large_as_it_should_be(part, volume, axis):
    mesh = mesh_of(part.turned(0.7, axis, pivot=(1, 2, 3)).moved((4, 5, 6)))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(volume, rel=2e-3)


def test_ten_classes_with_an_official_split():
    shapes = Furniture().shapes(ROOT)
    train, test = split(shapes, Protocol("official"), seed=0)
    assert (len(train), len(test)) == (160, 40)
    assert {shape.label for shape in shapes} == set(CLASSES)
    smallest = Furniture(per_class=4).shapes(ROOT)
    assert Counter(shape.part for shape in smallest) == {"train": 20, "test": 20}


@pytest.mark.parametrize("name", CLASSES)
def test_a_shape_depends_on_seed_class_and_index_alone(meshes, name):
    first = meshes[f"{name}-003"]
    again = Furniture(per_class=4).load(ROOT, f"{name}-003")
    assert again.vertices.tobytes() == first.vertices.tobytes()
    assert again.faces.tobytes() == first.faces.tobytes()
    other = Furniture(seed=1).load(ROOT, f"{name}-003")
    assert other.vertices.shape != first.vertices.shape or (other.vertices != first.vertices).any()


def test_models_hang_together(meshes):
    for name, mesh in meshes.items():
        if name.endswith(("-000", "-007")):
            components, _ = ndimage.label(voxels(mesh), np.ones((3, 3, 3)))
            sizes = np.bincount(components.ravel())[1:]
            assert sizes.max() > 0.99 * sizes.sum(), name


def test_chairs_have_handles_and_bathtubs_few(meshes):
    handles = {
        label: [
            1 - euler_number(voxels(mesh), connectivity=3)
            for name, mesh in meshes.items()
            if name.startswith(label)
        ]
        for label in ("chair", "bathtub")
    }
    assert np.mean(np.array(handles["chair"]) > 2) > 0.6
    assert np.median(handles["bathtub"]) == 0


def voxels(mesh: trimesh.Trimesh, resolution: int = 50) -> np.ndarray:
    """Mark the voxels that points on the triangles are in, and those that they enclose."""
    points, _ = trimesh.sample.sample_surface(mesh, 60_000, seed=0)
    points = np.concatenate([points, mesh.vertices])
    cells = ((points - points.min(axis=0)) * resolution / np.ptp(points, axis=0).max()).astype(int)
    grid = np.zeros(cells.max(axis=0) + 1, bool)
    grid[tuple(cells.T)] = True
    return ndimage.binary_fill_holes(grid)


def test_models_stand_upright(meshes):
    """A table is widest at its top, a bathtub opens upwards: gravity shows in the z axis."""
    for name, mesh in meshes.items():
        middle = mesh.bounds[:, 2].mean()
        weight = (mesh.triangles_center[:, 2] - middle) @ mesh.area_faces
        if name.startswith("table"):
            assert weight > 0, name
        elif name.startswith(("bed", "sofa")):
            assert weight < 0, name


def test_some_are_solids_and_most_are_soups_with_every_fault(meshes):
    closed = np.mean([mesh.is_watertight for mesh in meshes.values()])
    assert 0.2 < closed < 0.6
    oriented = np.mean([mesh.is_winding_consistent for mesh in meshes.values()])
    assert 0.2 < oriented < 0.7
    assert np.median([mesh.body_count for mesh in meshes.values()]) >= 3
    doubled = [
        len(mesh.faces) > len(np.unique(np.sort(mesh.faces, axis=1), axis=0))
        for mesh in meshes.values()
    ]
    assert 0.2 < np.mean(doubled) < 0.8


def test_sizes_and_simple_proportions_do_not_tell_the_classes(meshes):
    labels = [name.partition("-")[0] for name in meshes]
    area = np.log([mesh.area for mesh in meshes.values()])
    volume = np.log([abs(mesh.volume) for mesh in meshes.values()])
    hull = np.log([mesh.convex_hull.volume for mesh in meshes.values()])
    sizes = [np.ptp(mesh.vertices, axis=0) for mesh in meshes.values()]
    aspect = np.log([size[2] / np.hypot(*size[:2]) for size in sizes])

    def accuracy(*features: np.ndarray) -> float:
        folds = StratifiedKFold(5, shuffle=True, random_state=0)
        classifier = make_pipeline(StandardScaler(), SVC(C=10))
        return cross_val_score(classifier, np.stack(features, 1), labels, cv=folds).mean()

    assert accuracy(area, volume) < 0.4
    assert accuracy(1.5 * area - volume) < 0.4
    assert 0.3 < accuracy(1.5 * area - hull, volume - hull, aspect) < 0.75


def test_unknown_shape():
    with pytest.raises(DatasetNotFound, match=r"no shape 'bed-020'.*bathtub-000.*-019"):
        Furniture().load(ROOT, "bed-020")


@pytest.mark.parametrize("parameters", [{"seed": -1}, {"per_class": 3}, {"colour": 1}])
def test_bounds_of_the_parameters(parameters):
    with pytest.raises(ValidationError):
        Furniture(**parameters)
