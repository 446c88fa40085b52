"""The distance between two shapes: the least that any rotation leaves between their silhouettes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gipkg.baselines.light_field.cameras import alignments
from gipkg.baselines.light_field.features import ANGULAR, FOURIER, RADIAL
from gipkg.compilation import compiled

WEIGHTS = np.array([1] * (RADIAL * ANGULAR - 1) + [4] * FOURIER + [2, 1])
"""Of the features. The original doubles the Fourier descriptors before it quantises them, and
counts the distance of these and of the circularity twice."""
LEVELS = 255


def quantise(features: NDArray[np.float32]) -> NDArray[np.int16]:
    """Turn (…, 47) features into whole numbers, weighted, that distances are sums of."""
    return np.rint(np.clip(features, 0, 1) * LEVELS * WEIGHTS).astype(np.int16)


def pairwise_distances(shapes: NDArray[np.int16]) -> NDArray[np.float32]:
    """Compare all pairs of n shapes.

    The distance is the sum of the differences of the ten pairs of silhouettes that meet, least
    over the attitudes of both shapes' cameras and the rotations of the dodecahedron (Chen et
    al. 2003, section 3).

    Parameters
    ----------
    shapes : (n, 10, 10, 47) int16 array
        Quantised features of 10 views from each of 10 dodecahedra.

    Returns
    -------
    (n, n) float32 array
        Symmetric, with 0 on the diagonal.
    """
    distances = _compare(np.ascontiguousarray(shapes), alignments())
    return (distances + distances.T).astype(np.float32)


@compiled
def _compare(shapes, permutations):  # type: ignore[no-untyped-def]
    """Return the distances above the diagonal."""
    n, systems, views = shapes.shape[:3]
    distances = np.zeros((n, n), dtype=np.int64)
    between = np.empty((systems, views, systems, views), dtype=np.int32)
    for a in range(n):
        for b in range(a + 1, n):
            for i in range(systems):
                for v in range(views):
                    for j in range(systems):
                        for w in range(views):
                            between[i, v, j, w] = _difference(shapes[a, i, v], shapes[b, j, w])
            distances[a, b] = _least(between, permutations)
    return distances


@compiled
def _difference(one, other):  # type: ignore[no-untyped-def]
    total = np.int32(0)
    for k in range(len(one)):
        total += np.int32(abs(np.int32(one[k]) - np.int32(other[k])))
    return total


@compiled
def _least(between, permutations):  # type: ignore[no-untyped-def]
    systems, views = between.shape[:2]
    least = np.int64(2**62)
    for i in range(systems):
        for j in range(systems):
            for g in range(len(permutations)):
                total = np.int64(0)
                for v in range(views):
                    total += between[i, v, j, permutations[g, v]]
                least = min(least, total)
    return least
