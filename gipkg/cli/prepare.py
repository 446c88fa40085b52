"""``gipkg prepare``: any mesh to a closed genus-0 surface."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from gipkg.cli._batch import Facts, Job, convert, counted, joined, plan
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.formats import MESH_SUFFIXES

share = click.FloatRange(0, 1)


@click.command()
@files_argument("MESH")
@output_options(MESH_SUFFIXES)
@click.option(
    "--method",
    type=click.Choice(["auto", "repair", "volume"]),
    default="auto",
    show_default=True,
    help="Repair, remake through voxels, or through voxels where repair fails or loses parts.",
)
@click.option(
    "--resolution",
    type=click.IntRange(10, 300),
    default=100,
    show_default=True,
    help="Voxels along the longest side of a mesh that is remade.",
)
@click.option(
    "--vertices",
    type=click.IntRange(4),
    default=3000,
    show_default=True,
    help="Most vertices of a mesh that is remade.",
)
@click.option(
    "--components",
    type=click.Choice(["largest", "joined"]),
    default="largest",
    show_default=True,
    help="What becomes of the parts of a mesh that is remade: strands can join them.",
)
@click.option(
    "--merge-tolerance",
    type=share,
    default=1e-7,
    show_default=True,
    help="Largest distance of border vertices that are merged, in bounding box diagonals.",
)
@click.option(
    "--smallest-part",
    type=share,
    default=0.5,
    show_default=True,
    help="Least share of the area that the largest part has; the others are dropped.",
)
@click.option(
    "--largest-hole",
    type=share,
    default=0.4,
    show_default=True,
    help="Largest share of the area that the cap over a hole has.",
)
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    as_json: bool,
    **options: Any,
) -> None:
    """Close and repair meshes: one component, oriented, genus 0.

    A mesh that is such a surface already is written as it is, unless --method volume asks for
    voxels. Reads all that trimesh reads (.off .obj .ply .stl .glb ...).
    """
    jobs = plan(files, output, suffix, MESH_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.formats.meshes import write_mesh
        from gipkg.surfaces import prepare

        surface = prepare(job.source, **options)
        write_mesh(job.target, surface.mesh)
        return surface.report.as_dict()

    convert("prepare", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    def parts() -> Iterator[str]:
        yield counted(facts["after"]["vertices"], "vertex")
        for step in facts["steps"]:
            numbers = step["figures"].items()
            figures = (f"{name}: {value:.4g}" for name, value in numbers if not _is_list(value))
            yield f"{step['name']} ({', '.join(figures)})"

    return joined(parts())


def _is_list(value: object) -> bool:
    return isinstance(value, list)
