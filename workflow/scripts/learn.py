"""Train a network on one split and predict its test part."""

from pathlib import Path

from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.experiment import train_and_predict

import job
from samples import Features, read_split, write_prediction

job.start(snakemake)
images = Features(snakemake.input.images, "images")
labels = read_split(snakemake.input.split, "train")
test = read_split(snakemake.input.split, "test")
checkpoint = Path(snakemake.output[0]).with_suffix(".pt")
prediction = train_and_predict(
    images,
    labels,
    [shape_id for shape_id in labels if shape_id in images],
    [shape_id for shape_id in test if shape_id in images],
    network=NetworkConfig(**snakemake.params.network["network"]),
    training=TrainingConfig(**snakemake.params.network["training"]),
    seed=int(snakemake.wildcards.seed),
    checkpoint=checkpoint,
)
write_prediction(snakemake.output[0], prediction)
checkpoint.unlink(missing_ok=True)
