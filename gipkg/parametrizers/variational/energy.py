"""The energy of a whole spherical map, its gradient and a positive semidefinite Hessian.

Every face f contributes ``W (ρ(a / A) + μ)² + shape * A (2 D / det - 1)``: `a` is its signed
spherical area, `A` the area that it should have, `ρ` the
:func:`~gipkg.parametrizers.sphere.area_residual.area_residual`, `μ` a shift that is 0 but
where :mod:`~gipkg.parametrizers.variational.multipliers` push a face on, `D` the Dirichlet energy
of its map from the mesh to the flat triangle of its corners and ``det`` their triple product. The
flat triangle lies at distance h <= 1 from the centre and has the area ``det / 2h <= D``, so that
``2 D / det`` is at least 1, is the conformal distortion (MIPS: Hormann & Greiner 2000) of small
triangles, and is infinite when a face collapses or grows to a hemisphere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gipkg.compilation import compiled
from gipkg.parametrizers.sphere.area_residual import area_residual

_FULL_TURN = 1e-6
"""Allowed round-off of the total area; the next degree is 4π away."""


@dataclass(frozen=True)
class MapEnergy:
    """Energy of the maps of one mesh.

    Attributes
    ----------
    faces : (F, 3) int64 array
    targets : (F,) float64 array
        Areas that the faces should have, summing to 4π.
    weights : (F,) float64 array
        Weights W of the area terms.
    cotangents : (F, 3) float64 array
        Of the mesh's angles; column k belongs to the corner opposite the edge (k + 1, k + 2).
    shape : float
        Weight of the conformal term.
    shifts : (F,) float64 array
        Shifts μ of the area residuals.
    """

    faces: NDArray[np.int64]
    targets: NDArray[np.float64]
    weights: NDArray[np.float64]
    cotangents: NDArray[np.float64]
    shape: float
    shifts: NDArray[np.float64]

    def value(self, sphere: NDArray[np.float64]) -> float:
        """Energy of a map (V, 3); infinite if a face is flipped."""
        return self.value_and_gradient(sphere)[0]

    def value_and_gradient(self, sphere: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        """Energy of a map and its gradient in space.

        Parameters
        ----------
        sphere : (V, 3) float64 array
            Unit vectors.

        Returns
        -------
        value : float
            Infinite if a face is flipped.
        gradient : (V, 3) float64 array
            Only its tangential part is meaningful, and only where the energy is finite.
        """
        gradient = np.zeros_like(sphere)
        value = _value_and_gradient(
            sphere,
            self.faces,
            self.targets,
            self.weights,
            self.cotangents,
            self.shape,
            self.shifts,
            gradient,
        )
        return value, gradient

    def derivatives(
        self, sphere: NDArray[np.float64], basis: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Gradient, Hessian and metric in the tangent coordinates of every vertex.

        The Hessian is Gauss-Newton in the area term and keeps the convex part of the conformal
        term. The metric is the Dirichlet energy of a displacement on the current triangles: of
        order W where it turns a face over, however thin that is.

        Parameters
        ----------
        sphere : (V, 3) float64 array
        basis : (V, 2, 3) float64 array
            Orthonormal tangent vectors at every vertex.

        Returns
        -------
        gradient : (2V,) float64 array
        hessian, metric : (F, 6, 6) float64 arrays
            Contribution of every face, in the order (corner, coordinate).
        """
        return _derivatives(
            sphere,
            basis,
            self.faces,
            self.targets,
            self.weights,
            self.cotangents,
            self.shape,
            self.shifts,
        )


@compiled
def _value_and_gradient(  # type: ignore[no-untyped-def]
    sphere, faces, targets, weights, cotangents, shape, shifts, gradient
):
    energy, total = 0.0, 0.0
    for f in range(len(faces)):
        p, q, r = sphere[faces[f, 0]], sphere[faces[f, 1]], sphere[faces[f, 2]]
        a0, a1, a2 = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        b0, b1, b2 = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        triple = p[0] * (a1 * b2 - a2 * b1) + p[1] * (a2 * b0 - a0 * b2)
        triple += p[2] * (a0 * b1 - a1 * b0)
        if not triple > 0:
            return np.inf
        pq = a0 * a0 + a1 * a1 + a2 * a2
        rp = b0 * b0 + b1 * b1 + b2 * b2
        qr = (a0 - b0) ** 2 + (a1 - b1) ** 2 + (a2 - b2) ** 2
        # Chords |q - p|² of unit vectors give the cosines 1 - |q - p|² / 2 accurately.
        cosines = 4 - 0.5 * (pq + qr + rp)
        area = 2 * np.arctan2(triple, cosines)
        dirichlet = cotangents[f, 0] * qr + cotangents[f, 1] * rp + cotangents[f, 2] * pq
        residual, growth = area_residual(area / targets[f])
        energy += weights[f] * (residual + shifts[f]) ** 2
        energy += shape * targets[f] * (0.5 * dirichlet / triple - 1)
        total += area
        scale = 2 / (cosines * cosines + triple * triple)
        push = 2 * weights[f] * (residual + shifts[f]) * growth / targets[f] * scale
        conformal = shape * targets[f] / triple
        # The slopes of det, of the cosines (in each corner the sum of the other two), and of D.
        along = push * cosines - 0.5 * conformal * dirichlet / triple
        across = -push * triple
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            x, y, z = sphere[faces[f, k]], sphere[faces[f, i]], sphere[faces[f, j]]
            pull_y, pull_z = conformal * cotangents[f, j], conformal * cotangents[f, i]
            for c in range(3):
                d, e = (c + 1) % 3, (c + 2) % 3
                gradient[faces[f, k], c] += (
                    along * (y[d] * z[e] - y[e] * z[d])
                    + across * (y[c] + z[c])
                    + pull_y * (x[c] - y[c])
                    + pull_z * (x[c] - z[c])
                )
    if abs(total - 4 * np.pi) > _FULL_TURN:
        return np.inf
    return energy


@compiled
def _derivatives(  # type: ignore[no-untyped-def]
    sphere, basis, faces, targets, weights, cotangents, shape, shifts
):
    gradient = np.zeros(2 * len(sphere))
    hessian, metric = np.zeros((len(faces), 6, 6)), np.zeros((len(faces), 6, 6))
    corner, squares = np.zeros((3, 3)), np.zeros(3)
    frame = np.zeros((3, 2, 3))
    stiffness, dirichlet_metric = np.zeros((3, 3)), np.zeros((3, 3))
    area_slope, triple_slope, dirichlet_slope = np.zeros(6), np.zeros(6), np.zeros(6)
    for f in range(len(faces)):
        for k in range(3):
            for c in range(3):
                corner[k, c] = sphere[faces[f, k], c]
                frame[k, 0, c] = basis[faces[f, k], 0, c]
                frame[k, 1, c] = basis[faces[f, k], 1, c]
        p, q, r = corner
        a0, a1, a2 = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        b0, b1, b2 = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        triple = p[0] * (a1 * b2 - a2 * b1) + p[1] * (a2 * b0 - a0 * b2)
        triple += p[2] * (a0 * b1 - a1 * b0)
        dirichlet = 0.0  # twice the Dirichlet energy, as det is twice an area
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            squares[k] = 0.0
            for c in range(3):
                squares[k] += (corner[i, c] - corner[j, c]) ** 2
            dirichlet += 0.5 * cotangents[f, k] * squares[k]
        cosines = 4 - 0.5 * squares.sum()
        area = 2 * np.arctan2(triple, cosines)
        scale = 2 / (cosines * cosines + triple * triple)
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            x, y, z = corner[k], corner[i], corner[j]
            cross = (
                y[1] * z[2] - y[2] * z[1],
                y[2] * z[0] - y[0] * z[2],
                y[0] * z[1] - y[1] * z[0],
            )
            for d in range(2):
                m = 2 * k + d
                area_slope[m], triple_slope[m], dirichlet_slope[m] = 0.0, 0.0, 0.0
                for c in range(3):
                    tangent = frame[k, d, c]
                    area_slope[m] += scale * (cosines * cross[c] - triple * (y[c] + z[c])) * tangent
                    triple_slope[m] += cross[c] * tangent
                    pull = cotangents[f, i] * (x[c] - z[c]) + cotangents[f, j] * (x[c] - y[c])
                    dirichlet_slope[m] += pull * tangent
        conformal = shape * targets[f] / triple
        resistance = (weights[f] + shape * targets[f]) / area
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            own = (squares[i] + squares[j] - squares[k]) / (2 * triple)
            stiffness[i, j] = stiffness[j, i] = -conformal * cotangents[f, k]
            dirichlet_metric[i, j] = dirichlet_metric[j, i] = -resistance * own
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            stiffness[k, k] = -stiffness[k, i] - stiffness[k, j]
            dirichlet_metric[k, k] = -dirichlet_metric[k, i] - dirichlet_metric[k, j]
        residual, growth = area_residual(area / targets[f])
        slope = 2 * weights[f] * (residual + shifts[f]) * growth / targets[f]
        curvature = 2 * weights[f] * (growth / targets[f]) ** 2
        mixed = conformal / triple
        triple_bend = 2 * mixed * dirichlet / triple
        for k in range(3):
            for d in range(2):
                m = 2 * k + d
                gradient[2 * faces[f, k] + d] += (
                    slope * area_slope[m]
                    + conformal * dirichlet_slope[m]
                    - mixed * dirichlet * triple_slope[m]
                )
                for i in range(3):
                    for e in range(2):
                        n = 2 * i + e
                        dot = 0.0
                        for c in range(3):
                            dot += frame[k, d, c] * frame[i, e, c]
                        metric[f, m, n] = dirichlet_metric[k, i] * dot
                        hessian[f, m, n] = (
                            curvature * area_slope[m] * area_slope[n]
                            + triple_bend * triple_slope[m] * triple_slope[n]
                            - mixed * triple_slope[m] * dirichlet_slope[n]
                            - mixed * dirichlet_slope[m] * triple_slope[n]
                            + stiffness[k, i] * dot
                        )
    return gradient, hessian, metric
