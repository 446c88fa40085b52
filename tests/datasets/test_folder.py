"""A folder of one's own meshes: every layout that is one, and a named fault for every other."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import numpy as np
import pytest
import trimesh

from gipkg.datasets import official_split
from gipkg.datasets.folder import Folder
from gipkg.errors import DatasetLayoutError, DatasetNotFound, MeshFormatError
from gipkg.testing import run_checks

ROOT = Path("nothing-is-read")


def write(path: Path, size: float = 1.0) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    content = trimesh.creation.box((size, 2 * size, 3)).export(file_type=path.suffix.lower()[1:])
    path.write_bytes(content.encode() if isinstance(content, str) else content)


@pytest.fixture
def mugs(tmp_path):
    """Two classes in all formats, among other files."""
    folder = tmp_path / "meshes"
    for number, suffix in enumerate((".off", ".obj", ".ply", ".stl", ".glb", ".OFF"), start=1):
        write(folder / "mugs" / f"mug {number}{suffix}", number)
        write(folder / "jugs" / f"jug{number}{suffix}", 10 + number)
    for name in ("README.txt", "mugs/mug.mtl", "mugs/.mug.off", ".git/mug.off"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text("not a mesh")
    return folder


def shapes_of(folder: Path):
    return Folder(path=folder).shapes(ROOT)


def test_classes_are_folders_and_every_format_is_read(mugs):
    dataset = Folder(path=mugs)
    shapes = dataset.shapes(ROOT)
    assert [shape.id for shape in shapes] == [
        *(f"jugs-jug{number}" for number in range(1, 7)),
        *(f"mugs-mug_{number}" for number in range(1, 7)),
    ]
    assert {shape.label for shape in shapes} == {"mugs", "jugs"}
    for shape in shapes:
        size = int(shape.id[-1]) + 10 * (shape.label == "jugs")
        extents = np.ptp(dataset.load(ROOT, shape.id).vertices, axis=0)
        np.testing.assert_allclose(sorted(extents), sorted((size, 2 * size, 3)), rtol=1e-6)


def test_it_conforms(mugs):
    report = run_checks(Folder(path=mugs), "folder", data_root=mugs)
    assert report.fault is None
    assert report.count("skipped") == 0


def test_upright_is_what_the_user_says(mugs):
    assert Folder(path=mugs).upright is None
    assert Folder(path=mugs, up="y").upright == "y"


def test_parts_as_in_modelnet_are_the_official_split(tmp_path):
    for name in ("mugs/train/a", "mugs/train/b", "mugs/test/c", "jugs/train/a", "jugs/test/d"):
        write(tmp_path / f"{name}.ply")
    train, test = official_split(shapes_of(tmp_path))
    assert train == ("jugs-a", "mugs-a", "mugs-b")
    assert test == ("jugs-d", "mugs-c")


def test_names_become_identifiers_without_surprises(tmp_path):
    write(tmp_path / "große Krüge" / "50% (a|b); `x`.off")
    write(tmp_path / "mugs" / unicodedata.normalize("NFD", "é.tall-1.off"))
    ids = [shape.id for shape in shapes_of(tmp_path)]
    assert ids == ["große_Krüge-50_a_b_x_", "mugs-é.tall-1"]
    assert Folder(path=tmp_path).load(ROOT, ids[1]).is_watertight


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ([], "here is 0"),
        (["mugs/a.off"], "here is 1"),
        (["a.off", "mugs/a.off"], "a.off: a mesh lies in the folder of its class"),
        (["mugs/a.off", "jugs/"], r"no mesh \(\.ply, .*\) is in the folder of the class jugs"),
        (["mugs/a.off", "jugs/a.dae"], "of the class jugs"),
        (["mugs/a.off", "mugs/a.obj", "jugs/a.off"], r"a\.obj and .*a\.off are both .*'mugs-a'"),
        (["mugs/a b.off", "mugs/a+b.off", "jugs/a.off"], "are both named 'mugs-a_b'"),
        (["mugs/train/a.off", "mugs/test/a.off", "jugs/a.off"], "are both named 'mugs-a'"),
        (["mugs/old/a.off", "jugs/a.off"], "or there in train or test"),
        (["mugs/train/old/a.off", "jugs/a.off"], "or there in train or test"),
        (["mugs/train/a.off", "jugs/b.off"], "such as 'jugs-b', are not"),
        (["a b/1.off", "a+b/2.off"], "two of the classes a b, a.b have one name"),
    ],
)
def test_a_fault_of_the_layout_is_named(tmp_path, files, words):
    for name in files:
        if name.endswith("/"):
            (tmp_path / name).mkdir(parents=True)
        elif name.endswith(".dae"):
            (tmp_path / name).parent.mkdir()
            (tmp_path / name).write_text("<COLLADA/>")
        else:
            write(tmp_path / name)
    with pytest.raises(DatasetLayoutError, match=words):
        shapes_of(tmp_path)


def test_a_folder_that_is_not_there_and_a_shape_that_is_not(tmp_path, mugs):
    nowhere = Folder(path=tmp_path / "nowhere")
    assert not nowhere.available(ROOT)
    for action in (nowhere.fetch, nowhere.shapes, lambda root: nowhere.load(root, "a")):
        with pytest.raises(DatasetNotFound, match=str(tmp_path / "nowhere")):
            action(ROOT)
    for name in ("mugs-mug_9", "../mugs-mug_1", "mugs/mug 1.off", ""):
        with pytest.raises(DatasetNotFound, match="no shape"):
            Folder(path=mugs).load(ROOT, name)


def test_a_broken_mesh_is_named_when_it_is_read(mugs):
    (mugs / "mugs" / "mug 1.off").write_text("OFF\n3 1 0\n0 0 0\n")
    with pytest.raises(MeshFormatError, match=r"mugs/mug 1\.off"):
        Folder(path=mugs).load(ROOT, "mugs-mug_1")


def test_the_stamp_changes_with_the_meshes_and_with_nothing_else(mugs):
    dataset = Folder(path=mugs)
    stamps = [dataset.stamp(ROOT), dataset.stamp(ROOT)]
    (mugs / "mugs" / "notes.txt").write_text("more")
    stamps.append(dataset.stamp(ROOT))
    assert len(set(stamps)) == 1
    write(mugs / "mugs" / "mug 2.obj", 7)
    stamps.append(dataset.stamp(ROOT))
    (mugs / "jugs" / "jug1.off").rename(mugs / "jugs" / "jug7.off")
    stamps.append(dataset.stamp(ROOT))
    (mugs / "jugs" / "jug7.off").unlink()
    stamps.append(dataset.stamp(ROOT))
    assert len(set(stamps)) == 4
    assert Folder(path=mugs / "nowhere").stamp(ROOT) == Folder(path=mugs / "no").stamp(ROOT)
