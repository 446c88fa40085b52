"""Skeletons: balls joined by bones, posed by rotating one joint after the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.distance import cdist
from scipy.spatial.transform import Rotation

CONTACT_SAMPLES = 6
"""Balls sampled along a bone when looking for contact."""
BRANCHING = 3.0
"""Balls may touch up to this many times the sum of their radii along the skeleton: two
bones that leave a joint at more than 2 asin(1/3) = 39 degrees are never in contact."""
ROOTS = 2.5
"""Added to that, in radii of the largest ball: where limbs leave the body they may meet."""


class Skeleton:
    """A graph of balls (nodes) and rounded cones between them (bones).

    Attributes
    ----------
    genus : int
        Genus of the surface that the skeleton is meant to have.
    """

    def __init__(self) -> None:
        self.genus = 0
        self._centres: list[NDArray[np.float64]] = []
        self._radii: list[float] = []
        self._bones: list[tuple[int, int]] = []
        self._bone_radii: list[tuple[float, float]] = []

    def ball(
        self, centre: ArrayLike, radius: float, parent: int | None = None, neck: float | None = None
    ) -> int:
        """Add a ball, joined to `parent` when there is one; return its node."""
        self._centres.append(np.asarray(centre, dtype=np.float64))
        self._radii.append(float(radius))
        node = len(self._radii) - 1
        if parent is not None:
            self.join(parent, node, neck)
        return node

    def join(self, first: int, second: int, neck: float | None = None) -> None:
        """Add a bone from ball to ball: as thick as they are, or `neck` in radius."""
        self._bones.append((first, second))
        if neck is None:
            self._bone_radii.append((self._radii[first], self._radii[second]))
        else:
            self._bone_radii.append((neck, neck))

    def limb(
        self,
        root: int,
        frame: Rotation,
        lengths: ArrayLike,
        radii: ArrayLike,
        bends: Sequence[Rotation] = (),
    ) -> list[int]:
        """Add a chain of bones by forward kinematics.

        Bone i runs along the x axis of its frame; the frame of bone i + 1 is that of bone i
        turned by bend i (about the axes of bone i).

        Parameters
        ----------
        root : int
            Node that the chain starts from; the first bone is as thick there as at its end.
        frame : Rotation
            Frame of the first bone.
        lengths, radii : (n,) arrays
            Length of each bone, and radius of the ball at its end.
        bends : sequence of n - 1 Rotation
            Rotation of the joint after each bone but the last.

        Returns
        -------
        list of int
            The nodes added, from the root outwards.
        """
        nodes: list[int] = []
        turns = [Rotation.identity(), *bends]
        for length, radius, turn in zip(np.asarray(lengths), np.asarray(radii), turns, strict=True):
            frame = frame * turn
            centre = self.centre(root) + length * frame.apply([1.0, 0.0, 0.0])
            root = self.ball(centre, radius, root, neck=None if nodes else radius)
            nodes.append(root)
        return nodes

    def centre(self, node: int) -> NDArray[np.float64]:
        """(3,) centre of a node."""
        return self._centres[node]

    def radius(self, node: int) -> float:
        """Radius of a node's ball."""
        return self._radii[node]

    @property
    def thinnest(self) -> float:
        """Radius of the smallest ball."""
        return min(self._radii)

    def cones(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """List (C, 2, 3) ends and (C, 2) end radii of the bones, and of balls thicker than they."""
        bones, radii = np.array(self._bones), np.array(self._bone_radii)
        centres, balls = np.array(self._centres), np.array(self._radii)
        covered = np.zeros(len(balls))
        np.maximum.at(covered, bones, radii)
        bare = np.flatnonzero(balls > covered)
        ends = np.concatenate([centres[bones], np.repeat(centres[bare, None], 2, axis=1)])
        return ends, np.concatenate([radii, np.repeat(balls[bare, None], 2, axis=1)])

    def touches_itself(self, gap: float) -> bool:
        """Whether parts that are far apart along the skeleton come closer than `gap`."""
        centres, radii = np.array(self._centres), np.array(self._radii)
        start, end = np.array(self._bones).T
        bone_radii = np.array(self._bone_radii)
        along = np.linspace(0.0, 1.0, CONTACT_SAMPLES + 2)[1:-1, None]
        inner_centres = centres[start] + along[..., None] * (centres[end] - centres[start])
        inner_radii = bone_radii[:, 0] + along * (bone_radii[:, 1] - bone_radii[:, 0])
        inner = len(radii) + np.arange(inner_radii.size).reshape(inner_radii.shape)

        path = np.vstack([start[None], inner, end[None]])
        points = np.vstack([centres, inner_centres.reshape(-1, 3)])
        reach = np.concatenate([radii, inner_radii.ravel()])
        tail, head = path[:-1].ravel(), path[1:].ravel()
        steps = np.linalg.norm(points[head] - points[tail], axis=1)
        graph = coo_array((steps, (tail, head)), shape=(len(points), len(points)))

        room = reach[:, None] + reach[None, :]
        near = cdist(points, points) < room + gap
        allowed = BRANCHING * room + ROOTS * radii.max()
        far = dijkstra(graph.tocsr(), directed=False) > allowed
        return bool((near & far).any())
