"""Draw Figure 6: a shape with limbs and one that stands upright, under the cuts of the paper."""

from gipkg.reporting.figures import figure6

import job
from meshes import mesh_of
from subject import parametrizers, read_surface, write_figure

job.start(snakemake)
(parametrizer,) = parametrizers(snakemake).values()
meshes = [mesh_of(read_surface(snakemake, number)) for number in (0, 1)]
limbed, standing = (
    make(shape, mesh, parametrizer.parametrize(mesh), snakemake.params.size)
    for make, shape, mesh in zip(
        (figure6.cut, figure6.cut_upright), snakemake.params.shapes, meshes, strict=True
    )
)
views = [*limbed.views(), *standing.views()]
write_figure(snakemake, figure6.draw(limbed, standing), views)
