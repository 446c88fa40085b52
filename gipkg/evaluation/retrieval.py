"""Retrieval: every shape queries all the others, ranked by their distance from it.

The query itself is left out. Shapes of the query's class are relevant. Shapes at exactly the
same distance are retrieved together, so that no figure depends on the order of the shapes.
A query with no other shape of its class counts in nothing, since nothing could be found.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

RECALL_LEVELS = np.linspace(0.0, 1.0, 11)
"""Standard recall levels of the precision-recall curve."""


def mean_average_precision(distances: ArrayLike, labels: ArrayLike) -> float:
    """Mean over the queries of the average precision.

    The average precision of a query with R relevant shapes is (1/R) Σ P(s), summed over the
    relevant shapes s, where P(s) is the share of relevant shapes among all that are at most as
    far from the query as s.

    Parameters
    ----------
    distances : (n, n) array_like
        From each query, a row, to every shape; the diagonal is not read.
    labels : (n,) array_like
        Class of each shape.

    Returns
    -------
    float
        In (0, 1].

    Raises
    ------
    ValueError
        The arguments do not fit together, or no class has two shapes.
    """
    ranking = _rank(distances, labels)
    hits = (ranking.relevant * ranking.precision).sum(axis=1)
    return float(np.mean(hits / ranking.relevant.sum(axis=1)))


def precision_recall(distances: ArrayLike, labels: ArrayLike) -> NDArray[np.float64]:
    """Interpolate the precision at the standard recall levels and average it over the queries.

    The interpolated precision at a level is the highest precision at that recall or more
    (Manning, Raghavan & Schütze, Introduction to Information Retrieval, 2008, section 8.4).

    Parameters
    ----------
    distances, labels
        As in :func:`mean_average_precision`.

    Returns
    -------
    (11,) float64 array
        Mean precision at the recall levels 0, 0.1, …, 1 (`RECALL_LEVELS`).

    Raises
    ------
    ValueError
        As in :func:`mean_average_precision`.
    """
    ranking = _rank(distances, labels)
    best = np.maximum.accumulate(ranking.precision[:, ::-1], axis=1)[:, ::-1]
    total = ranking.relevant.sum(axis=1, keepdims=True)
    # In whole numbers: a recall of 3/10 must reach the level 0.3.
    last = len(RECALL_LEVELS) - 1
    first = [(last * ranking.found >= level * total).argmax(axis=1) for level in range(last + 1)]
    return np.take_along_axis(best, np.stack(first, axis=1), axis=1).mean(axis=0)


@dataclass(frozen=True, slots=True)
class _Ranking:
    """For each of q queries, the n - 1 other shapes from the nearest to the farthest.

    Attributes
    ----------
    relevant : (q, n - 1) bool array
    found : (q, n - 1) int array
        Relevant shapes at most as far away.
    precision : (q, n - 1) float64 array
        Their share among all shapes at most as far away.
    """

    relevant: NDArray[np.bool_]
    found: NDArray[np.intp]
    precision: NDArray[np.float64]


def _rank(distances: ArrayLike, labels: ArrayLike) -> _Ranking:
    matrix = np.asarray(distances, dtype=np.float64)
    labels = np.asarray(labels)
    n = len(labels)
    if matrix.shape != (n, n):
        raise ValueError(
            f"distances must be (n, n) and labels (n,); got {matrix.shape}, {labels.shape}"
        )
    if not np.isfinite(matrix).all():
        raise ValueError("distances must be finite")
    others = ~np.eye(n, dtype=bool)
    same = labels[:, None] == labels
    queries = (same & others).any(axis=1)
    if not queries.any():
        raise ValueError("no class has two shapes: there is nothing to retrieve")
    others = others[queries]
    ranked = matrix[queries][others].reshape(-1, n - 1)
    relevant = same[queries][others].reshape(-1, n - 1)

    order = ranked.argsort(axis=1)
    ranked = np.take_along_axis(ranked, order, axis=1)
    relevant = np.take_along_axis(relevant, order, axis=1)
    # Position of the last shape that is as near as this one.
    places = np.arange(n - 1)
    tied = np.zeros(ranked.shape, dtype=bool)
    tied[:, :-1] = ranked[:, :-1] == ranked[:, 1:]
    last = np.minimum.accumulate(np.where(tied, n - 2, places)[:, ::-1], axis=1)[:, ::-1]
    found = np.take_along_axis(relevant.cumsum(axis=1), last, axis=1)
    return _Ranking(relevant, found, found / (last + 1))
