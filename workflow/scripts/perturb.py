"""Perturb the surfaces that any of the splits tests, and prepare them again."""

from gipkg.shards import Arrays
from gipkg.surfaces.perturbations import perturb

import job
from meshes import mesh_of, surface_arrays
from samples import read_split
from shards import Shards

job.start(snakemake)
surfaces = Shards(snakemake.input.surfaces)
params = snakemake.params
tested = {shape_id for path in snakemake.input.splits for shape_id in read_split(path, "test")}


def surface(shape_id: str) -> Arrays:
    """Perturb one surface."""
    mesh, chosen = mesh_of(surfaces[shape_id]), params.perturbation
    how = {"seed": params.seed, "shape_id": shape_id, "options": params.options}
    return surface_arrays(perturb(mesh, chosen["name"], chosen["strength"], **how))


failures = {
    shape_id: reason for shape_id, reason in surfaces.failures.items() if shape_id in tested
}
job.map_shapes(snakemake, sorted(tested & set(surfaces)), surface, failures)
