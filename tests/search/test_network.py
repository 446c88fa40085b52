"""A mesh is shown to a network as the workflow showed it those that it learned from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.descriptors.operators import Operators
from gipkg.errors import DamagedFileError, PluginError
from gipkg.fingerprints import _closure, fingerprint_module
from gipkg.images.cuts import standard_cuts
from gipkg.images.lookup import lookup
from gipkg.registry import create
from gipkg.search import network as module
from gipkg.search.network import SignatureNetwork
from gipkg.search.recipe import ImageMaker, Recipe
from tests.search.trained import RECIPE, SHAPES, mesh, write_network


def test_images_are_made_stage_by_stage_as_the_recipe_says() -> None:
    shape = mesh("needles/1")
    images = ImageMaker.of(Recipe.model_validate(RECIPE)).images(shape)
    operators = Operators(shape, RECIPE["eigenpairs"])
    channels = np.hstack(
        [
            create("descriptor", "hks", {"times": 2}).describe(shape, operators),
            create("descriptor", "curvature", {"quantity": "mean"}).describe(shape, operators),
        ]
    )
    known = SphericalMap(shape, create("parametrizer", "authalic").parametrize(shape))
    expected = lookup(known, 40, standard_cuts()).render(channels)
    assert images.shape == (36, 3, 40, 40)
    np.testing.assert_array_equal(images, expected)


def test_upright_shapes_are_turned_and_cut_as_such() -> None:
    upright = {"cuts": "upright", "turns": 3, "azimuth": "pose"}
    by_z = ImageMaker.of(Recipe.model_validate({**RECIPE, **upright, "up": "z"}))
    by_y = ImageMaker.of(Recipe.model_validate({**RECIPE, **upright, "up": "y"}))
    shape = mesh("needles/1")
    turned = shape.copy()
    turned.vertices = np.roll(shape.vertices, -1, axis=1)  # z becomes y, by a rotation
    assert by_z.images(shape).shape == (3, 3, 40, 40)
    np.testing.assert_array_equal(by_y.images(turned), by_z.images(shape))


def test_signatures_are_those_of_the_model_and_tell_the_kinds_apart(network_file: Path) -> None:
    network = SignatureNetwork.read(network_file)
    signatures = {name: network.signature(mesh(name)) for name in SHAPES}
    images = {name: network.maker.images(mesh(name)) for name in SHAPES}
    said = network.model.predict(images, tuple(SHAPES))
    for name, embedding in zip(SHAPES, said.embeddings, strict=True):
        np.testing.assert_array_equal(signatures[name].embedding, embedding)
        assert signatures[name].label == name.partition("/")[0]


def test_a_signature_does_not_change_when_a_shape_is_moved(network_file: Path) -> None:
    network = SignatureNetwork.read(network_file)
    before = network.signature(mesh("plates/1")).embedding
    moved = mesh("plates/1")
    turn = Rotation.from_rotvec([0.3, 1.0, -2.0]).as_matrix()
    moved.vertices = 5 * moved.vertices @ turn.T + [1, 2, 3]
    after = network.signature(moved).embedding
    assert np.linalg.norm(after - before) < 0.05 * np.linalg.norm(before)


def test_a_network_comes_back_from_its_bytes(network_file: Path) -> None:
    network = SignatureNetwork.read(network_file)
    again = SignatureNetwork.of(network.content)
    assert again.key == network.key
    np.testing.assert_array_equal(
        again.signature(mesh("plates/1")).embedding, network.signature(mesh("plates/1")).embedding
    )


def test_another_network_has_another_key(network_file: Path, tmp_path: Path) -> None:
    write_network(tmp_path / "other.npz", seed=1)
    keys = {SignatureNetwork.read(path).key for path in (network_file, tmp_path / "other.npz")}
    assert len(keys) == 2


@pytest.mark.parametrize(
    ("about", "fault"),
    [
        ({}, "images: Input should be"),
        ({"images": {**RECIPE, "light": "blue"}}, "light: Extra inputs"),
        ({"images": {**RECIPE, "size": -1}}, "size: Input should be greater"),
    ],
)
def test_a_recipe_that_is_not_understood_is_named(about: dict, fault: str) -> None:
    with pytest.raises(DamagedFileError, match=fault):
        Recipe.of(about, Path("a.npz"))


def test_code_that_a_file_names_is_not_run_unless_allowed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gipkg.registry._local", {})
    plugin = tmp_path / "mine.py"
    plugin.write_text(
        "from pathlib import Path\n"
        "from gipkg.parametrizers.conformal import Conformal\n"
        "Path(__file__).with_name('ran').touch()\n"
        "class Mine(Conformal): pass\n"
    )
    target = f"{plugin}:Mine"
    spec = {"plugin": "mine", "target": target, "parameters": {}}
    recipe = Recipe.model_validate({**RECIPE, "parametrizer": spec})
    with pytest.raises(PluginError, match="not run unasked; --allow"):
        ImageMaker.of(recipe)
    assert not (tmp_path / "ran").exists()
    ImageMaker.of(recipe, [target])
    assert (tmp_path / "ran").exists()


def test_a_network_in_an_index_that_is_not_read_names_the_way_out(tmp_path: Path) -> None:
    other = tmp_path / "other.npz"
    write_network(other, {**RECIPE, "of another version": 1})
    with pytest.raises(DamagedFileError, match=r"network in the index .* --force") as caught:
        SignatureNetwork.of(other.read_bytes())
    # The bytes were in a file of no interest.
    assert "network.npz" not in str(caught.value)


def test_the_key_of_an_index_counts_the_code_of_the_network(monkeypatch, network_file) -> None:
    key = SignatureNetwork.read(network_file).key
    edited = f"{fingerprint_module('gipkg.search.network')} edited"
    monkeypatch.setattr(module, "fingerprint_module", {"gipkg.search.network": edited}.__getitem__)
    assert SignatureNetwork.read(network_file).key != key
    assert "gipkg.learning.views" in _closure(frozenset({"gipkg.search.network"}))
