"""Score the predictions of a column under one protocol, one for each seed."""

from dataclasses import asdict
from pathlib import Path

from gipkg.evaluation.scores import score
from gipkg.files import write_json

import job
from samples import read_prediction, read_split

job.start(snakemake)
runs = zip(snakemake.params.seeds, snakemake.input.predictions, snakemake.input.splits, strict=True)
scores = [
    {"seed": seed} | asdict(score(read_prediction(prediction), read_split(split, "test")))
    for seed, prediction, split in runs
]
write_json(Path(snakemake.output[0]), scores, sealed=True)
