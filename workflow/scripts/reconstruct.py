"""Measure what geometry images keep of some shapes: image, mesh again, distance."""

from pathlib import Path

from gipkg.datasets.selection import spread_over_classes
from gipkg.errors import GipkgError
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.files import write_csv
from gipkg.images.lookup import geometry_image
from gipkg.images.reconstruct import reconstruct
from gipkg.progress import progress

import job
from documents import read_listing
from meshes import Maps

job.start(snakemake)
maps = Maps(snakemake.input.surfaces, snakemake.input.maps)
params = snakemake.params


def figures(shape_id: str, size: int) -> tuple[str, str, str]:
    """Return Hausdorff distance, mean distance and why they could not be had, as text."""
    if shape_id in maps.failures:
        return "", "", maps.failures[shape_id]
    spherical_map = maps[shape_id]
    mesh = spherical_map.mesh
    try:
        image = geometry_image(spherical_map, mesh.vertices, size, sampling=params.sampling)
    except GipkgError as error:
        return "", "", f"{type(error).__name__}: {error}"
    distance = surface_distance(mesh, reconstruct(image))
    return f"{distance.hausdorff:.6g}", f"{distance.mean:.6g}", ""


listing = read_listing(snakemake.input.shapes)
chosen = spread_over_classes(listing, params.shapes)
rows = [
    (shape_id, size, *figures(shape_id, size))
    for shape_id in progress(chosen, "reconstruction")
    for size in params.sizes
]
header = ("id", "size", "hausdorff", "mean", "failure")
write_csv(Path(snakemake.output[0]), header, rows, sealed=True)
