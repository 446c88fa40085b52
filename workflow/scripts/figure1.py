"""Draw Figure 1: a shape as images and back, and the curvature and topology of another."""

from pathlib import Path

from gipkg.files import write_csv
from gipkg.reporting.figures import figure1
from gipkg.reporting.records import as_table

import job
from meshes import mesh_of
from subject import parametrizers, read_surface, write_figure

job.start(snakemake)
(parametrizer,) = parametrizers(snakemake).values()
databases = snakemake.params.plugins["dataset"]


def imaged(number: int) -> figure1.Imaged:
    """Make the images of one of the two shapes."""
    surface = read_surface(snakemake, number)
    mesh = mesh_of(surface)
    sphere = parametrizer.parametrize(mesh)
    name = snakemake.params.databases[number]
    upright = job.plugin("dataset", databases[name]).upright is not None
    return figure1.image(mesh, surface["mask"], sphere, snakemake.params.size, upright=upright)


whole, holed = imaged(0), imaged(1)
pair = zip(snakemake.params.shapes, (whole, holed), strict=True)
shapes = [shown.row(shape) for shape, shown in pair]
write_csv(Path(snakemake.output.shapes), *as_table(shapes))
figure = figure1.draw(whole, holed, shapes)
write_figure(snakemake, figure, figure1.pixel_rows(whole, holed))
