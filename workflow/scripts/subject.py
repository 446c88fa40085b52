"""The shapes of Figures 1 to 6 and of the page, and the files that each of them is."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import trimesh
from gipkg.errors import DatasetNotFound
from gipkg.files import write_csv
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.records import as_table
from gipkg.shards import Arrays, Shard

import job
from documents import write_provenance
from meshes import mesh_of

if TYPE_CHECKING:
    from gipkg.api import Parametrizer
    from matplotlib.figure import Figure


def read_surface(snakemake: Any, number: int = 0, section: str = "figures") -> Arrays:
    """Return the surface of one of the shapes that a section of the configuration names."""
    surfaces = Shard.open(Path(snakemake.input[number]))
    shape = snakemake.params.shapes[number]
    if shape not in surfaces:
        reason = surfaces.failures.get(shape, "the database has no such shape")
        raise DatasetNotFound(
            f"configuration, {section}: {shape!r} has no surface: {reason}; name another"
        )
    return surfaces[shape]


def read_subject(snakemake: Any) -> trimesh.Trimesh:
    """Return the surface of the one shape of a figure."""
    return mesh_of(read_surface(snakemake))


def parametrizers(snakemake: Any) -> dict[str, Parametrizer]:
    """Return the methods of a figure, in the order of the configuration."""
    plugins = snakemake.params.plugins["parametrizer"]
    names = snakemake.params.config["parametrizers"]
    return {name: job.plugin("parametrizer", plugins[name]) for name in names}


def write_figure(snakemake: Any, figure: Figure, records: Sequence[Any]) -> None:
    """Write a figure, what it shows as numbers, and where it comes from."""
    write_csv(Path(snakemake.output.csv), *as_table(records))
    write_png(Path(snakemake.output.png), figure)
    params = snakemake.params
    path = snakemake.output.provenance
    write_provenance(path, params, shapes=params.shapes, size=params.size)
