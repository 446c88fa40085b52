import numpy as np
import pytest

from gipkg.parametrizers.hierarchy.coarsening import coarsen
from gipkg.surfaces.edge_collapse import gather_ring, split
from gipkg.surfaces.halfedges import twins
from tests.support.shapes import icosphere, needle, urchin

MESHES = {"sphere": icosphere(2), "urchin": urchin(12, 3.0, 3), "needle": needle()}


@pytest.fixture(params=MESHES, scope="module")
def mesh(request: pytest.FixtureRequest):
    return MESHES[request.param]


def _areas(mesh) -> np.ndarray:
    return mesh.area_faces * 4 * np.pi / mesh.area


def test_it_ends_at_a_tetrahedron_that_carries_all_area(mesh) -> None:
    hierarchy = coarsen(mesh.vertices, mesh.faces, _areas(mesh))
    faces = hierarchy.origin.reshape(-1, 3)[hierarchy.present]
    assert faces.shape == (4, 3)
    assert len(np.unique(faces)) == 4
    edges = {(a, b) for face in faces for a, b in zip(face, np.roll(face, -1), strict=True)}
    assert len(edges) == 12
    assert all((b, a) in edges for a, b in edges)
    assert hierarchy.areas[hierarchy.present].sum() == pytest.approx(4 * np.pi, abs=1e-9)


def test_undoing_every_collapse_gives_the_mesh_back(mesh) -> None:
    areas = _areas(mesh)
    h = coarsen(mesh.vertices, mesh.faces, areas)
    ring, spokes = np.zeros((2, len(mesh.vertices)), np.int64)
    for i in range(len(h.vertices) - 1, -1, -1):
        split(h.twin, h.origin, h.outgoing, h.vertices[i], h.spokes[i])
        degree = gather_ring(h.twin, h.origin, h.outgoing[h.vertices[i]], ring, spokes)
        assert degree == h.offsets[i + 1] - h.offsets[i]
        h.areas[spokes[:degree] // 3] = h.star_areas[h.offsets[i] : h.offsets[i + 1]]
    np.testing.assert_array_equal(h.origin.reshape(-1, 3), mesh.faces)
    np.testing.assert_array_equal(h.twin, twins(np.asarray(mesh.faces)))
    np.testing.assert_array_equal(h.areas, areas)


def test_no_level_removes_two_neighbours(mesh) -> None:
    h = coarsen(mesh.vertices, mesh.faces, _areas(mesh))
    neighbours = {frozenset(edge) for edge in mesh.edges_unique}
    first = set(h.vertices[h.levels[0] : h.levels[1]])
    assert not any(edge <= first for edge in neighbours)
    assert len(h.levels) < 12 * np.log(len(mesh.vertices))
