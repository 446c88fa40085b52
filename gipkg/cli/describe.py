"""``gipkg describe``: meshes to channels at their vertices."""

from __future__ import annotations

from pathlib import Path

import click

from gipkg.cli._batch import Facts, Job, convert, counted, joined, plan
from gipkg.cli._inputs import PREPARE, preparation, read_surface, repairs
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.cli._plugins import assigned, build, parameter_option, plugin_option, resolve
from gipkg.formats import CHANNEL_SUFFIXES


@click.command()
@files_argument("MESH")
@output_options(CHANNEL_SUFFIXES)
@plugin_option(
    "-d",
    "--descriptor",
    kind="descriptor",
    default="hks",
    show_default=True,
    help="The descriptor, or FILE.py:CLASS.",
)
@parameter_option
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    descriptor: str,
    parameters: tuple[str, ...],
    as_json: bool,
) -> None:
    """Compute a descriptor at every vertex.

    A mesh that is no closed genus-0 surface is repaired first, as by gipkg prepare, whose
    parameters are -p prepare.KEY=VALUE; the rows are those of the repaired mesh.
    """
    name = resolve("descriptor", descriptor)
    chosen = assigned(parameters, [name, PREPARE])
    plugin = build("descriptor", name, chosen[name])
    options = preparation(chosen[PREPARE])
    jobs = plan(files, output, suffix, CHANNEL_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.descriptors.operators import Operators
        from gipkg.formats.channels import write_channels

        surface, facts = read_surface(job.source, options)
        channels = plugin.describe(surface.mesh, Operators(surface.mesh, mask=surface.mask))
        write_channels(job.target, channels, plugin.channels())
        return {"descriptor": name, "channels": list(plugin.channels()), **facts}

    convert("describe", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    channels = f"{counted(len(facts['channels']), 'channel')} of {facts['descriptor']}"
    return joined(counted(facts["vertices"], "vertex"), channels, repairs(facts))
