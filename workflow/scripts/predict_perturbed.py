"""Show perturbed test shapes to a network that was trained on surfaces as they are."""

from pathlib import Path

from gipkg.learning.model import load_model

import job
from samples import Features, read_split, write_prediction

job.start(snakemake)
images = Features([snakemake.input.images], "images")
test = [shape_id for shape_id in read_split(snakemake.input.split, "test") if shape_id in images]
model = load_model(Path(snakemake.input.model))
write_prediction(snakemake.output[0], model.predict(images, test))
