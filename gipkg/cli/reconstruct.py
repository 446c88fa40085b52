"""``gipkg reconstruct``: geometry images of positions back to meshes."""

from __future__ import annotations

from pathlib import Path

import click

from gipkg.cli._batch import Facts, Job, convert, counted, plan
from gipkg.cli._options import files_argument, json_option, output_options
from gipkg.formats import MESH_SUFFIXES


@click.command()
@files_argument("IMAGE")
@output_options(MESH_SUFFIXES)
@json_option
def command(
    files: tuple[Path, ...], output: Path, suffix: str | None, force: bool, as_json: bool
) -> None:
    """Make closed meshes of geometry images.

    The images are of positions: .npy, .tiff, or a .png by gipkg image.
    """
    jobs = plan(files, output, suffix, MESH_SUFFIXES)

    def work(job: Job) -> Facts:
        from gipkg.errors import ImageFormatError
        from gipkg.formats.images import read_image
        from gipkg.formats.mesh_writing import write_mesh
        from gipkg.images.reconstruct import reconstruct

        image = read_image(job.source)
        if len(image) != 3:
            raise ImageFormatError(
                f"{job}: {len(image)} channels are no positions x, y, z; gipkg image makes an "
                "image of positions unless a descriptor is named"
            )
        mesh = reconstruct(image)
        write_mesh(job.target, mesh)
        return {"vertices": len(mesh.vertices), "faces": len(mesh.faces)}

    convert("reconstruct", jobs, work, say=_say, force=force, as_json=as_json)


def _say(facts: Facts) -> str:
    return counted(facts["vertices"], "vertex")
