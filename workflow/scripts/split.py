"""Split a database into a training and a test part, at random or as it is published."""

from pathlib import Path

from gipkg.api import Shape
from gipkg.datasets import split
from gipkg.files import read_csv, write_csv

import job

job.start(snakemake)
shapes = [
    Shape(row["id"], row["label"], row["part"] or None)
    for row in read_csv(Path(snakemake.input[0]))
]
seed = int(snakemake.wildcards.seed)
train, _ = split(shapes, snakemake.params.train_per_class, seed)
training = frozenset(train)
rows = [(one.id, one.label, "train" if one.id in training else "test") for one in shapes]
write_csv(Path(snakemake.output[0]), ("id", "label", "part"), rows)
