"""Draw Figure 7: some shapes and what images keep of them, and the distortion of all."""

from pathlib import Path

import numpy as np
from gipkg.datasets.selection import spread_over_classes
from gipkg.files import read_csv, write_csv
from gipkg.progress import progress
from gipkg.reporting.figures import figure7
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.shapes import read_shapes
from gipkg.reporting.table_distortion import summarise

import job
from documents import read_listing, write_provenance
from meshes import Maps

job.start(snakemake)
files, params = snakemake.input, snakemake.params
count = len(files.surfaces)
maps = {
    method: Maps(files.surfaces, files.maps[number * count : (number + 1) * count])
    for number, method in enumerate(params.methods)
}
first = maps[params.methods[0]]
listing = read_listing(files.shapes)
surfaces = [shape for shape in listing if shape.id in first.surfaces]
panels = [
    figure7.reconstruct_panel(
        shape_id,
        first.mesh(shape_id),
        {name: one[shape_id] if shape_id in one.ids else None for name, one in maps.items()},
        params.config["pictures"]["size"],
        params.sampling,
    )
    for shape_id in progress(
        spread_over_classes(surfaces, params.config["pictures"]["shapes"]), "pictures"
    )
]

cells = [(database, method) for database in params.databases for method in params.methods]
histograms: dict[str, dict[str, np.ndarray]] = {database: {} for database in params.databases}
variances = {}
for cell, histogram, figures in zip(cells, files.histograms, files.figures, strict=True):
    database, method = cell
    counts = [int(row["triangles"]) for row in read_csv(Path(histogram))]
    histograms[database][method] = np.array(counts)
    variances[cell] = summarise(*cell, read_shapes(Path(figures))).variance

write_png(Path(snakemake.output.png), figure7.draw(panels, histograms, variances))
rows = figure7.histogram_rows(histograms)
write_csv(Path(snakemake.output.csv), figure7.HISTOGRAM_HEADER, rows)
write_csv(Path(snakemake.output.shapes), figure7.SHAPE_HEADER, figure7.shape_rows(panels))
write_provenance(snakemake.output.provenance, params)
