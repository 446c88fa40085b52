"""Areas of all faces as near to exact as they get, by pushes from a smooth map on.

A map of V vertices has 2V - 3 degrees of freedom and 2V - 5 face areas to meet, as many as a frame
has bars that is just rigid. Like such a frame it has soft modes all over: patterns of too large
and too small faces, some hundred faces wide, that no small move changes. The squared errors alone
have minima of their own there, jammed between needles, where they stay.

Here exact areas are a constraint, which the method of multipliers approaches: errors are added up,
face by face, and pushed against. It begins at a smooth map, where the shape of the triangles
weighs as much as their areas, and that weight falls a level at a time, so that areas are met while
the triangles are still round. From the last level on every round lets go of the map and descends
without the push.

Two things bring it on. A push keeps on growing where the errors stay (momentum), as soft modes
give way slowly. And where a few faces block each other for good, so that much of the error gathers
in them, pushes alone only swing to and fro: faces that are still far off at the end of a round
weigh several times more from then on, and less again, by and by, where they are not. The way is a
chaotic one: a map that is still far from the tolerance at its end is given another, with pushes
that grow by another share.

The same way leads to the few percent that are enough for most uses, in a fraction of the time: a
few short pushes a level, and from there down to the tolerance, since not the least energy counts
but the areas. Where that does not reach it, rounds go on, and shape weighs less after each.

References
----------
Hestenes, Multiplier and gradient methods, J. Optimization Theory and Applications 1969; Powell
1969. Momentum that is dropped when errors turn against it: O'Donoghue & Candès, Adaptive restart
for accelerated gradient schemes, Foundations of Computational Mathematics 2015. Weights that grow
where a search is caught: Morris, The breakout method for escaping from local minima, AAAI 1993.
Just rigid frames: Lubensky et al., Phonons and elasticity in critically coordinated lattices,
Reports on Progress in Physics 2015.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import ceil

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.area_residual import area_residual
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.parametrizers.variational.newton import Descent
from gipkg.parametrizers.variational.quasi_newton import run
from gipkg.parametrizers.variational.settling import face_ratios, face_std, settle, settle_within

SMOOTH = 1.0
"""Weight of shape at whose minimum the pushes begin."""
_LEVELS = tuple(np.geomspace(SMOOTH, 1e-4, 10))
"""Weights of shape on the way down."""
_PUSHES_A_ROUND = 20
_SHAPE_LEFT, _LEAST_SHAPE = 0.1, 1e-7
"""Of the weight of shape, after a round, where it may fall; and in the end."""
_ALL_ROUNDS, _LEAST_ROUNDS = 2_000, 0.1
"""Vertices up to which all rounds are taken; a larger mesh takes fewer in proportion, at least this
share of them."""
_SHARE, _LESS, _LEAST_SHARE = 0.5, 0.64, 0.2
"""Of its error by which a push grows, at first; what is left of that after a round, and to begin
with on the next way; at least."""
_FAR_FROM_TOLERANCE = 4.0
"""Multiple of the tolerance above which another way is taken."""
_MOMENTUM = 0.5
"""Of its last growth by which a push grows besides."""
_FAR, _HEAVIER, _LIGHTER, _HEAVIEST = 4.0, 4.0, 0.9, 1e3
"""Standard deviations from which an error is far off; by what such a face and the others change
their weights after a round, between 1 and the last number."""
_START_DAMPING, _STUCK, _LEFT = 1e-3, 0.3, 0.5
"""Damping at first, and the one from which pushes flatten faces; what is left of them then."""


@dataclass(frozen=True)
class Rounds:
    """How near face areas are to be brought to exact ones, and what that may cost.

    Attributes
    ----------
    count : int
        At most on a way, after the levels down to the first, of two dozen factorizations each; of
        a mesh of more than 2,000 vertices fewer in proportion, at least a tenth.
    face_tolerance : float
        Standard deviation of the faces' area ratios that is small enough.
    shape_falls : bool
        Only areas count, until they are within the tolerance, and shape weighs a tenth after each
        round; else a map is as good as its energy is low.
    pushes_a_level, steps_a_push : int
        Pushes on the way down to the first round; steps of the run that follows a push, there and
        in rounds.
    trials : int
        Ways taken at most; another one only while more than four times the tolerance is left.
    """

    count: int
    face_tolerance: float
    shape_falls: bool = False
    pushes_a_level: int = 5
    steps_a_push: int = 15
    trials: int = 1

    def error(self, energy: MapEnergy) -> Callable[[NDArray[np.float64]], float]:
        """Say what maps (V, 3) are compared by."""
        return partial(face_std, energy) if self.shape_falls else energy.value

    def enough(self, energy: MapEnergy, sphere: NDArray[np.float64]) -> bool:
        """Say whether the areas of a pushed map (V, 3) leave nothing to push against."""
        return self.shape_falls and face_std(energy, sphere) <= self.face_tolerance

    def settled(
        self, descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Descend from a pushed map (V, 3) without the push."""
        if self.shape_falls:
            return settle_within(descent, energy, sphere, self.face_tolerance)
        return settle(descent, energy, sphere)


def toward_exact_face_areas(
    descent: Descent, energy: MapEnergy, sphere: NDArray[np.float64], rounds: Rounds
) -> NDArray[np.float64]:
    """Bring a smooth map near to exact face areas; the best map met is kept.

    Parameters
    ----------
    descent : Descent
    energy : MapEnergy
        With no shifts, and with the weight on shape that the first round has.
    sphere : (V, 3) float64 array
        Unit vectors, no flipped face; best at the minimum for the weight `SMOOTH` of shape.
    rounds : Rounds

    Returns
    -------
    (V, 3) float64 array
        Unit vectors, no flipped face.
    """
    best = sphere
    for trial in range(rounds.trials):
        found = _along(descent, energy, sphere, _SHARE * _LESS**trial, rounds)
        best = min(best, found, key=rounds.error(energy))
        if face_std(energy, best) <= _FAR_FROM_TOLERANCE * rounds.face_tolerance:
            break
    return best


def _along(
    descent: Descent,
    energy: MapEnergy,
    sphere: NDArray[np.float64],
    share: float,
    rounds: Rounds,
) -> NDArray[np.float64]:
    """Go one way of pushes from a smooth map (V, 3); the best map met is kept."""
    descent.damping, error = _START_DAMPING, rounds.error(energy)
    pushed = _Pushed.at(sphere, len(energy.faces))
    for shape in _LEVELS:
        if shape <= energy.shape or rounds.enough(energy, pushed.sphere):
            break
        level = replace(energy, shape=shape)
        for _ in range(rounds.pushes_a_level):
            pushed.push(descent, level, share, rounds.steps_a_push)
    best = min(sphere, rounds.settled(descent, energy, pushed.sphere), key=error)
    part = min(1.0, max(_ALL_ROUNDS / len(sphere), _LEAST_ROUNDS))
    for _ in range(ceil(part * rounds.count)):
        if face_std(energy, best) <= rounds.face_tolerance:
            break
        for _ in range(_PUSHES_A_ROUND):
            pushed.push(descent, energy, share, rounds.steps_a_push)
        share = max(_LESS * share, _LEAST_SHARE)
        freed = rounds.settled(descent, energy, pushed.sphere)
        pushed.weigh(face_ratios(energy, freed) - 1)
        best = min(best, freed, key=error)
        if rounds.shape_falls:
            energy = replace(energy, shape=max(_SHAPE_LEFT * energy.shape, _LEAST_SHAPE))
    return best


@dataclass
class _Pushed:
    """A map and what pushes it.

    Attributes
    ----------
    sphere : (V, 3) float64 array
    shifts, growth : (F,) float64 arrays
        Shifts of the faces' residuals, and by how much they grew last.
    weights : (F,) float64 array
        What faces weigh, as a multiple of what they do in the energy.
    """

    sphere: NDArray[np.float64]
    shifts: NDArray[np.float64]
    growth: NDArray[np.float64]
    weights: NDArray[np.float64]

    @classmethod
    def at(cls, sphere: NDArray[np.float64], faces: int) -> _Pushed:
        """Begin without a push, all faces alike."""
        return cls(sphere, np.zeros(faces), np.zeros(faces), np.ones(faces))

    def push(self, descent: Descent, energy: MapEnergy, share: float, steps: int) -> None:
        """Follow the minimum; add a share of the errors that it leaves to the shifts."""
        pushing = replace(energy, shifts=self.shifts, weights=self.weights * energy.weights)
        self.sphere = run(descent, pushing, self.sphere, steps)
        errors = _residuals(face_ratios(energy, self.sphere))
        momentum = _MOMENTUM if self.growth @ errors > 0 else 0.0
        self.growth = share * errors + momentum * self.growth
        self.shifts = self.shifts + self.growth
        if descent.damping > _STUCK:
            descent.damping = _START_DAMPING
            self.shifts = _LEFT * self.shifts
            self.growth = np.zeros_like(self.growth)

    def weigh(self, errors: NDArray[np.float64]) -> None:
        """Let faces with large errors (F,) weigh more; each is pushed as hard as before."""
        before = self.weights
        far = np.abs(errors) > _FAR * errors.std()
        self.weights = np.clip(before * np.where(far, _HEAVIER, _LIGHTER), 1.0, _HEAVIEST)
        self.shifts = self.shifts * before / self.weights
        self.growth = self.growth * before / self.weights


@compiled
def _residuals(ratios):  # type: ignore[no-untyped-def]
    residuals = np.zeros_like(ratios)
    for i in range(len(ratios)):
        residuals[i] = area_residual(ratios[i])[0]
    return residuals
