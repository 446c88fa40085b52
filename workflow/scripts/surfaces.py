"""Turn the shapes of one shard into closed genus-0 surfaces, upright ones with z up."""

from pathlib import Path

from gipkg.files import read_csv
from gipkg.shards import Arrays
from gipkg.surfaces import prepare
from gipkg.surfaces.upright import with_z_up

import job
from meshes import surface_arrays

job.start(snakemake)
dataset = job.plugin("dataset", snakemake.params.dataset)
root = Path(snakemake.config["data_root"])


def surface(shape_id: str) -> Arrays:
    """Prepare one mesh or volume of the database."""
    arrays = surface_arrays(prepare(dataset.load(root, shape_id), **snakemake.params.options))
    if dataset.upright:
        return {**arrays, "vertices": with_z_up(arrays["vertices"], dataset.upright)}
    return arrays


rows = read_csv(Path(snakemake.input[0]))
ids = [row["id"] for row in rows if row["shard"] == snakemake.wildcards.shard]
job.map_shapes(snakemake, ids, surface, {})
