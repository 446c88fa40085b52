from __future__ import annotations

import struct

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.errors import MeshFormatError
from gipkg.formats.mesh_reading import read_mesh
from tests.surfaces.solids import sphere

QUADS = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n" + "".join(
    f"4 {face}\n" for face in ("0 3 2 1", "4 5 6 7", "0 1 5 4", "1 2 6 5", "2 3 7 6", "3 0 4 7")
)


@pytest.mark.parametrize("suffix", ["off", "obj", "ply", "stl", "glb"])
def test_formats_keep_the_surface(tmp_path, suffix):
    ball = sphere()
    path = tmp_path / f"ball.{suffix}"
    ball.export(path)
    mesh = read_mesh(path)
    assert len(mesh.faces) == len(ball.faces)
    assert mesh.volume == pytest.approx(ball.volume, rel=1e-5)
    assert mesh.metadata["file_name"] == path.name


def test_off_keeps_every_bit_and_the_order(tmp_path):
    ball = sphere()
    rows = [" ".join(map(repr, row)) for row in ball.vertices.tolist()]
    rows += [" ".join(map(str, [3, *face])) for face in ball.faces.tolist()]
    path = tmp_path / "ball.off"
    path.write_text("\n".join(["OFF", f"{len(ball.vertices)} {len(ball.faces)} 0", *rows]))
    mesh = read_mesh(path)
    assert np.array_equal(mesh.vertices, ball.vertices)
    assert np.array_equal(mesh.faces, ball.faces)


@pytest.mark.parametrize(
    "text",
    [
        QUADS,
        QUADS.replace("OFF\n", "OFF "),
        QUADS.replace("OFF\n", "OFF"),
        QUADS.replace("\n", "\r\n"),
        "# made by hand\n" + QUADS.replace("8 6 0\n", "8 6 0 # counts\n\n"),
        QUADS.replace("OFF", "COFF").replace("1 1 0\n", "1 1 0 255 0 0 255\n"),
        QUADS.replace("4 0 3 2 1", "4 0 3 2 1 3 200 10 10"),
    ],
    ids=["plain", "one line", "run together", "crlf", "comments", "vertex colours", "face colours"],
)
def test_ways_to_write_off(tmp_path, text):
    path = tmp_path / "cube.off"
    path.write_text(text, newline="")
    mesh = read_mesh(path)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(1)


@pytest.mark.parametrize("colours", [b"", struct.pack(">i", 0), struct.pack(">if", 1, 0.5)])
def test_binary_off(tmp_path, colours):
    vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)]
    faces = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
    data = b"OFF BINARY\n" + struct.pack(">3i", len(vertices), len(faces), 0)
    data += b"".join(struct.pack(">3f", *vertex) for vertex in vertices)
    for face in faces:
        data += struct.pack(f">{len(face) + 1}i", len(face), *face) + colours
    path = tmp_path / "pyramid.off"
    path.write_bytes(data)
    mesh = read_mesh(path)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(1 / 3)


def test_concave_polygon_is_triangulated_inside(tmp_path):
    corners = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (2, 1), (1, 1), (1, 3), (0, 3)]
    lines = [f"{x} {y} 0" for x, y in corners]
    path = tmp_path / "u.off"
    path.write_text("\n".join(["OFF", "9 1 0", *lines, "9 " + " ".join(map(str, range(9)))]))
    mesh = read_mesh(path)
    signed = mesh.area_faces * mesh.face_normals[:, 2]
    assert signed.sum() == pytest.approx(4 * 3 - 2 * 2)
    assert signed.min() > 0.05


@pytest.mark.parametrize("wild", ["nan", "inf"])
def test_polygons_at_no_place_are_named(tmp_path, wild):
    path = tmp_path / "wild.off"
    path.write_text(QUADS.replace("1 1 0\n", f"1 {wild} 0\n", 1))
    with pytest.raises(MeshFormatError, match="not finite"):
        read_mesh(path)


@pytest.mark.parametrize("wild", ["1e308", "1e-310"])
def test_polygons_in_places_without_measure(tmp_path, wild):
    """No triangulation is better than another there, and each is still one."""
    path = tmp_path / "wild.off"
    path.write_text(QUADS.replace("1 1 0\n", f"1 {wild} 0\n", 1))
    mesh = read_mesh(path)
    assert len(mesh.faces) == 12
    assert (np.bincount(mesh.edges_unique_inverse) == 2).all()


@pytest.mark.parametrize(
    ("name", "content", "fault"),
    [
        ("a.off", b"", "empty"),
        ("a.off", b"PLY\n1 1 1", "header of an OFF file"),
        ("a.off", b"OFF\n", "counts is missing"),
        ("a.off", b"4OFF\n1 1 0\n0 0 0 0\n3 0 0 0", "three dimensions"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "the file has 3"),
        ("a.off", b"OFF\n9999999999 1 0\n0 0 0\n", "the file has 1"),
        ("a.off", b"OFF\n-1 1 0\n0 0 0\n", "asks for"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2", "fewer than three coordinates"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2", "not readable as"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3", "does not exist"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "of 3 corners names 2"),
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2", "not finite"),
        ("a.off", b"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces"),
        ("a.off", b"OFF BINARY\n\0\0\0\1", "before the counts"),
        ("a.off", b"OFF\n1 1 0\n0 0 0\n3 0 0 99999999999999999999", "too big"),
        (
            "a.off",
            b"OFF BINARY\n" + struct.pack(">3i3f3i", 1, 1, 0, 0, 0, 0, 1, 7, 0),
            "does not exist",
        ),
        ("a.off", b"OFF BINARY\n" + struct.pack(">3i", 1, 1, 0) + bytes(24), "where the file ends"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces"),
        ("a.stl", b"solid nothing\nendsolid nothing\n", "no faces"),
        ("a.ply", b"ply\nformat ascii 1.0\n", "not readable"),
        ("a.glb", b"glTF", "not readable"),
        ("a.png", b"\x89PNG", "suffix"),
        ("a", b"OFF", "suffix"),
    ],
)
def test_faults_of_files_are_named(tmp_path, name, content, fault):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(MeshFormatError, match=fault) as caught:
        read_mesh(path)
    assert str(path) in str(caught.value)


def test_missing_file_folder_and_point_cloud(tmp_path):
    with pytest.raises(MeshFormatError, match="no such file"):
        read_mesh(tmp_path / "missing.off")
    with pytest.raises(MeshFormatError, match="a folder"):
        read_mesh(tmp_path)
    cloud = tmp_path / "cloud.ply"
    trimesh.PointCloud(sphere().vertices).export(cloud)
    with pytest.raises(MeshFormatError):
        read_mesh(cloud)


def test_scenes_are_concatenated(tmp_path):
    scene = trimesh.Scene()
    for x in (0.0, 5.0):
        scene.add_geometry(
            sphere(1), transform=trimesh.transformations.translation_matrix((x, 0, 0))
        )
    path = tmp_path / "two.glb"
    scene.export(path)
    mesh = read_mesh(path)
    assert len(mesh.faces) == 2 * len(sphere(1).faces)
    assert mesh.extents[0] == pytest.approx(7, rel=0.05)


BINARY = b"OFF BINARY\n" + struct.pack(">3i9f4i", 3, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2)


@settings(max_examples=150)
@given(st.sampled_from([QUADS.encode(), BINARY]), st.data())
def test_damaged_off_is_a_mesh_or_a_named_error(tmp_path_factory, whole, data):
    damaged = bytearray(whole[: data.draw(st.integers(0, len(whole)))])
    for _ in range(data.draw(st.integers(0, 3))):
        if damaged:
            damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("off", numbered=True) / "damaged.off"
    path.write_bytes(damaged)
    try:
        mesh = read_mesh(path)
    except MeshFormatError:
        return
    assert mesh.faces.max() < len(mesh.vertices)
    assert np.isfinite(mesh.vertices).all()
