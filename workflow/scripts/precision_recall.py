"""Draw the precision-recall curves of a table: Figure 8 of Table 1."""

from pathlib import Path

from gipkg.files import write_csv
from gipkg.reporting.figures import precision_recall
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.records import as_table
from gipkg.reporting.score_table import own_columns

import job
from documents import read_sealed, write_provenance

job.start(snakemake)
params = snakemake.params
cells = [(*row, column["column"]) for row in params.rows for column in params.config["columns"]]
points = [
    point
    for cell, path in zip(cells, snakemake.input, strict=True)
    for point in precision_recall.curve(*cell, read_sealed(path))
]
own = own_columns(params.config["columns"])
write_csv(Path(snakemake.output.csv), *as_table(points))
write_png(Path(snakemake.output.png), precision_recall.draw(points, own))
write_provenance(snakemake.output.provenance, params)
