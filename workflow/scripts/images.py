"""Render the geometry images of one shard, one for each cut."""

from pathlib import Path

import numpy as np
from gipkg.api import SphericalMap
from gipkg.images.config import ImageConfig
from gipkg.images.lookup import lookup
from gipkg.shards import Arrays, Shard, join

import job
from meshes import mesh_of

job.start(snakemake)
surfaces = Shard.open(Path(snakemake.input.surfaces))
maps = Shard.open(Path(snakemake.input.maps))
descriptors = [Shard.open(Path(path)) for path in snakemake.input.descriptors]
chosen = ImageConfig(**snakemake.params.images)


def images(shape_id: str) -> Arrays:
    """Render all channels of one surface, (cuts, C, size, size) float32."""
    spherical_map = SphericalMap(mesh_of(surfaces[shape_id]), maps[shape_id]["sphere"])
    channels = np.hstack([shard[shape_id]["channels"] for shard in descriptors])
    cuts = chosen.choose(spherical_map, shape_id)
    pixels = lookup(spherical_map, chosen.size, cuts, chosen.sampling)
    return {"images": pixels.render(channels)}


ids, failures = join(surfaces, maps, *descriptors)
job.map_shapes(snakemake, ids, images, failures)
