"""The one shape of Figures 2 to 4, and the files that each of them is."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import trimesh
from gipkg.errors import DatasetNotFound
from gipkg.files import write_csv, write_json
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.provenance import environment
from gipkg.reporting.records import as_table
from gipkg.shards import Shard

import job
from meshes import mesh_of

if TYPE_CHECKING:
    from gipkg.api import Parametrizer
    from matplotlib.figure import Figure


def read_subject(snakemake: Any) -> trimesh.Trimesh:
    """Return the surface of the shape that the configuration names."""
    surfaces, shape = Shard.open(Path(snakemake.input[0])), snakemake.params.shape
    if shape not in surfaces:
        reason = surfaces.failures.get(shape, "the database has no such shape")
        raise DatasetNotFound(f"configuration, figures.shapes: {shape!r} has no surface: {reason}")
    return mesh_of(surfaces[shape])


def parametrizers(snakemake: Any) -> dict[str, Parametrizer]:
    """Return the methods of a figure, in the order of the configuration."""
    plugins = snakemake.params.plugins["parametrizer"]
    names = snakemake.params.config["parametrizers"]
    return {name: job.plugin("parametrizer", plugins[name]) for name in names}


def write_figure(snakemake: Any, figure: Figure, records: Sequence[Any]) -> None:
    """Write a figure, what it shows as numbers, and where it comes from."""
    write_csv(Path(snakemake.output.csv), *as_table(records))
    write_png(Path(snakemake.output.png), figure)
    chosen = {name: snakemake.params[name] for name in ("shape", "size", "config", "plugins")}
    write_json(Path(snakemake.output.provenance), {**environment(), **chosen})
