"""Draw Figure 2: a shape under several maps, and what their images keep of it."""

from gipkg.reporting.figures import figure2

import job
from subject import parametrizers, read_subject, write_figure

job.start(snakemake)
mesh = read_subject(snakemake)
spheres = {name: one.parametrize(mesh) for name, one in parametrizers(snakemake).items()}
comparison = figure2.compare(mesh, spheres, snakemake.params.size)
write_figure(snakemake, figure2.draw(comparison), comparison.parts)
