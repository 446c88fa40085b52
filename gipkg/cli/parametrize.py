"""``gipkg parametrize``: meshes to spherical maps."""

from __future__ import annotations

from pathlib import Path

import click

from gipkg.cli._batch import Facts, Job, convert, counted, joined, plan
from gipkg.cli._inputs import PREPARE, preparation, read_surface, repairs
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.cli._plugins import assigned, build, method_option, parameter_option, resolve
from gipkg.formats import MAP_SUFFIXES


@click.command()
@files_argument("MESH")
@output_options(MAP_SUFFIXES)
@method_option
@parameter_option
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    method: str,
    parameters: tuple[str, ...],
    as_json: bool,
) -> None:
    """Map meshes to the unit sphere.

    A mesh that is no closed genus-0 surface is repaired first, as by gipkg prepare, whose
    parameters are -p prepare.KEY=VALUE. The map file holds the surface and its sphere: an .npz
    with vertices, faces and sphere, or a .ply that shows the sphere in any viewer.
    """
    name = resolve("parametrizer", method)
    chosen = assigned(parameters, [name, PREPARE])
    parametrizer = build("parametrizer", name, chosen[name])
    options = preparation(chosen[PREPARE])
    jobs = plan(files, output, suffix, MAP_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.api import SphericalMap
        from gipkg.formats.maps import write_map

        surface, facts = read_surface(job.source, options)
        sphere = parametrizer.parametrize(surface.mesh)
        write_map(job.target, SphericalMap(surface.mesh, sphere))
        return {"method": name, **facts}

    convert("parametrize", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    return joined(counted(facts["vertices"], "vertex"), facts["method"], repairs(facts))
