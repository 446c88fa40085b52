"""TOSCA: the real archives whole, and what happens without them."""

from __future__ import annotations

import io
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from gipkg import registry
from gipkg.api import DatasetTags
from gipkg.datasets.tosca import Tosca, ToscaHighResolution
from gipkg.errors import DatasetNotFound, InvalidParameterError, MeshFormatError
from tests.datasets.tar_files import write_archive

TRIANGLES = np.array([[1, 2, 3], [1, 4, 2], [2, 4, 3], [3, 4, 1]], dtype=np.uint16)


def mat_file(**surface: np.ndarray) -> bytes:
    stream = io.BytesIO()
    savemat(stream, {"surface": surface})
    return stream.getvalue()


def tetrahedron(**changes: np.ndarray) -> bytes:
    x, y, z = np.vstack((np.zeros(3), np.eye(3))).T[:, :, None]
    return mat_file(**{"X": x, "Y": y, "Z": z, "TRIV": TRIANGLES} | changes)


@pytest.fixture
def root_of(tmp_path: Path):
    """Data root, and a database whose archive holds members of our own."""

    def make(members: dict[str, bytes]) -> tuple[Tosca, Path]:
        (tmp_path / "tosca").mkdir()
        sha256 = write_archive(tmp_path / "tosca" / "mine.tar.gz", members)

        class Mine(Tosca):
            tags = DatasetTags(
                generated=False,
                shapes=len(members),
                classes=1,
                licence="none",
                source="https://example.org/shapes",
                files={"tosca/mine.tar.gz": sha256},
            )

        return Mine(), tmp_path

    return make


@pytest.mark.parametrize(
    ("dataset", "counts"),
    [
        (
            Tosca(),
            {"cat": 9, "centaur": 6, "david": 15, "dog": 11, "gorilla": 21, "horse": 17}
            | {"lioness": 15, "michael": 20, "seahorse": 6, "shark": 1, "victoria": 24, "wolf": 3},
        ),
        (
            ToscaHighResolution(),
            {"cat": 11, "centaur": 6, "david": 7, "dog": 9, "gorilla": 4, "horse": 8}
            | {"michael": 20, "victoria": 12, "wolf": 3},
        ),
    ],
)
def test_the_real_archives_hold_these_classes(
    data_root: Path, dataset: Tosca, counts: dict[str, int]
) -> None:
    if not dataset.available(data_root):
        pytest.skip(f"no archive of {dataset.summary} under {data_root}")
    shapes = dataset.shapes(data_root)
    assert Counter(shape.label for shape in shapes) == counts
    some = type(dataset)(classes=("wolf", "cat")).shapes(data_root)
    assert some == tuple(shape for shape in shapes if shape.label in ("cat", "wolf"))


def test_a_wolf_is_closed_and_a_gorilla_in_pieces(data_root: Path) -> None:
    dataset = Tosca()
    if not dataset.available(data_root):
        pytest.skip(f"no archive of {dataset.summary} under {data_root}")
    wolf = dataset.load(data_root, "wolf0")
    assert wolf.is_watertight
    assert wolf.euler_number == 2
    assert wolf.volume > 0
    gorilla = dataset.load(data_root, "gorilla0")
    assert gorilla.body_count == 24
    assert not gorilla.is_watertight


def test_vertices_and_faces_keep_their_order_and_count_from_zero(root_of) -> None:
    dataset, root = root_of({"folder/cat7.mat": tetrahedron()})
    (shape,) = dataset.shapes(root)
    assert (shape.id, shape.label) == ("cat7", "cat")
    mesh = dataset.load(root, "cat7")
    np.testing.assert_array_equal(mesh.vertices, np.vstack((np.zeros(3), np.eye(3))))
    np.testing.assert_array_equal(mesh.faces, TRIANGLES.astype(int) - 1)
    assert dataset.available(root)
    dataset.fetch(root)


@pytest.mark.parametrize(
    "content",
    [
        b"no mat file at all, and long enough for the header of one" * 9,
        tetrahedron()[:300],
        tetrahedron(TRIV=TRIANGLES + 1),
        tetrahedron(TRIV=TRIANGLES - 1),
        tetrahedron(TRIV=TRIANGLES[:, :2]),
        tetrahedron(X=np.zeros((3, 1))),
        mat_file(X=np.zeros((4, 1))),
    ],
)
def test_an_unreadable_member_is_named(root_of, content: bytes) -> None:
    dataset, root = root_of({"cat7.mat": content})
    with pytest.raises(MeshFormatError, match=r"mine\.tar\.gz/cat7\.mat: not a TOSCA surface"):
        dataset.load(root, "cat7")


def test_a_class_that_is_not_there_is_refused_with_the_nearest() -> None:
    with pytest.raises(InvalidParameterError, match="did you mean 'lioness'"):
        registry.create("dataset", "tosca", {"classes": ["lionness"]})
    with pytest.raises(InvalidParameterError, match="'seahorse'"):
        registry.create("dataset", "tosca-highres", {"classes": ["seahorse"]})


@pytest.mark.parametrize("dataset", [Tosca(), ToscaHighResolution()])
def test_fetch_says_where_the_shapes_are_and_where_they_belong(
    tmp_path: Path, dataset: Tosca
) -> None:
    ((name, sha256),) = dataset.tags.files.items()
    assert not dataset.available(tmp_path)
    with pytest.raises(DatasetNotFound) as caught:
        dataset.fetch(tmp_path)
    for clue in (
        dataset.tags.source,
        dataset.packing,
        str(tmp_path / "tosca"),
        Path(name).name,
        sha256,
    ):
        assert clue in str(caught.value)
