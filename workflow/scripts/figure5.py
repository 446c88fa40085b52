"""Draw Figure 5: a half turn, a bend, and padding."""

from gipkg.reporting.figures import figure5

import job
from subject import parametrizers, read_subject, write_figure

job.start(snakemake)
(parametrizer,) = parametrizers(snakemake).values()
properties = figure5.compare(read_subject(snakemake), parametrizer, snakemake.params.size)
write_figure(snakemake, figure5.draw(properties), properties.claims())
