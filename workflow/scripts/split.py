"""Split what takes part of a database into a training and a test part."""

from pathlib import Path

from gipkg.api import Protocol
from gipkg.datasets import split
from gipkg.files import write_csv

import job
from documents import read_listing

job.start(snakemake)
shapes = read_listing(snakemake.input[0])
seed = int(snakemake.wildcards.seed)
train, test = split(shapes, Protocol(**snakemake.params.protocol), seed)
part = dict.fromkeys(train, "train") | dict.fromkeys(test, "test")
rows = [(one.id, one.label, part[one.id]) for one in shapes if one.id in part]
write_csv(Path(snakemake.output[0]), ("id", "label", "part"), rows, sealed=True)
