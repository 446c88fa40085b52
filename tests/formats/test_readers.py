"""OBJ, PLY, STL and GLB as others write them, and as they are written to do harm."""

from __future__ import annotations

import json
import struct
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
import trimesh

from gipkg.errors import MeshFormatError
from gipkg.formats import limits, mesh_reading
from gipkg.formats.mesh_reading import read_mesh
from tests.surfaces.solids import sphere

CUBE = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7), (1, 7, 5)]
"""Five squares and two triangles."""

PLY_HEAD = (
    "ply\nformat {form} 1.0\ncomment by hand\nelement material 1\nproperty uchar red\n"
    "element vertex 8\nproperty float x\nproperty double y\nproperty float z\n"
    "property list uchar float weights\nelement face 7\nproperty int group\n"
    "property list uchar int vertex_indices\nelement edge 0\nproperty int vertex1\nend_header\n"
)


def ply(form: str) -> bytes:
    head = PLY_HEAD.format(form=form).encode()
    if form == "ascii":
        rows = [[7], *([*v, 1, 0.5] for v in CUBE), *([0, len(s), *s] for s in SIDES)]
        return head + "\n".join(" ".join(map(str, row)) for row in rows).encode()
    order = "<" if "little" in form else ">"
    body = struct.pack("B", 7)
    for x, y, z in CUBE:
        body += struct.pack(f"{order}fdfBf", x, y, z, 1, 0.5)
    for side in SIDES:
        body += struct.pack(f"{order}iB{len(side)}i", 0, len(side), *side)
    return head + body


OBJ = "\n".join(
    [
        "mtllib ../../../etc/passwd",
        *(f"v {x} {y} {z} 1.0 # corner" for x, y, z in CUBE),
        "vt 0 0\nvn 0 0 1\nusemtl red\ng one\ns off",
        *("f " + " ".join(f"{k + 1}/1/1" for k in side) for side in SIDES[:2]),
        *("f " + " \\\n".join(f"{k + 1}//1" for k in side) for side in SIDES[2:4]),
        *("f " + " ".join(f"{k - 8}" for k in side) for side in SIDES[4:]),
    ]
)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        *((f"{form}.ply", ply(form)) for form in ("ascii", "binary_little_endian")),
        ("big.ply", ply("binary_big_endian")),
        ("dos.ply", ply("ascii").replace(b"\n", b"\r\n")),
        ("all.obj", OBJ.encode()),
        ("dos.OBJ", OBJ.replace("\n", "\r\n").encode()),
        ("mac.obj", OBJ.replace(" \\\n", " ").replace("\n", "\r").encode()),
    ],
)
def test_a_cube_of_squares_and_triangles(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    mesh = read_mesh(tmp_path / name)
    np.testing.assert_array_equal(mesh.vertices, CUBE)
    assert len(mesh.faces) == 12
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(1)


@pytest.mark.parametrize("form", ["stl", "stl_ascii"])
def test_both_kinds_of_stl(tmp_path: Path, form: str) -> None:
    ball = sphere()
    (tmp_path / "a.stl").write_bytes(
        content if isinstance(content := ball.export(file_type=form), bytes) else content.encode()
    )
    mesh = read_mesh(tmp_path / "a.stl")
    np.testing.assert_allclose(mesh.triangles, ball.triangles, atol=1e-6)


def test_the_places_of_a_scene_are_those_of_trimesh(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    scene = trimesh.Scene()
    box = trimesh.creation.box()
    parent = None
    for number in range(4):
        matrix = trimesh.transformations.random_rotation_matrix(rng.random(3))
        matrix[:3] *= rng.uniform(0.5, 2)
        matrix[:3, 3] = rng.normal(size=3)
        name = f"part{number}"
        scene.add_geometry(box, node_name=name, parent_node_name=parent, transform=matrix)
        parent = name if number % 2 else parent
    scene.export(tmp_path / "a.glb")
    ours, theirs = read_mesh(tmp_path / "a.glb"), scene.to_geometry()
    assert len(ours.faces) == 4 * len(box.faces)
    key = [np.sort(np.round(one.triangles_center, 5), axis=0) for one in (ours, theirs)]
    np.testing.assert_allclose(key[0], key[1], atol=2e-5)
    assert ours.volume == pytest.approx(theirs.volume, rel=1e-5)


def test_rotation_translation_and_scale_make_a_matrix(tmp_path: Path) -> None:
    turn = trimesh.transformations.random_quaternion(np.random.default_rng(1).random(3))
    size, place = np.array([0.5, 2, 3]), np.array([1, -2, 0.5])
    node = {"rotation": np.roll(turn, -1), "translation": place, "scale": size}
    path = scene(tmp_path, nodes=[{"mesh": 0, **{k: v.tolist() for k, v in node.items()}}])
    matrix = trimesh.transformations.quaternion_matrix(turn)[:3, :3]
    expected = TRIANGLE.astype(float) * size @ matrix.T + place
    np.testing.assert_allclose(read_mesh(path).vertices, expected, atol=1e-12)


@pytest.mark.parametrize("size", [(-1, 1, 1), (1, -2, 1), (-1, -1, -1), (1e-90, 1e-90, -1e-150)])
def test_a_mirrored_part_faces_the_same_side(tmp_path: Path, size: tuple[float, ...]) -> None:
    inner = {"mesh": 0, "scale": size}
    nodes = [{"children": [1]}, inner, {"children": [3], "scale": [1, 1, -1]}, inner]
    mesh = read_mesh(scene(tmp_path, nodes=nodes, scenes=[{"nodes": [0, 2]}]))
    np.testing.assert_array_equal(mesh.faces, [[2, 1, 0], [3, 4, 5]])


@pytest.mark.parametrize("index", [-1, 3])
def test_an_index_outside_the_vertices_is_refused(tmp_path: Path, index: int) -> None:
    points = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    path = scene(
        tmp_path,
        TRIANGLE.tobytes() + np.array([0, 1, index], "<i2").tobytes(),
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36}],
        accessors=[points, {"bufferView": 1, "componentType": 5122, "count": 3, "type": "SCALAR"}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    )
    with pytest.raises(MeshFormatError, match="names a vertex that does not exist"):
        read_mesh(path)


@pytest.mark.parametrize(("mode", "order"), [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])])
def test_strips_and_fans_keep_their_side(tmp_path: Path, mode: int, order: list[int]) -> None:
    square = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "<f4")[order]
    accessor = {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}
    strip = {"attributes": {"POSITION": 0}, "mode": mode}
    path = scene(
        tmp_path,
        square.tobytes(),
        bufferViews=[{"buffer": 0, "byteLength": 48}],
        accessors=[accessor],
        meshes=[{"primitives": [strip, {**strip, "mode": 1}]}],
    )
    mesh = read_mesh(path)
    np.testing.assert_allclose(mesh.face_normals, [[0, 0, 1]] * 2)
    assert mesh.area == pytest.approx(1)


TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")


def scene(folder: Path, binary: bytes = TRIANGLE.tobytes(), **changes: object) -> Path:
    """Write a scene of one triangle, some of it changed."""
    description = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        **changes,
    }
    text = json.dumps(description).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    (folder / "a.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
    return folder / "a.glb"


MANY = {"bufferView": 0, "componentType": 5126, "count": 10**9, "type": "VEC3"}


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"accessors": [MANY]}, "buffer"),
        ({"accessors": [{k: v for k, v in MANY.items() if k != "bufferView"}]}, "sparse"),
        (
            {"accessors": [MANY], "bufferViews": [{"buffer": 0, "byteStride": 0}]},
            "lie on each other",
        ),
        ({"nodes": [{"mesh": 0, "children": [0]}]}, "there twice"),
        ({"buffers": [{"uri": "/etc/passwd"}]}, "in another file"),
        ({"nodes": [{"mesh": "none"}]}, "not that of a scene"),
        ({"scenes": []}, "not that of a scene"),
    ],
)
def test_a_scene_cannot_ask_for_more_than_it_holds(
    tmp_path: Path, changes: dict[str, object], fault: str
) -> None:
    with pytest.raises(MeshFormatError, match=rf"a\.glb: not readable as \.glb: .*{fault}"):
        read_mesh(scene(tmp_path, **changes))


def test_a_part_that_is_shown_very_often(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MOST_FACES", 1000)
    nodes = [{"mesh": 0}] * 1001
    path = scene(tmp_path, nodes=nodes, scenes=[{"nodes": list(range(1001))}])
    with pytest.raises(MeshFormatError, match="1001 faces, more than 3000 and 1000; decimate"):
        read_mesh(path)


HEAD = "ply\nformat {} 1.0\nelement vertex {}\n" + "".join(
    f"property float {axis}\n" for axis in "xyz"
)
FACES = "element face {}\nproperty list uint int vertex_indices\nend_header\n"


@pytest.mark.parametrize(
    ("name", "content", "fault"),
    [
        ("a.ply", HEAD.format("binary_little_endian", 10**12) + FACES.format(1), "decimate it"),
        ("a.ply", HEAD.format("binary_little_endian", 10**6) + FACES.format(1), "it ends before"),
        (
            "a.ply",
            HEAD.format("binary_little_endian", 0) + FACES.format(1) + "\x7f\x7f\x7f\x7f",
            "none that the file holds",
        ),
        ("a.ply", HEAD.format("ascii", 1) + FACES.format(0) + "0 0 zero", "else than numbers"),
        ("a.ply", HEAD.format("ascii", 1) + FACES.format(1) + "0 0 0 1e9 0", "none that the file"),
        ("a.ply", HEAD.format("ascii", 1) + FACES.format(1) + "0 0 0 3 0 0 7", "does not exist"),
        ("a.ply", HEAD.format("ascii", -1) + FACES.format(1), "does not say what"),
        ("a.ply", HEAD.format("ascii", 1) + "end_header\n0 0 0", "no faces"),
        ("a.ply", "ply\nformat ascii 1.0\nelement face 5\nend_header\n", "does not say what"),
        ("a.obj", "v 0 0 0\nf 0 1 2", "count from 1"),
        ("a.obj", "v 0 0\n", "fewer than three"),
        ("a.obj", "v 0 0 0\nf 1 1 -2", "does not exist"),
        ("a.obj", "v 0 0 0\nf 1 x 1", "invalid literal"),
        ("a.stl", "solid a\nvertex 0 0 0\nendsolid", "do not make triangles"),
        ("a.stl", "solid a\nvertex 0 0 0\n", "ends before endsolid"),
        ("a.stl", "\0" * 80 + "\x7f\x7f\x7f\x7f", "asks for 2139062143 triangles, the file has 0"),
    ],
)
def test_faults_are_named(tmp_path: Path, name: str, content: str, fault: str) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(MeshFormatError, match=rf"{name}: not readable as .*{fault}"):
        read_mesh(tmp_path / name)


def test_a_file_that_is_too_large_is_not_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mesh_reading, "LARGEST_FILE", 1000)
    (tmp_path / "a.obj").write_bytes(bytes(1001))
    with pytest.raises(MeshFormatError, match="1001 bytes, more than 1000; decimate"):
        read_mesh(tmp_path / "a.obj")


MIXED = (
    HEAD.format("binary_little_endian", 3) + FACES.format(50_000).replace("uint int", "uchar uchar")
).encode()


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("lines.obj", b"\n" * 250_000),
        ("vertices.obj", b"v 0 0 0\n" * 25_000),
        ("faces.obj", b"v 0 0 0\n" + b"f 1\n" * 50_000),
        ("materials.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n" * 5_000),
        ("rows.off", b"OFF\n1 50000 0\n0 0 0\n" + b"0\n" * 50_000),
        ("solids.stl", b"solid a endsolid a\n" * 50_000),
        ("mixed.ply", MIXED + TRIANGLE.tobytes() + b"\3\0\1\2\0" * 25_000),
        (
            "text.ply",
            (HEAD.format("ascii", 75_000) + FACES.format(0)).encode() + b"0 0 0\n" * 75_000,
        ),
    ],
)
def test_memory_is_in_proportion_to_the_file(tmp_path: Path, name: str, content: bytes) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    tracemalloc.start()
    try:
        read_mesh(path)
    except MeshFormatError:
        pass
    finally:
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    # Where every byte is a face, a number of 64 bits in a few places comes of it.
    assert peak < 40 * len(content)


def test_other_formats_are_not_guessed(tmp_path: Path) -> None:
    """Those that trimesh would unpack or look up elsewhere, above all."""
    for suffix in (".zip", ".gz", ".gltf", ".3mf", ".dae"):
        (tmp_path / f"a{suffix}").write_bytes(b"PK")
        with pytest.raises(MeshFormatError, match=r"none of \.ply, \.off"):
            read_mesh(tmp_path / f"a{suffix}")
