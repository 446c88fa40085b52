"""Train a baseline on surfaces as they are and predict perturbed test shapes."""

import job
from samples import Features, read_split, write_prediction

job.start(snakemake)
baseline = job.plugin("baseline", snakemake.params.baseline)
clean = Features(snakemake.input.clean, "representation")
perturbed = Features([snakemake.input.perturbed], "representation")
parts = (read_split(snakemake.input.split, part) for part in ("train", "test"))
train, test = (
    {shape_id: part[shape_id] for shape_id in part if shape_id in known}
    for part, known in zip(parts, (clean, perturbed), strict=True)
)
# A shape that trains here may be a test shape, and perturbed, in another split.
known = {shape_id: clean[shape_id] for shape_id in train}
known |= {shape_id: perturbed[shape_id] for shape_id in test}
prediction = baseline.predict(known, train, tuple(test), seed=int(snakemake.wildcards.seed))
write_prediction(snakemake.output[0], prediction)
