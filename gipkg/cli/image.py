"""``gipkg image``: meshes or spherical maps to geometry images."""

from __future__ import annotations

from pathlib import Path

import click

from gipkg.cli._batch import Facts, Job, convert, counted, joined, plan
from gipkg.cli._inputs import PREPARE, preparation, read_map, repairs
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.cli._plugins import (
    assigned,
    build,
    method_option,
    parameter_option,
    plugin_option,
    resolve,
)
from gipkg.formats import IMAGE_SUFFIXES
from gipkg.images.sampling import SAMPLINGS, Sampling

POSITIONS = ("x", "y", "z")


@click.command()
@files_argument("MESH_OR_MAP")
@output_options(IMAGE_SUFFIXES)
@click.option(
    "--size", type=click.IntRange(3, 8192), default=128, show_default=True, help="Pixels a side."
)
@plugin_option(
    "-d",
    "--descriptor",
    "descriptors",
    kind="descriptor",
    multiple=True,
    help="Show this descriptor and not the positions; several become channels one after another.",
)
@method_option
@parameter_option
@click.option(
    "--sampling",
    type=click.Choice(SAMPLINGS),
    default="equal-area",
    show_default=True,
    help="How the square wraps the sphere.",
)
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    size: int,
    descriptors: tuple[str, ...],
    method: str,
    parameters: tuple[str, ...],
    sampling: Sampling,
    as_json: bool,
) -> None:
    """Make geometry images of positions, or of descriptors.

    Of a map by gipkg parametrize, or of any mesh, which is repaired and mapped first. -p is for
    the method, or NAME.KEY=VALUE for a descriptor or the repair: -p hks.times=3.
    """
    name = resolve("parametrizer", method)
    shown = [resolve("descriptor", descriptor) for descriptor in descriptors]
    chosen = assigned(parameters, [name, PREPARE, *shown])
    parametrizer = build("parametrizer", name, chosen[name])
    options = preparation(chosen[PREPARE])
    plugins = [build("descriptor", descriptor, chosen[descriptor]) for descriptor in shown]
    channels = [channel for plugin in plugins for channel in plugin.channels()] or list(POSITIONS)
    jobs = plan(files, output, suffix, IMAGE_SUFFIXES)
    if jobs[0].target.suffix.lower() == ".png" and len(channels) not in (1, 3):
        raise click.UsageError(
            f"a PNG holds 1 or 3 channels, not {len(channels)} ({', '.join(channels)}); "
            ".npy and .tiff hold any number"
        )

    def work(job: Job) -> Facts:
        import numpy as np

        from gipkg.descriptors.operators import Operators
        from gipkg.formats.images import write_image
        from gipkg.images.lookup import geometry_image

        spherical_map, mask, facts = read_map(job.source, parametrizer, options)
        mesh = spherical_map.mesh
        operators = Operators(mesh, mask=mask)
        values = [plugin.describe(mesh, operators) for plugin in plugins] or [mesh.vertices]
        image = geometry_image(spherical_map, np.hstack(values), size, sampling=sampling)
        write_image(job.target, image)
        return {"shape": list(image.shape), "channels": channels, **facts}

    convert("image", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    count, size, _ = facts["shape"]
    return joined(f"{counted(count, 'channel')} of {size} x {size}", repairs(facts))
