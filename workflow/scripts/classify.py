"""Train a baseline on one split and predict its test part."""

import job
from samples import Features, predict_test_part

job.start(snakemake)
baseline = job.plugin("baseline", snakemake.params.baseline)
representations = Features(snakemake.input.representations, "representation")
predict_test_part(snakemake, representations, baseline.predict)
