"""Figure 4's flow solves its equation and points to where areas are too large."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from gipkg.api import SphericalMap
from gipkg.descriptors.laplacian import cotangent_laplacian, edge_lengths
from gipkg.images.octahedron import square_to_sphere
from gipkg.reporting.colours import category
from gipkg.reporting.figures import figure4
from gipkg.reporting.figures.layout import write_png


@pytest.fixture(scope="module")
def explanation(ellipsoid_map: SphericalMap) -> figure4.Explanation:
    return figure4.explain(ellipsoid_map, ellipsoid_map)


def test_the_potential_solves_poissons_equation(
    ellipsoid_map: SphericalMap, explanation: figure4.Explanation
) -> None:
    mesh, flow = ellipsoid_map.mesh, explanation.flow
    stiffness = cotangent_laplacian(mesh, edge_lengths(mesh)).toarray()
    areas = np.bincount(mesh.faces.ravel(), np.repeat(mesh.area_faces / 3, 3))
    areas *= 4 * np.pi / mesh.area
    assert flow.distortion @ areas == pytest.approx(0, abs=1e-9)
    dense = np.linalg.lstsq(stiffness, flow.distortion * areas, rcond=None)[0]
    assert flow.potential == pytest.approx(dense - dense.mean(), abs=1e-3)
    assert flow.potential.mean() == pytest.approx(0, abs=1e-12)


def test_on_a_sphere_the_first_harmonic_is_halved() -> None:
    # A map that weighs areas by 1 + a z has δh = a z, and -∇² z = 2 z on the unit sphere.
    sphere = trimesh.creation.icosphere(subdivisions=4)
    z, weight = sphere.vertices[:, 2], 0.1
    # Caps keep their area: (1 - t) + a (1 - t²) / 2 = 1 - t', with both from z to the pole.
    height = 1 - ((1 - z) + weight * (1 - z**2) / 2)
    ring = np.sqrt((1 - height**2).clip(0) / np.maximum(1 - z**2, 1e-12))
    mapped = np.column_stack([sphere.vertices[:, :2] * ring[:, None], height])
    flow = figure4.flow(SphericalMap(sphere, mapped / np.linalg.norm(mapped, axis=1)[:, None]))
    assert flow.distortion == pytest.approx(weight * z, abs=0.01)
    assert flow.potential == pytest.approx(weight * z / 2, abs=2e-3)
    tangent = np.array([0, 0, 1.0]) - z[:, None] * sphere.vertices
    assert flow.gradient == pytest.approx(weight / 2 * tangent, abs=4e-3)


def test_vertices_go_to_what_is_too_large(explanation: figure4.Explanation) -> None:
    # The sphere has too much of the ends of a long ellipsoid.
    heights = explanation.unfolded.mesh.vertices[:, 2]
    upper = (heights > 0.5) & (heights < 3.8)
    assert (explanation.flow.gradient[upper, 2] > 0).all()
    assert (explanation.flow.distortion[heights > 3.5] > 0).all()


def test_the_rows_say_where_each_vertex_is_in_the_image(explanation: figure4.Explanation) -> None:
    rows = explanation.rows()
    assert [row.vertex for row in rows] == list(range(len(rows)))
    places = square_to_sphere([(row.u, row.v) for row in rows])
    assert places == pytest.approx(explanation.unfolded.sphere, abs=1e-7)
    gradients = [(row.gradient_x, row.gradient_y, row.gradient_z) for row in rows]
    assert np.array_equal(gradients, explanation.flow.gradient)
    assert np.array_equal([row.potential for row in rows], explanation.flow.potential)


def test_each_side_of_the_image_is_one_of_the_four_cut_edges(
    explanation: figure4.Explanation, tmp_path: Path
) -> None:
    write_png(tmp_path / "figure.png", figure4.draw(explanation, size=24))
    drawn = np.asarray(Image.open(tmp_path / "figure.png").convert("RGB")).astype(int)
    height, width = drawn.shape[0] // 2, drawn.shape[1] // 3
    image = drawn[height:, 2 * width :]
    middles = []
    for number in range(4):
        is_edge = np.abs(image - 255 * category(number)).max(axis=2) < 8
        assert is_edge.sum() > 1000
        middles.append(np.argwhere(is_edge).mean(axis=0) / image.shape[:2])
    right, top, left, bottom = middles
    assert left[1] < 0.1 < 0.9 < right[1]
    assert top[0] < 0.2 < 0.8 < bottom[0]
    # On the sphere and on the octahedron the same four edges are seen.
    for column in range(2):
        solid = drawn[height:, column * width : (column + 1) * width]
        hues = solid - solid.mean(axis=2, keepdims=True)
        for number in range(4):
            hue = category(number) - category(number).mean()
            length = np.linalg.norm(hues, axis=2)
            alike = hues @ hue > 0.98 * np.linalg.norm(hue) * length
            assert (alike & (length > 40)).sum() > 300
