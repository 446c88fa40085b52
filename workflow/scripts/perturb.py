"""Perturb the surfaces of one shard that any of the splits tests, and prepare them again."""

from pathlib import Path

from gipkg.shards import Arrays, Shard
from gipkg.surfaces.perturbations import perturb

import job
from meshes import mesh_of, surface_arrays
from samples import read_split

job.start(snakemake)
surfaces, params = Shard.open(Path(snakemake.input.surfaces)), snakemake.params
tested = {shape_id for path in snakemake.input.splits for shape_id in read_split(path, "test")}


def surface(shape_id: str) -> Arrays:
    """Perturb one surface."""
    mesh, chosen = mesh_of(surfaces[shape_id]), params.perturbation
    how = {"seed": params.seed, "shape_id": shape_id}
    return surface_arrays(perturb(mesh, chosen["name"], chosen["strength"], **how))


failures = {shape_id: surfaces.failures[shape_id] for shape_id in tested & set(surfaces.failures)}
job.map_shapes(snakemake, sorted(tested & set(surfaces.ids)), surface, failures)
