"""Measure the distortion of every map of a database under one method."""

from pathlib import Path

import numpy as np
from gipkg.evaluation.distortion import distortion
from gipkg.evaluation.histogram import area_histogram, bin_edges
from gipkg.files import read_csv, write_csv
from gipkg.progress import progress
from gipkg.reporting.shapes import MappedShape, write_shapes

import job
from meshes import Maps

job.start(snakemake)
maps = Maps(snakemake.input.surfaces, snakemake.input.maps)
clocks = [row for path in snakemake.input.seconds for row in read_csv(Path(path))]
seconds = {row["id"]: float(row["seconds"]) for row in clocks}

shapes = [
    MappedShape.failed(shape_id, maps.report(shape_id), reason)
    for shape_id, reason in maps.failures.items()
]
edges = bin_edges()
counts = np.zeros(len(edges) - 1, dtype=int)
for shape_id in progress(maps.ids, "distortion"):
    measured = distortion(maps[shape_id])
    counts += area_histogram(measured)
    report = maps.report(shape_id)
    shapes.append(MappedShape.mapped(shape_id, report, measured, seconds[shape_id]))

write_shapes(Path(snakemake.output.shapes), sorted(shapes, key=lambda shape: shape.id))
bins = zip(edges[:-1], edges[1:], counts, strict=True)
rows = [(f"{low:.4f}", f"{high:.4f}", count) for low, high, count in bins]
write_csv(Path(snakemake.output.histogram), ("from", "to", "triangles"), rows, sealed=True)
