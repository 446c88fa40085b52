"""Train a network on one split and predict its test part."""

from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.experiment import train_and_predict
from gipkg.learning.prediction import Prediction

import job
from samples import Features, predict_test_part

job.start(snakemake)
network = NetworkConfig(**snakemake.params.network["network"])
training = TrainingConfig(**snakemake.params.network["training"])


def predict(images: Features, train: dict[str, str], test: tuple[str, ...], **how) -> Prediction:
    """Train on the geometry images."""
    chosen = {"network": network, "training": training}
    return train_and_predict(images, train, tuple(train), test, **chosen, **how)


predict_test_part(snakemake, Features(snakemake.input.images, "images"), predict)
