"""Draw Figure 3: how methods lower the area distortion, iteration by iteration."""

from gipkg.reporting.figures import figure3

import job
from subject import parametrizers, read_subject, write_figure

job.start(snakemake)
mesh, shown = read_subject(snakemake), snakemake.params.config["shown"]
methods = [
    figure3.record(name, parametrizer, mesh, shown)
    for name, parametrizer in parametrizers(snakemake).items()
]
steps = [step for progress in methods for step in progress.steps]
write_figure(snakemake, figure3.draw(mesh, methods, snakemake.params.size), steps)
