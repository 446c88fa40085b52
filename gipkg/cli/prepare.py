"""``gipkg prepare``: any mesh to a closed genus-0 surface."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from gipkg.cli._batch import Facts, Job, convert, counted, joined, plan
from gipkg.cli._inputs import PREPARE, preparation
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.cli._plugins import assigned, parameter_option
from gipkg.formats import MESH_SUFFIXES


@click.command()
@files_argument("MESH")
@output_options(MESH_SUFFIXES)
@parameter_option
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    parameters: tuple[str, ...],
    as_json: bool,
) -> None:
    """Close and repair meshes: one component, oriented, genus 0.

    A mesh that is such a surface already is written as it is. Reads .ply .off .obj .stl .glb.
    Parameters are the keyword arguments of gipkg.prepare, such as -p method=volume, or
    -p method=volume -p components=joined where the parts of a shape do not touch.
    """
    options = preparation(assigned(parameters, [PREPARE])[PREPARE])
    jobs = plan(files, output, suffix, MESH_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.formats.mesh_writing import write_mesh
        from gipkg.surfaces import prepare

        surface = prepare(job.source, **options)
        write_mesh(job.target, surface.mesh)
        return surface.report.as_dict()

    convert("prepare", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    def parts() -> Iterator[str]:
        yield counted(facts["after"]["vertices"], "vertex")
        if facts["reason"]:
            yield f"by way of a volume ({facts['reason']})"
        for step in facts["steps"]:
            yield step["name"] + _figures(step["figures"])

    return joined(*parts())


def _figures(figures: Mapping[str, Any]) -> str:
    numbers = ((name, value) for name, value in figures.items() if isinstance(value, int | float))
    text = ", ".join(f"{name}: {value:.4g}" for name, value in numbers)
    return f" ({text})" if text else ""
