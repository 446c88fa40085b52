"""Turn the shapes of one shard into closed genus-0 surfaces, upright ones with z up."""

import json
from pathlib import Path

import numpy as np
from gipkg.files import read_csv
from gipkg.shards import Arrays
from gipkg.surfaces import prepare
from gipkg.surfaces.upright import with_z_up

import job

job.start(snakemake)
dataset = job.plugin("dataset", snakemake.params.dataset)
root = Path(snakemake.config["data_root"])


def surface(shape_id: str) -> Arrays:
    """Prepare one mesh or volume of the database."""
    surface = prepare(dataset.load(root, shape_id), **snakemake.params.options)
    vertices = np.asarray(surface.mesh.vertices)
    return {
        "vertices": with_z_up(vertices, dataset.upright) if dataset.upright else vertices,
        "faces": np.asarray(surface.mesh.faces),
        "mask": surface.mask,
        "report": np.array(json.dumps(surface.report.as_dict())),
    }


rows = read_csv(Path(snakemake.input[0]))
ids = [row["id"] for row in rows if row["shard"] == snakemake.wildcards.shard]
job.map_shapes(snakemake, ids, surface, {})
