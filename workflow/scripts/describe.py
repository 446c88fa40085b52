"""Compute the per-vertex channels of the surfaces of one shard."""

from pathlib import Path

from gipkg.shards import Arrays, Shard, join

import job
from meshes import operators_of

job.start(snakemake)
descriptor = job.plugin("descriptor", snakemake.params.descriptor)
surfaces = Shard.open(Path(snakemake.input.surfaces))
spectra = Shard.open(Path(snakemake.input.spectra))


def channels(shape_id: str) -> Arrays:
    """Describe one surface."""
    operators = operators_of(surfaces[shape_id], spectra[shape_id])
    return {"channels": descriptor.describe(operators.mesh, operators)}


ids, failures = join(surfaces, spectra)
job.map_shapes(snakemake, ids, channels, failures)
