"""The perturbations by name, and what is made of a perturbed surface."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
import trimesh

from gipkg.surfaces.perturbations.missing import HOLES, remove_holes, remove_region
from gipkg.surfaces.perturbations.noise import add_noise
from gipkg.surfaces.perturbations.remeshing import remesh
from gipkg.surfaces.perturbations.shortcuts import add_shortcuts
from gipkg.surfaces.preparation import prepare
from gipkg.surfaces.surface import Surface


@dataclass(frozen=True, slots=True)
class Perturbation:
    """Something that may be wrong with a surface.

    Attributes
    ----------
    apply : callable
        A closed genus-0 surface, a positive strength and a generator to the surface with its
        faults; the first is never changed.
    summary : str
        What it does, and what its strength measures.
    """

    apply: Callable[[trimesh.Trimesh, float, np.random.Generator], trimesh.Trimesh]
    summary: str


PERTURBATIONS: Mapping[str, Perturbation] = MappingProxyType(
    {
        "noise": Perturbation(
            add_noise, "Gaussian noise at every vertex; its deviation in mean edge lengths"
        ),
        "remesh": Perturbation(remesh, "other triangles; vertices as a multiple of those before"),
        "holes": Perturbation(
            remove_holes, f"{HOLES} small holes; the share of the surface that they take together"
        ),
        "shortcut": Perturbation(
            add_shortcuts, "tubes between places that are near in space alone; their number"
        ),
        "missing": Perturbation(remove_region, "one region is missing; its share of the surface"),
    }
)


def perturb(
    mesh: trimesh.Trimesh,
    name: str,
    strength: float,
    *,
    seed: int,
    shape_id: str,
    options: Mapping[str, Any] = MappingProxyType({}),
) -> Surface:
    """Perturb a surface and prepare it again, as if it had come from a scanner like that.

    A stronger perturbation of the same shape strikes at the same places.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Closed genus-0 surface.
    name : str
        Of one of `PERTURBATIONS`.
    strength : float
        Positive; what it measures, each perturbation says.
    seed : int
    shape_id : str
        The random choices are those of this shape, whatever other shapes there are.
    options : mapping
        Of :func:`gipkg.surfaces.prepare`, as the surfaces of the database were prepared;
        `smallest_part` has no say, for what a fault cuts off is part of the fault.

    Returns
    -------
    Surface
        Closed, of genus 0 and of one component: the largest that is left, by default.

    Raises
    ------
    UnsupportedMesh
        The perturbed surface cannot be repaired.
    """
    rng = np.random.default_rng([seed, zlib.crc32(shape_id.encode())])
    faulty = PERTURBATIONS[name].apply(mesh, strength, rng)
    return prepare(faulty, **{**options, "smallest_part": 0.0})
