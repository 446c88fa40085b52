"""Compute the lower end of the Laplace-Beltrami spectrum of the surfaces of one shard."""

from dataclasses import asdict
from pathlib import Path

from gipkg.descriptors.operators import Operators
from gipkg.shards import Arrays, Shard

import job
from meshes import mesh_of

job.start(snakemake)
surfaces = Shard.open(Path(snakemake.input[0]))


def spectrum(shape_id: str) -> Arrays:
    """Solve the eigenproblem of one surface."""
    mesh = mesh_of(surfaces[shape_id])
    return asdict(Operators(mesh, snakemake.params.eigenpairs).spectrum)


job.map_shapes(snakemake, surfaces.ids, spectrum, surfaces.failures)
