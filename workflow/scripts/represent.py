"""Compute a baseline's representations of the surfaces of one shard."""

from pathlib import Path

from gipkg.shards import Arrays, Shard, join

import job
from meshes import operators_of

job.start(snakemake)
baseline = job.plugin("baseline", snakemake.params.baseline)
surfaces = Shard.open(Path(snakemake.input.surfaces))
spectra = Shard.open(Path(snakemake.input.spectra))


def representation(shape_id: str) -> Arrays:
    """Represent one surface."""
    operators = operators_of(surfaces[shape_id], spectra[shape_id])
    return {"representation": baseline.represent(operators.mesh, operators)}


ids, failures = join(surfaces, spectra)
job.map_shapes(snakemake, ids, representation, failures)
