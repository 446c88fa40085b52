"""Split what takes part of a database into a training and a test part."""

from pathlib import Path

from gipkg.api import Protocol, Shape
from gipkg.datasets import split
from gipkg.files import read_csv, write_csv

import job

job.start(snakemake)
shapes = [
    Shape(row["id"], row["label"], row["part"] or None)
    for row in read_csv(Path(snakemake.input[0]))
]
seed = int(snakemake.wildcards.seed)
train, test = split(shapes, Protocol(**snakemake.params.protocol), seed)
part = dict.fromkeys(train, "train") | dict.fromkeys(test, "test")
rows = [(one.id, one.label, part[one.id]) for one in shapes if one.id in part]
write_csv(Path(snakemake.output[0]), ("id", "label", "part"), rows, sealed=True)
