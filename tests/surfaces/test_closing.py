"""Caps, holes, loops and handles."""

from __future__ import annotations

import networkx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gipkg.errors import UnsupportedMesh
from gipkg.surfaces import genus, holes, loops
from gipkg.surfaces.caps import cap
from gipkg.surfaces.report import count
from gipkg.surfaces.triangles import Triangles
from tests.surfaces.solids import (
    assert_genus_zero,
    bare,
    chain_of_tori,
    sphere,
    torus,
    without_cap,
)
from tests.surfaces.test_steps import triangles


def circle(n: int) -> np.ndarray:
    a = 2 * np.pi * np.arange(n) / n
    return np.column_stack((np.cos(a), np.sin(a), np.zeros(n)))


def disc_faces(loop: np.ndarray):
    disc = cap(loop)
    points = np.concatenate((loop, disc.vertices))
    return bare(points, disc.faces)


@pytest.mark.parametrize("n", [3, 4, 5, 9, 10, 11, 30, 200, 1000])
def test_cap_of_a_circle_is_its_flat_disc_without_slivers(n):
    mesh = disc_faces(circle(n))
    assert mesh.euler_number == 1
    assert mesh.area == pytest.approx(n / 2 * np.sin(2 * np.pi / n), rel=1e-9)
    assert (mesh.face_normals[:, 2] > 0.999).all()
    assert len(mesh.faces) <= 9 * n
    if n >= 4:
        assert np.degrees(mesh.face_angles.min()) > 18


@pytest.mark.parametrize("n", [4, 10, 57])
def test_cap_runs_along_the_loop_and_joins_no_two_of_its_vertices(n):
    edges = disc_faces(circle(n)).edges
    border = {(i, (i + 1) % n) for i in range(n)}
    inside = [tuple(edge) for edge in edges.tolist() if max(edge) < n]
    assert set(inside) == border
    assert len(inside) == n


@settings(max_examples=30)
@given(st.integers(4, 60), st.integers(0, 10**6))
def test_cap_stays_within_the_hull_of_any_loop(n, seed):
    loop = np.random.default_rng(seed).standard_normal((n, 3))
    inner = cap(loop).vertices
    directions = np.random.default_rng(1).standard_normal((50, 3))
    assert ((inner @ directions.T) <= (loop @ directions.T).max(axis=0) + 1e-9).all()


def test_cap_of_a_loop_with_coinciding_points_is_finite():
    loop = np.repeat(circle(6), 2, axis=0)
    assert np.isfinite(cap(loop).vertices).all()
    assert np.isfinite(cap(np.zeros((5, 3))).vertices).all()


def test_border_loops_run_against_the_faces():
    tube = torus(24, 12)
    keep = (tube.faces // 12 < 15).all(axis=1)
    found = holes.border_loops(tube.faces[keep])
    assert [len(loop) for loop in found] == [12, 12]
    directed = {tuple(edge) for edge in bare(tube.vertices, tube.faces[keep]).edges.tolist()}
    for loop in found:
        for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True):
            assert (b, a) in directed
            assert (a, b) not in directed


@pytest.mark.parametrize("height", [0.1, 0.5, 0.9])
def test_opened_sphere_is_closed_by_the_flat_disc(height):
    opened = triangles(without_cap(sphere(3), height)).compact()
    closed, number = holes.fill_holes(opened, 0.4)
    assert number == 1
    mesh = bare(closed.vertices, closed.faces)
    assert_genus_zero(mesh)
    z = opened.vertices[holes.border_loops(opened.faces)[0], 2].mean()
    assert mesh.volume == pytest.approx(np.pi * (2 / 3 + z - z**3 / 3), rel=0.02)
    assert np.array_equal(closed.original, np.arange(len(closed.vertices)) < len(opened.vertices))


def test_hole_larger_than_allowed_is_refused():
    opened = triangles(without_cap(sphere(3), 0.0)).compact()
    with pytest.raises(UnsupportedMesh, match="largest_hole=1"):
        holes.fill_holes(opened, 0.2)


def test_caps_are_measured_against_the_closed_surface():
    n, radius = 48, 1.4  # of a tube of height 1: each cap is 29 % of the closed surface
    ring = radius * circle(n)
    i = np.arange(n)
    j = (i + 1) % n
    faces = np.concatenate((np.column_stack((i, j, n + j)), np.column_stack((i, n + j, n + i))))
    tube = triangles(bare(np.concatenate((ring, ring + np.array([0, 0, 1]))), faces))
    closed, number = holes.fill_holes(tube, 0.4)
    assert number == 2
    assert_genus_zero(bare(closed.vertices, closed.faces))
    with pytest.raises(UnsupportedMesh, match="a cap of 29% of the whole"):
        holes.fill_holes(tube, 0.25)


def separates(mesh, loop) -> bool:
    """Whether the faces fall apart along a loop, by NetworkX."""
    cut = {frozenset(pair) for pair in zip(loop.tolist(), np.roll(loop, 1).tolist(), strict=True)}
    graph = networkx.Graph()
    graph.add_nodes_from(range(len(mesh.faces)))
    for pair, edge in zip(mesh.face_adjacency, mesh.face_adjacency_edges.tolist(), strict=True):
        if frozenset(edge) not in cut:
            graph.add_edge(*pair)
    return not networkx.is_connected(graph)


def length_of(points: np.ndarray) -> float:
    return float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())


@pytest.mark.parametrize(("around", "across"), [(24, 12), (60, 40)])
@pytest.mark.parametrize(("minor", "is_meridian"), [(0.3, True), (0.6, False)])
def test_shortest_loop_of_a_torus_is_the_shorter_of_meridian_and_inner_equator(
    around, across, minor, is_meridian
):
    mesh = torus(around, across, minor)
    loop = loops.shortest_nonseparating_loop(np.array(mesh.vertices), np.array(mesh.faces))
    meridian = 2 * across * minor * np.sin(np.pi / across)
    inner = 2 * around * (1 - minor) * np.sin(np.pi / around)
    assert (meridian < inner) == is_meridian
    assert length_of(mesh.vertices[loop]) == pytest.approx(min(meridian, inner), rel=1e-9)
    assert len(set(loop.tolist())) == len(loop)
    assert not separates(mesh, loop)


def test_narrow_waist_separates_and_is_no_answer():
    """The shortest non-contractible loop of two glued tori goes around the tube between."""
    mesh = chain_of_tori(2)
    loop = loops.shortest_nonseparating_loop(np.array(mesh.vertices), np.array(mesh.faces))
    meridian = 2 * 12 * 0.3 * np.sin(np.pi / 12)
    assert not separates(mesh, loop)
    assert length_of(mesh.vertices[loop]) == pytest.approx(meridian, rel=0.02)


def brute_force_shortest(mesh) -> float:
    """Shortest of the loops that a non-tree edge closes with any shortest-path tree."""
    graph = networkx.Graph()
    for a, b in mesh.edges_unique.tolist():
        graph.add_edge(a, b, weight=float(np.linalg.norm(mesh.vertices[a] - mesh.vertices[b])))
    best = np.inf
    for base in graph:
        distance, path = networkx.single_source_dijkstra(graph, base)
        for a, b, weight in graph.edges(data="weight"):
            loop = path[a] + path[b][:0:-1]
            total = distance[a] + distance[b] + weight
            simple = len(set(loop)) == len(loop) > 2
            if simple and total < best - 1e-12 and not separates(mesh, np.array(loop)):
                best = total
    return best


@settings(max_examples=6)
@given(st.integers(0, 10**6))
def test_shortest_loop_agrees_with_brute_force(seed):
    mesh = torus(9, 7, 0.45)
    noise = np.random.default_rng(seed).normal(0, 0.08, mesh.vertices.shape)
    mesh = bare(mesh.vertices + noise, mesh.faces)
    loop = loops.shortest_nonseparating_loop(np.array(mesh.vertices), np.array(mesh.faces))
    assert length_of(mesh.vertices[loop]) == pytest.approx(brute_force_shortest(mesh), rel=1e-9)


@pytest.mark.parametrize("handles", [1, 2, 4])
def test_handles_go(handles):
    mesh = triangles(chain_of_tori(handles))
    assert genus.genus(mesh) == handles
    cut, lengths = genus.remove_handles(mesh)
    result = bare(cut.vertices, cut.faces)
    assert len(lengths) == handles
    assert_genus_zero(result)
    assert not cut.original.all()
    assert result.volume == pytest.approx(chain_of_tori(handles).volume, rel=0.05)


def test_cut_sides_stay_apart_when_a_reader_merges_vertices():
    cut, _ = genus.remove_handles(triangles(torus()))
    mesh = bare(cut.vertices, cut.faces)
    mesh.merge_vertices()
    assert_genus_zero(mesh)


def test_caps_draw_back_into_their_own_side():
    """A cut ring: both caps lie within the ring's solid, with a gap between them."""
    mesh = torus(48, 16, 0.2)
    cut, _ = genus.remove_handles(triangles(mesh))
    added = cut.vertices[~cut.original]
    ring = np.hypot(np.hypot(added[:, 0], added[:, 1]) - 1, added[:, 2])
    assert ring.max() < 0.2
    angle = np.unwrap(np.arctan2(added[:, 1], added[:, 0]))
    inner = angle[ring < 0.15]
    assert np.ptp(inner) > 1e-3


def test_sampled_and_complete_search_agree(monkeypatch):
    mesh = torus(50, 20, 0.25)
    arrays = np.array(mesh.vertices), np.array(mesh.faces)
    complete = loops.shortest_nonseparating_loop(*arrays)
    monkeypatch.setattr(loops, "ALL_BASES", 100)
    monkeypatch.setattr(loops, "SAMPLED_BASES", 5)
    sampled = loops.shortest_nonseparating_loop(*arrays)
    assert length_of(arrays[0][sampled]) == pytest.approx(length_of(arrays[0][complete]))


def test_counts_know_genus_and_holes():
    mesh = triangles(chain_of_tori(2))
    opened = Triangles(mesh.vertices, mesh.faces[1:-1], mesh.original)
    counts = count(opened.vertices, opened.faces)
    assert (counts.components, counts.holes, counts.genus) == (1, 2, 2)
