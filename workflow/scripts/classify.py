"""Train a linear support vector machine on one split and predict its test part."""

from gipkg.baselines.svm import classify

import job
from samples import Features, read_split, write_prediction

job.start(snakemake)
features = Features(snakemake.input.representations, "representation")
labels = read_split(snakemake.input.split, "train")
test = read_split(snakemake.input.split, "test")
prediction = classify(
    features,
    labels,
    [shape_id for shape_id in labels if shape_id in features],
    [shape_id for shape_id in test if shape_id in features],
    seed=int(snakemake.wildcards.seed),
)
write_prediction(snakemake.output[0], prediction)
