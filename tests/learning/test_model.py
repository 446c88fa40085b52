from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gipkg.errors import DamagedFileError, LearningError
from gipkg.files import write_arrays
from gipkg.formats.arrays import read_arrays
from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.model import load_model
from gipkg.learning.prediction import Prediction
from tests.learning.trainings import (
    IMAGES,
    LABELS,
    SHORT,
    SMALL,
    TEST,
    TOGETHER,
    TRAIN,
    accuracy,
    assert_equal,
    run,
    trained,
)


def test_it_learns_channels_of_any_scale(undisturbed: Prediction) -> None:
    assert accuracy(undisturbed) == 1.0
    assert undisturbed.ids == TEST
    assert undisturbed.classes == tuple(sorted(set(LABELS.values())))
    assert undisturbed.embeddings.shape == (len(TEST), 48)
    np.testing.assert_allclose(undisturbed.scores.sum(axis=1), np.ones(len(TEST)), rtol=1e-5)


def test_the_variant_of_the_paper_learns() -> None:
    training = TrainingConfig(
        minimum_steps=150,
        optimiser="sgd",
        learning_rate=1e-2,
        schedule="steps",
        weight_decay=1e-4,
        scaling="joint",
    )
    images = {i: views / np.array([[[1e-3]], [[1e4]]], np.float32) for i, views in IMAGES.items()}
    printed = NetworkConfig(pooling="local", batch_normalisation=False)
    found = run(images, network=printed, training=training)
    assert accuracy(found) == 1.0


def test_the_seed_fixes_every_bit(undisturbed: Prediction) -> None:
    assert_equal(run(), undisturbed)
    assert (run(seed=1).scores != undisturbed.scores).all()


def test_the_test_part_changes_nothing_but_its_own_predictions(undisturbed: Prediction) -> None:
    changed = run({**IMAGES, TEST[0]: 100 * IMAGES[TEST[0]] + 7})
    np.testing.assert_array_equal(changed.scores[1:], undisturbed.scores[1:])
    np.testing.assert_array_equal(changed.embeddings[1:], undisturbed.embeddings[1:])
    assert (changed.embeddings[0] != undisturbed.embeddings[0]).any()


def test_views_pooled_in_the_network_are_in_no_order(undisturbed_together: Prediction) -> None:
    found = undisturbed_together
    assert accuracy(found) == 1.0
    turned = {i: np.ascontiguousarray(IMAGES[i][[2, 0, 3, 1]]) for i in TEST}
    assert_equal(trained(network=TOGETHER).predict(turned, TEST), found)


def test_views_that_are_too_few_to_be_pooled_are_named() -> None:
    with pytest.raises(LearningError, match="pools 9 views of a shape, there are 4"):
        trained(network=SMALL.model_copy(update={"together": 9}))


def test_views_are_pooled_by_their_mean(undisturbed: Prediction) -> None:
    # Each view predicted alone, as if it were a shape of its own.
    views = range(len(IMAGES[TEST[0]]))
    single = {f"view {v}": IMAGES[TEST[0]][v : v + 1] for v in views}
    found = trained().predict(single, tuple(single))
    np.testing.assert_allclose(found.scores.mean(axis=0), undisturbed.scores[0], rtol=1e-4)
    np.testing.assert_allclose(
        found.embeddings.mean(axis=0), undisturbed.embeddings[0], rtol=1e-4, atol=1e-5
    )


def test_signatures_of_length_one_are_those_of_the_same_network(undisturbed: Prediction) -> None:
    found = run(network=SMALL.model_copy(update={"unit_signatures": True}))
    np.testing.assert_array_equal(found.scores, undisturbed.scores)
    lengths = np.linalg.norm(undisturbed.embeddings, axis=1, keepdims=True)
    np.testing.assert_allclose(found.embeddings * lengths, undisturbed.embeddings, rtol=1e-5)
    np.testing.assert_allclose(np.linalg.norm(found.embeddings, axis=1), 1, rtol=1e-5)


@pytest.mark.parametrize(
    "change",
    [
        {"shuffle_pixels": True},
        {"mirror": True},
        {"label_smoothing": 0.2},
        {"scaling": "joint"},
        {"optimiser": "sgd"},
        {"precision": "bfloat16"},
    ],
    ids=lambda change: next(iter(change)),
)
def test_every_choice_makes_a_difference(change: dict[str, Any]) -> None:
    base = {"precision": "float32"}
    plain, changed = (
        run(training=SHORT.model_copy(update=update)) for update in (base, base | change)
    )
    assert (changed.embeddings != plain.embeddings).any()


def test_a_training_that_diverges_is_named() -> None:
    images = {**IMAGES, TRAIN[0]: np.full_like(IMAGES[TRAIN[0]], np.nan)}
    with pytest.raises(LearningError, match="diverged at step 0"):
        run(images)


@pytest.mark.parametrize("shuffle", [False, True])
def test_a_model_read_from_its_file_is_the_same_bit_by_bit(shuffle: bool, tmp_path: Path) -> None:
    model = trained(training=SHORT.model_copy(update={"shuffle_pixels": shuffle, "epochs": 2}))
    path = tmp_path / "models" / "0.model.npz"
    model.save(path, about={"size": 40})
    read = load_model(path)
    assert_equal(read.predict(IMAGES, TEST), model.predict(IMAGES, TEST))
    assert (read.about, read.network, read.classes) == ({"size": 40}, SMALL, model.classes)
    first = path.read_bytes()
    read.save(path)
    assert path.read_bytes() == first


def test_a_model_takes_the_images_that_it_learned_from(undisturbed: Prediction) -> None:
    model = trained()
    for views in (IMAGES[TEST[0]][:, :1], IMAGES[TEST[0]][:, :, 1:, 1:]):
        with pytest.raises(LearningError, match=r"other: images are .* learned from \(2, 40, 40\)"):
            model.predict({"other": views}, ["other"])
    # Of any number of views.
    model.predict({"other": IMAGES[TEST[0]][:1]}, ["other"])


@pytest.mark.parametrize("damage", ["cut", "other", "weights"])
def test_a_damaged_model_is_named(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "0.model.npz"
    trained(training=SHORT.model_copy(update={"epochs": 1})).save(path)
    if damage == "cut":
        path.write_bytes(path.read_bytes()[:-1000])
    elif damage == "other":
        path.write_bytes(b"not a model")
    else:
        with np.load(path) as arrays:
            np.savez(path, **{name: arrays[name] for name in arrays.files[:-3]})
    with pytest.raises(DamagedFileError, match=r"0\.model\.npz"):
        load_model(path)


@pytest.mark.parametrize(
    ("key", "value"), [("classes", ["a"] * 10**5), ("channels", 10**12), ("size", -8)]
)
def test_a_model_takes_no_more_memory_than_its_file_holds(
    key: str, value: object, tmp_path: Path
) -> None:
    path = tmp_path / "model.npz"
    trained().save(path)
    arrays = read_arrays(path)
    header = json.loads(str(arrays.pop("header"))) | {key: value}
    write_arrays(path, {"header": np.array(json.dumps(header)), **arrays})
    with pytest.raises(DamagedFileError, match=r"model\.npz: not a whole trained network"):
        load_model(path)


def test_a_compressed_model_is_not_unpacked(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "model.npz", header=np.array("{}"), bomb=np.zeros(1 << 20))
    with pytest.raises(DamagedFileError, match=r"model\.npz"):
        load_model(tmp_path / "model.npz")
