"""The conformance suite of datasets.

Checks of the contents run where `available` finds the files, and are skipped elsewhere; no
check uses the network.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING
from unittest.mock import patch

import numpy as np

from gipkg.api import Dataset, Shape, Volume
from gipkg.datasets.splits import choose, split, training_count
from gipkg.errors import DatasetNotFound
from gipkg.testing.common import add_common_checks
from gipkg.testing.suite import Suite, require

if TYPE_CHECKING:
    import trimesh

SUITE = Suite(floor=8)
add_common_checks(SUITE)

SAMPLE = 4
"""Shapes that are loaded, spread over the listing."""


@SUITE.check()
def tags_are_complete(plugin: Dataset) -> None:
    """Numbers, licence and source are there; a database of files has checksums."""
    tags = plugin.tags
    if tags.shapes is not None and tags.classes is not None:
        require(tags.shapes >= tags.classes > 0, f"{tags.shapes} shapes in {tags.classes} classes")
    require(tags.licence.strip(), "the licence is empty; say 'none stated' if none is")
    require(tags.source.strip(), "the source is empty")
    require(plugin.upright in (None, "x", "y", "z"), f"{plugin.upright!r} is no axis")
    require(
        _is_published(plugin) == bool(tags.files),
        "published files are named with their checksums, no others",
    )
    for path, digest in tags.files.items():
        require(not Path(path).is_absolute(), f"{path} is not relative to the data root")
        hexadecimal = len(digest) == 64 and set(digest) <= set("0123456789abcdef")
        require(hexadecimal, f"{path}: {digest!r} is not a SHA-256")


@SUITE.check()
def names_its_protocols(plugin: Dataset) -> None:
    """Each random split leaves training and test shapes in a mean class."""
    tags = plugin.tags
    if tags.shapes is None or tags.classes is None:
        return
    for name, protocol in plugin.protocols.items():
        per_class = protocol.shapes_per_class or tags.shapes // tags.classes
        if protocol.train_per_class != "official":
            train = training_count(protocol.train_per_class, per_class)
            require(0 < train < per_class, f"{name}: {protocol} of {per_class}")


@SUITE.check(when=lambda plugin: _is_published(plugin))
def is_absent_from_an_empty_folder(plugin: Dataset) -> None:
    """Without its files it says so, and where they belong."""
    with TemporaryDirectory() as folder, no_network():
        root = Path(folder)
        require(not plugin.available(root), "it claims to be available in an empty folder")
        for action in (plugin.shapes, plugin.fetch):
            try:
                action(root)
            except DatasetNotFound as error:
                where = any(part in str(error) for part in (folder, *plugin.tags.files))
                require(where, f"the error does not say where files belong: {error}")
            else:
                require(False, f"{action.__name__} raises no DatasetNotFound")


@SUITE.check(when=lambda plugin: plugin.tags.generated)
def is_available_anywhere(plugin: Dataset) -> None:
    """What is generated needs no files, and fetching it does nothing."""
    with TemporaryDirectory() as folder, no_network():
        require(plugin.available(Path(folder)), "it is generated, yet not available")
        plugin.fetch(Path(folder))
        left = sorted(path.name for path in Path(folder).iterdir())
        require(not left, f"fetch leaves {left} under the data root")


@SUITE.check(needs_data=True)
def lists_shapes_in_one_order(plugin: Dataset, root: Path) -> None:
    """Sorted by id, each id once, and the same in a second listing."""
    shapes = plugin.shapes(root)
    ids = [shape.id for shape in shapes]
    require(all(isinstance(shape, Shape) for shape in shapes), "not all entries are of type Shape")
    require(ids == sorted(set(ids)), "the ids are not sorted and unique")
    require(type(plugin).model_validate(plugin.model_dump()).shapes(root) == shapes, "it varies")


@SUITE.check(needs_data=True)
def counts_what_its_tags_say(plugin: Dataset, root: Path) -> None:
    """The numbers of shapes and classes are those of the tags."""
    shapes = plugin.shapes(root)
    found = len(shapes), len({shape.label for shape in shapes})
    stated = plugin.tags.shapes, plugin.tags.classes
    require(stated in (found, (None, None)), f"found {found}, not the tags' {stated}")
    listed = {shape.id for shape in shapes} & set(plugin.tags.excluded)
    require(not listed, f"{sorted(listed)} are listed, though the tags exclude them")


@SUITE.check(needs_data=True)
def splits_by_its_protocols(plugin: Dataset, root: Path) -> None:
    """Every protocol yields disjoint parts that make up all that takes part, repeatably."""
    shapes = plugin.shapes(root)
    for name, protocol in plugin.protocols.items():
        labels = {shape.id: shape.label for shape in choose(shapes, protocol)}
        train, test = split(shapes, protocol, seed=0)
        require(train and test, f"{name}: a part is empty")
        require(not set(train) & set(test), f"{name}: the parts overlap")
        require(sorted((*train, *test)) == sorted(labels), f"{name}: the parts are not the whole")
        untrained = set(labels.values()) - {labels[shape_id] for shape_id in train}
        require(not untrained, f"{name}: nothing trains of {untrained}")
        again = split(tuple(reversed(shapes)), protocol, seed=0)
        require(again == (train, test), f"{name}: the split depends on the order of the listing")


@SUITE.check(needs_data=True)
def loads_the_same_shape_twice(plugin: Dataset, root: Path) -> None:
    """Meshes and volumes are sound, and come back bit-equal."""
    for shape_id in _sample(plugin, root):
        with no_network():
            first, second = (plugin.load(root, shape_id) for _ in range(2))
        if isinstance(first, Volume):
            _require_solid(first, shape_id)
        else:
            _require_triangles(first, shape_id)
        require(_content(first) == _content(second), f"{shape_id} differs when loaded again")


@SUITE.check(needs_data=True)
def holds_different_shapes(plugin: Dataset, root: Path) -> None:
    """No two of the sampled shapes are the same mesh or volume."""
    sample = _sample(plugin, root)
    contents = {_content(plugin.load(root, shape_id)) for shape_id in sample}
    require(len(contents) == len(sample), "two shapes are the same")


@SUITE.check(needs_data=True)
def refuses_an_unknown_shape(plugin: Dataset, root: Path) -> None:
    """An id that is not listed is a DatasetNotFound that names it."""
    try:
        plugin.load(root, "no-such-shape")
    except DatasetNotFound as error:
        require("no-such-shape" in str(error), f"the error does not name the id: {error}")
    else:
        require(False, "it loads a shape that it does not list")


@contextmanager
def no_network() -> Iterator[None]:
    """Make every outgoing connection fail, at once and without leaving the machine."""
    refuse = OSError("conformance checks use no network")
    with (
        patch("socket.socket.connect", side_effect=refuse),
        patch("socket.create_connection", side_effect=refuse),
        patch("socket.getaddrinfo", side_effect=refuse),
    ):
        yield


def _is_published(plugin: Dataset) -> bool:
    """Tell a database that others have published from a generated one and the user's own."""
    return not plugin.tags.generated and plugin.tags.shapes is not None


def _sample(plugin: Dataset, root: Path) -> list[str]:
    shapes = plugin.shapes(root)
    positions = np.linspace(0, len(shapes) - 1, min(SAMPLE, len(shapes))).astype(int)
    return [shapes[position].id for position in positions]


def _content(shape: trimesh.Trimesh | Volume) -> bytes:
    arrays = [shape.values] if isinstance(shape, Volume) else [shape.vertices, shape.faces]
    return b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)


def _require_triangles(mesh: trimesh.Trimesh, shape_id: str) -> None:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    require(len(faces) and faces.shape[1] == 3, f"{shape_id} has no triangles")
    require(np.isfinite(vertices).all(), f"{shape_id} has vertices that are not finite")
    require(faces.min() >= 0 and faces.max() < len(vertices), f"{shape_id}: indices")


def _require_solid(volume: Volume, shape_id: str) -> None:
    values = np.asarray(volume.values)
    require(values.ndim == 3, f"{shape_id} has {values.ndim} axes instead of three")
    require(np.isfinite(values).all(), f"{shape_id} has values that are not finite")
    solid = values > volume.level
    require(solid.any() and not solid.all(), f"{shape_id} is empty, or has no outside")
