"""From a mesh to a mesh by the commands of the stages; their figures are the library's."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
import trimesh

import gipkg
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.formats.images import read_image
from gipkg.formats.maps import read_map, write_map
from gipkg.formats.mesh_reading import read_mesh
from tests.cli.commands import records, run, run_well


@pytest.mark.parametrize(
    ("mesh_format", "map_format", "image_format"),
    [("ply", "npz", "npy"), ("off", "ply", "tiff"), ("stl", "npz", "png"), ("glb", "ply", "npy")],
)
def test_there_and_back(
    egg: trimesh.Trimesh, tmp_path: Path, mesh_format: str, map_format: str, image_format: str
) -> None:
    opened = trimesh.Trimesh(egg.vertices, egg.faces[1:], process=False)
    opened.export(tmp_path / "egg.obj")
    for command, source, *options in (
        ("prepare", "egg.obj", "--format", mesh_format),
        ("parametrize", f"prepare/egg.{mesh_format}", "--format", map_format),
        ("image", f"parametrize/egg.{map_format}", "--format", image_format, "--size", "48"),
        ("reconstruct", f"image/egg.{image_format}"),
    ):
        run_well(command, tmp_path / source, "-o", tmp_path / command, *options)
    again = read_mesh(tmp_path / "reconstruct" / "egg.ply")
    assert again.is_watertight
    assert again.euler_number == 2
    assert again.volume == pytest.approx(egg.volume, rel=0.02)
    assert surface_distance(egg, again, samples=2000).hausdorff < 0.02


def test_the_repair_before_a_map_takes_parameters(egg: trimesh.Trimesh, tmp_path: Path) -> None:
    trimesh.Trimesh(egg.vertices, egg.faces[40:], process=False).export(tmp_path / "open.off")
    options = ("-p", "prepare.method=repair", "-p", "prepare.largest_hole=0.0001")
    for command in ("parametrize", "image", "describe"):
        target = tmp_path / command
        assert run(command, tmp_path / "open.off", "-o", target, *options).exit_code == 1
    assert run("distort", tmp_path / "open.off", *options).exit_code == 1
    (record,) = records(run_well("distort", tmp_path / "open.off", "--json"))
    assert record["prepared"]


def test_a_mesh_that_needs_no_repair_is_written_as_it_is(
    mesh_file: Path, egg: trimesh.Trimesh, tmp_path: Path
) -> None:
    (record,) = records(run_well("prepare", mesh_file, "-o", tmp_path / "closed.off", "--json"))
    closed = read_mesh(tmp_path / "closed.off")
    assert record["steps"] == []
    np.testing.assert_array_equal(closed.faces, egg.faces)
    np.testing.assert_array_equal(closed.vertices, read_mesh(mesh_file).vertices)


def test_prepare_reports_what_the_library_reports(egg: trimesh.Trimesh, tmp_path: Path) -> None:
    trimesh.Trimesh(egg.vertices, egg.faces[40:], process=False).export(tmp_path / "open.stl")
    path = tmp_path / "open.stl"
    (record,) = records(run_well("prepare", path, "-o", tmp_path / "closed", "--json"))
    expected = gipkg.prepare(path).report.as_dict()
    assert {key: record[key] for key in expected} == expected
    assert record["after"]["holes"] == 0
    options = ("-p", "largest_hole=0.0001", "-p", "method=repair")
    refused = run("prepare", path, "-o", tmp_path / "strict", *options)
    assert refused.exit_code == 1
    assert "hole" in refused.stderr
    assert not (tmp_path / "strict").exists()


def test_the_map_is_the_librarys(mesh_file: Path, tmp_path: Path) -> None:
    run_well("parametrize", mesh_file, "-o", tmp_path / "a.npz", "-m", "conformal")
    known = gipkg.parametrize(read_mesh(mesh_file), "conformal")
    np.testing.assert_array_equal(read_map(tmp_path / "a.npz").sphere, known.sphere)


def test_parameters_reach_the_method(mesh_file: Path, tmp_path: Path) -> None:
    option = ("-p", "shape_weight=1e-2")
    run_well("parametrize", mesh_file, "-o", tmp_path / "a.npz", *option)
    known = gipkg.parametrize(read_mesh(mesh_file), shape_weight=1e-2)
    np.testing.assert_array_equal(read_map(tmp_path / "a.npz").sphere, known.sphere)


def test_distort_gives_the_librarys_figures(mesh_file: Path, tmp_path: Path) -> None:
    run_well("parametrize", mesh_file, "-o", tmp_path / "a.ply")
    of_map, of_mesh = records(run_well("distort", tmp_path / "a.ply", mesh_file, "--json"))
    measured = gipkg.distortion(gipkg.parametrize(read_mesh(mesh_file)))
    expected = {
        field.name: getattr(measured, field.name)
        for field in fields(measured)
        if np.isscalar(getattr(measured, field.name))
    }
    assert len(expected) == 6
    assert {key: of_map[key] for key in expected} == expected
    assert {key: of_mesh[key] for key in expected} == expected
    assert of_mesh["prepared"] == []


def test_a_map_of_a_mesh_with_flat_faces_has_no_distortion(mesh_file: Path, tmp_path: Path) -> None:
    known = gipkg.parametrize(read_mesh(mesh_file))
    flat = trimesh.Trimesh(known.mesh.vertices * [1, 0, 0], known.mesh.faces, process=False)
    write_map(tmp_path / "flat.npz", gipkg.SphericalMap(flat, known.sphere))
    result = run("distort", tmp_path / "flat.npz", "--json")
    assert result.exit_code == 1
    assert "flat.npz: faces of its mesh have no area" in result.stderr


def test_describe_gives_the_librarys_channels(mesh_file: Path, tmp_path: Path) -> None:
    arguments = ("describe", mesh_file, "-o", tmp_path / "a.npy", "-d", "hks", "-p", "times=3")
    (record,) = records(run_well(*arguments, "--json"))
    known = gipkg.describe(read_mesh(mesh_file), "hks", times=3)
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), known)
    assert len(record["channels"]) == 3


def test_images_of_descriptors_have_their_channels_in_order(
    mesh_file: Path, tmp_path: Path
) -> None:
    run_well("parametrize", mesh_file, "-o", tmp_path / "a.npz")
    (record,) = records(
        run_well(
            *("image", tmp_path / "a.npz", "-o", tmp_path / "a.npy", "--size", "9", "--json"),
            *("-d", "curvature", "-d", "hks", "-p", "hks.times=2", "-p", "curvature.quantity=mean"),
            *("--sampling", "authors"),
        )
    )
    known = read_map(tmp_path / "a.npz")
    channels = np.hstack(
        [
            gipkg.describe(known.mesh, "curvature", quantity="mean"),
            gipkg.describe(known.mesh, "hks", times=2),
        ]
    )
    expected = gipkg.geometry_image(known, channels, 9, sampling="authors")
    np.testing.assert_array_equal(read_image(tmp_path / "a.npy"), expected)
    assert record["shape"] == [3, 9, 9]
    assert record["channels"][0] == "log-mean-curvature"


def test_an_image_of_a_mesh_knows_what_was_added_to_close_it(
    egg: trimesh.Trimesh, tmp_path: Path
) -> None:
    trimesh.Trimesh(egg.vertices, egg.faces[60:], process=False).export(tmp_path / "open.off")
    shown = ("-d", "topological-mask", "--size", "16")
    options = ("-p", "prepare.method=repair", "-p", "prepare.largest_loss=1")
    run_well("image", tmp_path / "open.off", "-o", tmp_path / "a.npy", *shown, *options)
    assert read_image(tmp_path / "a.npy").min() < 0.01
    run_well("parametrize", tmp_path / "open.off", "-o", tmp_path / "a.npz", *options)
    run_well("image", tmp_path / "a.npz", "-o", tmp_path / "b.npy", *shown)
    assert read_image(tmp_path / "b.npy").min() > 0.99


def test_an_image_that_shows_no_positions_is_no_mesh(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.zeros((2, 5, 5)))
    result = run("reconstruct", tmp_path / "a.npy", "-o", tmp_path / "a.ply")
    assert result.exit_code == 1
    assert "2 channels are no positions" in result.stderr
    assert not (tmp_path / "a.ply").exists()
