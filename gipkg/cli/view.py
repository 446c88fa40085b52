"""``gipkg view``: pictures of meshes, spherical maps and geometry images."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gipkg.cli._batch import Facts, Job, convert, plan
from gipkg.cli._extras import require
from gipkg.cli._options import PICTURE_SUFFIXES, files_argument, json_option, output_options
from gipkg.formats import IMAGE_SUFFIXES

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@click.command()
@files_argument("FILE")
@output_options(PICTURE_SUFFIXES)
@click.option(
    "--size", type=click.IntRange(32, 4096), default=512, show_default=True, help="Pixels a panel."
)
@json_option
def command(
    files: tuple[Path, ...],
    output: Path,
    suffix: str | None,
    force: bool,
    size: int,
    as_json: bool,
) -> None:
    """Draw meshes, maps and geometry images.

    Of a mesh: the mesh. Of a map: mesh, sphere and geometry image in the same colours. Of an
    image of positions: the image and its mesh; of another image: its channels. No display is
    needed.
    """
    require("figures", "pyvista", "matplotlib")
    jobs = plan(files, output, suffix, PICTURE_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.files import atomic
        from gipkg.formats.png import encode_png

        picture = _draw(job.source, size)
        with atomic(job.target) as stream:
            stream.write(encode_png(picture, {}))
        return {"width": picture.shape[1], "height": picture.shape[0]}

    convert("view", jobs, work, say=_say, force=force, as_json=as_json)


def _draw(path: Path, size: int) -> NDArray[np.uint8]:
    from gipkg.formats.images import read_image
    from gipkg.formats.maps import is_map, read_map
    from gipkg.formats.mesh_reading import read_mesh
    from gipkg.reporting import pictures

    if path.suffix.lower() in IMAGE_SUFFIXES:
        return pictures.of_image(read_image(path), size)
    if is_map(path):
        return pictures.of_map(read_map(path), size)
    return pictures.of_mesh(read_mesh(path), size)


def _say(facts: Facts) -> str:
    return f"{facts['width']} x {facts['height']} pixels"
