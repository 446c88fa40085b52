"""Closed genus-0 test surfaces, from easy to hard."""

from __future__ import annotations

import numpy as np
import trimesh


def icosphere(subdivisions: int = 3) -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=subdivisions)


def ellipsoid(*axes: float, subdivisions: int = 3) -> trimesh.Trimesh:
    sphere = icosphere(subdivisions)
    return trimesh.Trimesh(sphere.vertices * axes, sphere.faces, process=False)


def urchin(spikes: int, length: float, subdivisions: int = 4) -> trimesh.Trimesh:
    """A ball with radial limbs, the thinner the longer."""
    sphere = icosphere(subdivisions)
    golden = np.pi * (3 - np.sqrt(5))
    height = 1 - 2 * (np.arange(spikes) + 0.5) / spikes
    ring = np.sqrt(1 - height**2)
    angle = golden * np.arange(spikes)
    tips = np.column_stack((ring * np.cos(angle), ring * np.sin(angle), height))
    closeness = np.exp(30 * ((sphere.vertices @ tips.T).max(axis=1) - 1))
    return trimesh.Trimesh(
        sphere.vertices * (1 + length * closeness)[:, None], sphere.faces, process=False
    )


def needle(segments: int = 60) -> trimesh.Trimesh:
    """A closed tube 100 times as long as wide: limbs of it underflow under Tutte's embedding."""
    height = np.linspace(0, 100, segments)
    turn = np.linspace(0, 2 * np.pi, 7)[:-1]
    rings = np.stack([np.column_stack((np.cos(turn), np.sin(turn), 0 * turn + h)) for h in height])
    vertices = np.vstack((rings.reshape(-1, 3), [[0, 0, -1], [0, 0, 101]]))
    faces = []
    for s in range(segments - 1):
        for k in range(6):
            a, b = 6 * s + k, 6 * s + (k + 1) % 6
            faces += [(a, b, b + 6), (a, b + 6, a + 6)]
    for k in range(6):
        faces.append((len(vertices) - 2, (k + 1) % 6, k))
        faces.append((len(vertices) - 1, 6 * (segments - 1) + k, 6 * (segments - 1) + (k + 1) % 6))
    return trimesh.Trimesh(vertices, faces, process=False)


def fibonacci(count: int) -> np.ndarray:
    """Points on the unit sphere that each stand for about the same area."""
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    ring = np.sqrt(1 - z**2)
    return np.column_stack((ring * np.cos(turn), ring * np.sin(turn), z))
