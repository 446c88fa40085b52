"""The page's arithmetic gives the images that the library gives."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

import gipkg
from gipkg.api import SphericalMap
from gipkg.images.octahedron import pixel_directions
from gipkg.reporting.octahedron import edges
from tests.workflow.workdir import REPOSITORY

MODULE = REPOSITORY / "gipkg/reporting/page/assets/geometry.js"


def javascript(expression: str, tmp_path: Path, **values: Any) -> np.ndarray:
    """Evaluate an expression of the module `G` and of some values, and return its numbers."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node to run the page's script with")
    script = tmp_path / "script.js"
    script.write_text(
        f"const G = require({json.dumps(str(MODULE))});\n"
        f"const {{ {', '.join(values)} }} = {json.dumps(values)};\n"
        f"process.stdout.write(JSON.stringify(Array.from({expression})));\n"
    )
    done = subprocess.run([node, script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout))


@pytest.fixture(scope="module")
def spherical_map(hand: trimesh.Trimesh) -> SphericalMap:
    return gipkg.parametrize(hand)


@pytest.mark.parametrize("size", [3, 8, 33])
def test_pixels_lie_where_the_library_puts_them(size: int, tmp_path: Path) -> None:
    directions = javascript("G.pixelDirections(size)", tmp_path, size=size)
    assert directions.reshape(size, size, 3) == pytest.approx(pixel_directions(size), abs=1e-15)


def test_a_cut_brings_a_place_to_the_pole(tmp_path: Path) -> None:
    longitude, latitude, turn = 0.7, -0.4, 2.1
    matrix = javascript("G.cut(a, b, c)", tmp_path, a=longitude, b=latitude, c=turn).reshape(3, 3)
    assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-15)
    place = [
        np.cos(latitude) * np.cos(longitude),
        np.cos(latitude) * np.sin(longitude),
        np.sin(latitude),
    ]
    assert matrix @ place == pytest.approx([0, 0, 1], abs=1e-15)
    beyond = javascript("G.cut(a, b, c)", tmp_path, a=longitude, b=latitude, c=turn + 0.5)
    step = beyond.reshape(3, 3) @ matrix.T
    assert step == pytest.approx(Rotation.from_rotvec([0, 0, 0.5]).as_matrix(), abs=1e-15)


def test_images_are_those_of_the_library(spherical_map: SphericalMap, tmp_path: Path) -> None:
    size, angles = 24, {"a": -2.0, "b": 0.3, "c": 1.0}
    mesh = spherical_map.mesh
    image = javascript(
        "G.interpolate(G.locate(sphere, faces, G.neighbours(faces),"
        " G.turnedBack(G.cut(a, b, c), G.pixelDirections(size))), faces, values, 3)",
        tmp_path,
        sphere=spherical_map.sphere.ravel().tolist(),
        faces=mesh.faces.ravel().tolist(),
        values=mesh.vertices.ravel().tolist(),
        size=size,
        **angles,
    )
    matrix = javascript("G.cut(a, b, c)", tmp_path, **angles).reshape(3, 3)
    cut = Rotation.from_matrix(matrix)
    expected = gipkg.geometry_image(spherical_map, np.asarray(mesh.vertices), size, cut)
    assert np.moveaxis(image.reshape(size, size, 3), -1, 0) == pytest.approx(expected, abs=1e-9)


def test_a_folded_map_ends_all_the_same(spherical_map: SphericalMap, tmp_path: Path) -> None:
    mesh = spherical_map.mesh
    mirrored = spherical_map.sphere * [1, 1, -1]
    values = javascript(
        "G.interpolate(G.locate(sphere, faces, G.neighbours(faces), G.pixelDirections(5)),"
        " faces, values, 1)",
        tmp_path,
        sphere=mirrored.ravel().tolist(),
        faces=mesh.faces.ravel().tolist(),
        values=np.ones(len(mesh.vertices)).tolist(),
    )
    assert len(values) == 25
    assert np.isfinite(values).all()


def test_the_cut_runs_along_the_edges_that_are_opened(tmp_path: Path) -> None:
    paths = javascript("G.cutEdges(3).flatMap((path) => Array.from(path))", tmp_path)
    opened = [edge for edge in edges() if edge.cut]
    for path, edge in zip(paths.reshape(4, 3, 3), opened, strict=True):
        assert path[0] == pytest.approx(edge.start)
        assert path[2] == pytest.approx(edge.end)
        assert np.linalg.norm(path, axis=1) == pytest.approx(1)
