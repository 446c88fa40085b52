from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse.csgraph import dijkstra

from gipkg.surfaces.edge_graph import edge_graph
from tests.surfaces.solids import torus


@pytest.mark.parametrize("left_out", [0, 5])
def test_every_edge_is_there_both_ways_with_its_length(left_out):
    mesh = torus()
    mesh.update_faces(np.arange(len(mesh.faces)) >= left_out)
    graph = edge_graph(mesh.vertices, mesh.faces).toarray()
    assert (graph == graph.T).all()
    assert np.count_nonzero(graph) == 2 * len(mesh.edges_unique)
    assert graph[tuple(mesh.edges_unique.T)] == pytest.approx(mesh.edges_unique_length)


def test_an_edge_of_three_faces_or_of_no_length_counts_once_as_it_is():
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]])
    faces = np.array([[0, 1, 2], [0, 1, 3], [1, 0, 4]])
    assert edge_graph(vertices, faces)[0, 1] == 1
    assert dijkstra(edge_graph(vertices, faces), indices=1)[4] == 0
