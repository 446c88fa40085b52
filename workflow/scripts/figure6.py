"""Draw Figure 6: a shape under the cuts of the paper."""

from gipkg.reporting.figures import figure6

import job
from subject import parametrizers, read_subject, write_figure

job.start(snakemake)
mesh = read_subject(snakemake)
(parametrizer,) = parametrizers(snakemake).values()
cuts = figure6.cut(mesh, parametrizer.parametrize(mesh), snakemake.params.size)
write_figure(snakemake, figure6.draw(cuts), cuts.views())
