"""The generated database: topology, range, determinism, and neither trivial nor free."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis
from sklearn.model_selection import StratifiedKFold, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.svm import SVC, LinearSVC

from gipkg.baselines.shapedna import ShapeDNA
from gipkg.datasets import articulated
from gipkg.datasets.articulated import CLASSES, Articulated
from gipkg.datasets.articulated.remesh import genus
from gipkg.datasets.articulated.skeleton import Skeleton
from gipkg.descriptors.operators import Operators
from gipkg.errors import DatasetNotFound, UnsupportedMesh

ROOT = Path("nothing-is-read")
PER_CLASS = 10
LABELS = np.repeat(list(CLASSES), PER_CLASS)


@pytest.fixture(scope="module")
def meshes():
    """Half of the database, at its default size."""
    dataset = Articulated(per_class=PER_CLASS)
    return {shape.id: dataset.load(ROOT, shape.id) for shape in dataset.shapes(ROOT)}


@pytest.fixture(scope="module")
def by_class(meshes):
    return {name: [m for i, m in meshes.items() if i.startswith(name)] for name in CLASSES}


def accuracy(classifier, features) -> float:
    """Cross-validated accuracy, with eight shapes a class to train."""
    folds = StratifiedKFold(5, shuffle=True, random_state=0)
    pipeline = make_pipeline(StandardScaler(), classifier)
    return cross_val_score(pipeline, features, LABELS, cv=folds).mean()


def test_lists_twenty_of_ten_classes_sorted():
    shapes = Articulated().shapes(ROOT)
    assert len(shapes) == Articulated.tags.shapes
    assert set(Counter(shape.label for shape in shapes).values()) == {20}
    assert len(CLASSES) == Articulated.tags.classes
    assert [shape.id for shape in shapes] == sorted({shape.id for shape in shapes})


def test_closed_oriented_outwards_and_of_one_component(meshes):
    for name, mesh in meshes.items():
        assert mesh.is_watertight, name
        assert mesh.is_winding_consistent, name
        assert mesh.volume > 0, name
        assert mesh.body_count == 1, name
        assert len(np.unique(mesh.faces)) == len(mesh.vertices), name
        assert np.isfinite(mesh.vertices).all(), name
        assert mesh.area_faces.min() > 0, name


def test_genus_of_each_class(by_class):
    genera = {
        name: Counter(genus(mesh.faces, len(mesh.vertices)) for mesh in members)
        for name, members in by_class.items()
    }
    assert genera.pop("spectacles") == {2: PER_CLASS}
    shut = genera.pop("pliers")
    assert set(shut) == {0, 1}
    assert 1 <= shut[1] <= PER_CLASS / 2
    assert all(counts == {0: PER_CLASS} for counts in genera.values())


def test_sizes_fill_the_range(meshes):
    sizes = np.array([len(mesh.vertices) for mesh in meshes.values()])
    assert sizes.min() >= 1000
    assert sizes.max() <= 3000
    assert np.ptp(sizes) > 1500


@pytest.mark.parametrize("name", CLASSES)
def test_a_shape_depends_on_seed_class_and_index_alone(meshes, name):
    small = Articulated(per_class=4)
    for index in (3, 1):
        again, first = small.load(ROOT, f"{name}-00{index}"), meshes[f"{name}-00{index}"]
        assert again.vertices.tobytes() == first.vertices.tobytes()
        assert again.faces.tobytes() == first.faces.tobytes()
    other = Articulated(per_class=4, seed=1).load(ROOT, f"{name}-001")
    assert other.vertices.shape != first.vertices.shape


def test_smoke_size():
    dataset = Articulated(per_class=2, min_vertices=300, max_vertices=400)
    for shape in dataset.shapes(ROOT):
        mesh = dataset.load(ROOT, shape.id)
        assert 300 <= len(mesh.vertices) <= 400
        assert genus(mesh.faces, len(mesh.vertices)) in {"spectacles": {2}, "pliers": {0, 1}}.get(
            shape.label, {0}
        )


@pytest.mark.parametrize(
    "classifier", [LinearDiscriminantAnalysis(), SVC(C=10)], ids=["LDA", "SVM"]
)
def test_area_and_volume_do_not_tell_the_classes(meshes, classifier):
    area = np.log([mesh.area for mesh in meshes.values()])
    volume = np.log([mesh.volume for mesh in meshes.values()])
    assert accuracy(classifier, np.stack([area, volume], axis=1)) < 0.5
    assert accuracy(classifier, (1.5 * area - volume)[:, None]) < 0.5


def test_the_spectrum_tells_most_classes_but_not_all_shapes(meshes):
    features = [ShapeDNA().represent(mesh, Operators(mesh, 40)) for mesh in meshes.values()]
    assert 0.7 < accuracy(LinearSVC(), features) < 0.97


def test_unknown_shape():
    with pytest.raises(DatasetNotFound, match=r"no shape 'ants-020'.*ants-000.*-019"):
        Articulated().load(ROOT, "ants-020")


def test_limbs_that_always_touch_are_reported(monkeypatch):
    def knot(rng: np.random.Generator) -> Skeleton:
        skeleton = Skeleton()
        first = skeleton.ball([0, 0, 0], 0.1)
        corner = skeleton.ball([5, 0, 0], 0.1, first)
        skeleton.ball([0, 0.1, 0], 0.1, corner)
        return skeleton

    monkeypatch.setattr(articulated, "CLASSES", {"knots": knot})
    with pytest.raises(UnsupportedMesh, match="articulated/knots-000: limbs touch"):
        Articulated().load(ROOT, "knots-000")


@pytest.mark.parametrize(
    "parameters",
    [{"seed": -1}, {"per_class": 1}, {"min_vertices": 100}, {"min_vertices": 4000}, {"color": 1}],
)
def test_bounds_of_the_parameters(parameters):
    with pytest.raises(ValidationError):
        Articulated(**parameters)
