"""Map the surfaces of one shard to the sphere."""

from pathlib import Path

from gipkg.shards import Arrays, Shard

import job
from meshes import mesh_of

job.start(snakemake)
parametrizer = job.plugin("parametrizer", snakemake.params.parametrizer)
surfaces = Shard.open(Path(snakemake.input[0]))


def spherical_map(shape_id: str) -> Arrays:
    """Map one surface."""
    return {"sphere": parametrizer.parametrize(mesh_of(surfaces[shape_id]))}


job.map_shapes(snakemake, surfaces.ids, spherical_map, surfaces.failures)
