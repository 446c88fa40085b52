"""List the shapes of a database: class, part of the official split if there is one, shard."""

from pathlib import Path

from gipkg.files import write_csv
from gipkg.shards import shard_of

import job

job.start(snakemake)
dataset = job.plugin("dataset", snakemake.params.dataset)
root = Path(snakemake.config["data_root"])
if not dataset.available(root):
    dataset.fetch(root)
rows = [
    (shape.id, shape.label, shape.part or "", shard_of(shape.id, snakemake.params.shards))
    for shape in dataset.shapes(root)
]
write_csv(Path(snakemake.output[0]), ("id", "label", "part", "shard"), rows, sealed=True)
