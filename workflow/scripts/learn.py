"""Train a network on one part of a split, predict the other, and keep the network."""

from pathlib import Path

from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.model import train_model
from gipkg.learning.prediction import Prediction

import job
from samples import Features, predict_test_part

job.start(snakemake)
network = NetworkConfig(**snakemake.params.network["network"])
training = TrainingConfig(**snakemake.params.network["training"])


def predict(images: Features, train: dict[str, str], test: tuple[str, ...], **how) -> Prediction:
    """Train on the geometry images."""
    model = train_model(images, train, tuple(train), network=network, training=training, **how)
    model.save(Path(snakemake.output.model), about={"images": snakemake.params.recipe})
    return model.predict(images, test)


predict_test_part(snakemake, Features(snakemake.input.images, "images"), predict)
