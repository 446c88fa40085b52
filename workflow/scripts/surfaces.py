"""Turn the shapes of one shard into closed genus-0 surfaces."""

import json
from pathlib import Path

import numpy as np
from gipkg.files import read_csv
from gipkg.shards import Arrays
from gipkg.surfaces import prepare

import job

job.start(snakemake)
dataset = job.plugin("dataset", snakemake.params.dataset)
root = Path(snakemake.config["data_root"])


def surface(shape_id: str) -> Arrays:
    """Prepare one mesh or volume of the database."""
    surface = prepare(dataset.load(root, shape_id))
    return {
        "vertices": np.asarray(surface.mesh.vertices),
        "faces": np.asarray(surface.mesh.faces),
        "mask": surface.mask,
        "report": np.array(json.dumps(surface.report.as_dict())),
    }


rows = read_csv(Path(snakemake.input[0]))
ids = [row["id"] for row in rows if row["shard"] == snakemake.wildcards.shard]
job.map_shapes(snakemake, ids, surface, {})
