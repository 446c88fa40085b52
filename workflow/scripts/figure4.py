"""Draw Figure 4: the flow that restores the areas of one map, and the unfolding of another."""

from gipkg.api import SphericalMap
from gipkg.reporting.figures import figure4

import job
from subject import parametrizers, read_subject, write_figure

job.start(snakemake)
mesh = read_subject(snakemake)
start, unfolded = (
    SphericalMap(mesh, one.parametrize(mesh)) for one in parametrizers(snakemake).values()
)
explanation = figure4.explain(start, unfolded)
write_figure(snakemake, figure4.draw(explanation, snakemake.params.size), explanation.rows())
