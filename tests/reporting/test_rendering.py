"""Pictures show what they are given: where, in which colour, and the same every time."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from gipkg.reporting import rendering
from gipkg.reporting.cameras import camera_on, principal_camera, standing_camera
from gipkg.reporting.rendering import Arrows, Lines, Surface, render, render_mesh

RED, GREEN, BLUE = np.eye(3)
SPHERE = trimesh.creation.icosphere(subdivisions=3)
FRONT = camera_on(SPHERE.vertices, towards_eye=[0, 0, 1], up=[0, 1, 0], margin=0.1)


def drawn(picture: np.ndarray) -> np.ndarray:
    """Return where a picture is not background."""
    return (picture < 250).any(axis=2)


def middle(mask: np.ndarray) -> np.ndarray:
    """Return the mean row and column of a mask, in shares of the picture."""
    return np.argwhere(mask).mean(axis=0) / mask.shape


def dominated_by(picture: np.ndarray, channel: int) -> np.ndarray:
    """Return where one channel is far above the two others."""
    others = np.delete(picture.astype(int), channel, axis=2).max(axis=2)
    return picture[..., channel] - others > 60


def test_a_sphere_is_a_disc_of_the_size_that_the_camera_says() -> None:
    picture = render_mesh(SPHERE, camera=FRONT, size=(300, 200))
    assert picture.shape == (200, 300, 3)
    assert picture.dtype == np.uint8
    radius = 100 / FRONT.half_height
    assert np.count_nonzero(drawn(picture)) == pytest.approx(np.pi * radius**2, rel=0.02)
    assert middle(drawn(picture)) == pytest.approx([0.5, 0.5], abs=0.01)


@pytest.mark.parametrize("of", ["vertices", "faces"])
def test_colours_land_on_their_side(of: str) -> None:
    places = SPHERE.vertices if of == "vertices" else SPHERE.triangles_center
    colours = np.where(places[:, :1] > 0, RED, BLUE)
    picture = render_mesh(SPHERE, colours=colours, camera=FRONT, size=(200, 200))
    right, left = dominated_by(picture, 0), dominated_by(picture, 2)
    assert middle(right)[1] == pytest.approx(0.5 + 0.8 * 4 / (6 * np.pi), abs=0.02)
    assert middle(left)[1] == pytest.approx(0.5 - 0.8 * 4 / (6 * np.pi), abs=0.02)
    assert (right | left).sum() > 0.9 * drawn(picture).sum()


def test_what_is_up_is_on_top() -> None:
    colours = np.where(SPHERE.vertices[:, 1:2] > 0, GREEN, BLUE)
    picture = render_mesh(SPHERE, colours=colours, camera=FRONT, size=(200, 200))
    assert middle(dominated_by(picture, 1))[0] < 0.45 < 0.55 < middle(dominated_by(picture, 2))[0]


def test_pictures_are_bit_equal() -> None:
    first, second = (render_mesh(SPHERE, edges=True, size=(120, 120)) for _ in range(2))
    assert np.array_equal(first, second)


def test_edges_and_flat_faces_show() -> None:
    plain = render_mesh(SPHERE, camera=FRONT, size=(200, 200)).astype(int)
    edged = render_mesh(SPHERE, camera=FRONT, size=(200, 200), edges=True).astype(int)
    flat = render_mesh(SPHERE, camera=FRONT, size=(200, 200), smooth=False).astype(int)
    assert edged[drawn(plain)].mean() < plain[drawn(plain)].mean() - 10
    assert 0.3 < np.abs(flat - plain)[drawn(plain)].mean() < 10


def test_lines_and_arrows_are_hidden_by_what_is_in_front() -> None:
    ends = np.array([[0.5, 0.0, 0.0], [-0.5, 0.0, 0.0]])
    before, behind = ends + np.array([0, -0.4, 1.2]), ends + np.array([0, 0.4, -1.2])
    feet = np.array([[0.3, 0.0, 1.2], [-0.3, 0.0, -1.2]])
    lines = [Lines([before], RED, 0.05), Lines([behind], GREEN, 0.05)]
    arrows = Arrows(feet, np.array([[0, 0.5, 0]] * 2), BLUE)

    alone = render([*lines, arrows], FRONT, (200, 200))
    unit = 100 / FRONT.half_height
    for channel, height in ((0, -0.4), (1, 0.4)):
        line = dominated_by(alone, channel)
        assert line.sum() == pytest.approx(0.1 * unit**2, rel=0.15)
        assert middle(line) == pytest.approx([0.5 - height * unit / 200, 0.5], abs=0.02)
    columns = np.flatnonzero(dominated_by(alone, 2).any(axis=0))
    assert np.ptp(columns) > 0.6 * unit

    hidden = render([Surface(SPHERE), *lines, arrows], FRONT, (200, 200))
    assert dominated_by(hidden, 0).sum() == pytest.approx(0.1 * unit**2, rel=0.15)
    assert not dominated_by(hidden, 1).any()
    rows, columns = np.nonzero(dominated_by(hidden, 2))
    assert columns.min() > 100
    assert np.ptp(rows) == pytest.approx(0.5 * unit, rel=0.1)


def test_what_stands_is_seen_standing_from_the_front_and_above() -> None:
    points = np.random.default_rng(0).normal(size=(50, 3)) * [4, 3, 1]
    camera = standing_camera(points)
    right, upward, forward = camera.axes
    assert upward[2] > 0.8
    assert right[2] == pytest.approx(0)
    assert forward[1] < -0.5 < 0.2 < forward[2]
    seen = (points - camera.centre) @ camera.axes.T
    assert np.abs(seen[:, :2]).max() < camera.half_height


def test_the_principal_camera_follows_the_surface() -> None:
    body = trimesh.creation.icosphere(subdivisions=3).vertices * [1, 2, 4]
    body += np.where(body[:, 2:] > 0, [0, 0, 0.3], 0) * body[:, 2:]
    turn = Rotation.from_rotvec([0.3, -1.1, 2.0])
    pictures = []
    for points in (body, 5 * turn.apply(body) + 7):
        mesh = trimesh.Trimesh(points, SPHERE.faces, process=False)
        pictures.append(drawn(render_mesh(mesh, size=(90, 180))))
    assert np.mean(pictures[0] != pictures[1]) < 0.01
    # The long end is below the middle of the body, and the picture is full from top to bottom.
    rows = np.flatnonzero(pictures[0].any(axis=1))
    assert rows[0] == pytest.approx(0.04 * 180, abs=2)
    assert rows[-1] == pytest.approx(0.96 * 180, abs=2)


def test_a_camera_frames_every_point() -> None:
    rng = np.random.default_rng(4)
    points = rng.standard_normal((50, 3)) * [3, 1, 1]
    for aspect in (0.5, 2.0):
        camera = principal_camera(points, aspect)
        right = np.cross(camera.up, camera.towards_eye)
        seen = (points - camera.centre) @ np.stack([right, camera.up]).T
        extent = np.abs(seen).max(axis=0) / (camera.half_height * np.array([aspect, 1]))
        assert extent.max() == pytest.approx(0.92)


def test_colours_of_another_mesh_are_refused() -> None:
    with pytest.raises(ValueError, match=r"colours are \(7, 3\).*\(642, 3\).*\(1280, 3\)"):
        render_mesh(SPHERE, colours=np.zeros((7, 3)))


def failure(setting: str, environment: Mapping[str, str]) -> str:
    """Return what a process says that draws under a setting and has to fail."""
    code = f"import sys, trimesh; from gipkg.reporting import rendering; {setting};"
    code += "rendering.render_mesh(trimesh.creation.icosphere())"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1  # and not a crash
    return done.stderr.splitlines()[-1]


def test_without_pyvista_the_way_out_is_named() -> None:
    message = failure("sys.modules['pyvista'] = None", {})
    assert "RenderingError" in message
    assert 'pip install "gipkg[figures]"' in message


@pytest.mark.skipif(sys.platform != "linux", reason="EGL and OSMesa are chosen on Linux")
def test_without_opengl_the_way_out_is_named() -> None:
    # VTK falls back to OSMesa where EGL does not work.
    message = failure(
        "rendering.find_library = lambda name: None",
        {"VTK_DEFAULT_OPENGL_WINDOW": "vtkOSOpenGLRenderWindow"},
    )
    assert "RenderingError" in message
    assert "apt-get install libegl1 libgl1-mesa-dri" in message


def test_importing_the_module_is_cheap() -> None:
    code = f"import sys, {rendering.__name__}; sys.exit('pyvista' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
