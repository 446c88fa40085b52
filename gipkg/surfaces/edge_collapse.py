"""A half-edge mesh in flat arrays that undoes its own edge collapses.

Half-edge ``h`` is corner ``h % 3`` of face ``h // 3``; it starts at vertex ``origin[h]`` and
``twin[h]`` runs the other way in the neighbouring face. A collapse leaves the two faces it
removes untouched, so the same arrays tell how to put them back.
"""

from __future__ import annotations

from gipkg.compilation import compiled


@compiled
def following(h: int) -> int:
    """Next half-edge of the same face."""
    return h - 2 if h % 3 == 2 else h + 1


@compiled
def preceding(h: int) -> int:
    """Previous half-edge of the same face."""
    return h + 2 if h % 3 == 0 else h - 1


@compiled
def gather_ring(twin, origin, start, ring, spokes):  # type: ignore[no-untyped-def]
    """Write the neighbours of a vertex in counterclockwise order; return their number.

    ``spokes[i]`` is the half-edge from the vertex to ``ring[i]``; its face has the corners
    vertex, ``ring[i]``, ``ring[i + 1]``. `start` is the spoke to begin with.
    """
    degree = 0
    h = start
    while True:
        ring[degree] = origin[following(h)]
        spokes[degree] = h
        degree += 1
        h = twin[preceding(h)]
        if h == start:
            return degree


@compiled
def collapse(twin, origin, outgoing, spokes, degree):  # type: ignore[no-untyped-def]
    """Merge a vertex into the end of ``spokes[0]``, given its gathered ring.

    The faces of ``spokes[0]`` and ``spokes[degree - 1]`` disappear.
    """
    first = spokes[0]
    into = origin[following(first)]
    for i in range(1, degree - 1):
        origin[spokes[i]] = into
    outer = twin[following(first)]
    inner = spokes[1]
    twin[inner] = outer
    twin[outer] = inner
    outgoing[into] = inner
    outgoing[origin[outer]] = outer
    last = spokes[degree - 1]
    outer = twin[following(last)]
    inner = preceding(spokes[degree - 2])
    twin[inner] = outer
    twin[outer] = inner
    outgoing[origin[inner]] = inner


@compiled
def split(twin, origin, outgoing, vertex, first):  # type: ignore[no-untyped-def]
    """Undo the collapse of `vertex` along half-edge `first`; collapses are undone in reverse."""
    into = origin[following(first)]
    inner = twin[preceding(first)]
    outer = twin[following(first)]
    twin[inner] = preceding(first)
    twin[outer] = following(first)
    last = following(twin[first])
    inner = twin[last]
    outer = twin[following(last)]
    twin[inner] = last
    twin[outer] = following(last)
    h = twin[preceding(first)]
    while h != last:
        origin[h] = vertex
        h = twin[preceding(h)]
    outgoing[vertex] = first
    outgoing[into] = twin[first]
