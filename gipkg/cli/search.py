"""``gipkg search``: the shapes of an index that are nearest to a mesh."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import click

from gipkg.cli._batch import Facts, for_each, plan, printable, require_absent
from gipkg.cli._extras import require
from gipkg.cli._options import (
    PICTURE_SUFFIXES,
    allow_option,
    files_argument,
    force_option,
    json_option,
)
from gipkg.cli.index import FILE_NAME


@click.command()
@files_argument("MODEL")
@click.option(
    "--index",
    "index_file",
    required=True,
    type=click.Path(path_type=Path),
    help="An index by gipkg index, or the folder that it is in.",
)
@click.option(
    "-n", "--count", type=click.IntRange(1, 100), default=10, show_default=True, help="Hits."
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    help="A PNG with pictures of the hits, or a folder for those of several models.",
)
@force_option
@allow_option
@json_option
def command(
    files: tuple[Path, ...],
    index_file: Path,
    count: int,
    output: Path | None,
    force: bool,
    allowed: tuple[str, ...],
    as_json: bool,
) -> None:
    """Find the shapes of an index nearest to a mesh.

    Shapes are compared by their signatures, which a trained network makes.
    """
    require("learn", "torch")
    if output is not None:
        require("figures", "pyvista", "matplotlib")
    from gipkg.search.index import Index
    from gipkg.search.network import SignatureNetwork

    jobs = plan(files, output, None, PICTURE_SUFFIXES) if output else []
    sheets = {job.source: job.target for job in jobs}
    if index_file.is_dir():
        index_file = index_file / FILE_NAME
    index = Index.read(index_file)
    network = SignatureNetwork.of(index.network, allowed)
    if network.key != index.key:
        raise click.ClickException(
            f"{index_file} was made by another version of gipkg: gipkg index --force makes it again"
        )
    folder = index_file.parent / index.folder

    def work(path: Path) -> Facts:
        sheet = sheets.get(path)
        if sheet is not None:
            require_absent(sheet, force)
        signature = network.signature(path)
        hits = index.nearest(signature.embedding, count)
        if sheet is not None:
            from gipkg.reporting.figures.layout import write_png
            from gipkg.reporting.sheet import Shown, draw

            found = [
                Shown(folder / hit.name, _caption(n, hit.distance), hit.name)
                for n, hit in enumerate(hits, 1)
            ]
            write_png(
                sheet, draw([Shown(path, f"looks like {signature.label}", path.name), *found])
            )
        return {
            "class": signature.label,
            "hits": [asdict(hit) for hit in hits],
            "output": None if sheet is None else str(sheet),
        }

    for_each("search", files, work, say=_say, as_json=as_json)


def _caption(number: int, distance: float) -> str:
    return f"{number}: {distance:.3g}"


def _say(facts: Facts) -> str:
    lines = [f"looks like {facts['class']}; nearest:"]
    for number, hit in enumerate(facts["hits"], start=1):
        name = printable(hit["name"])
        lines.append(f"{number:4}  {hit['distance']:.4f}  {name} ({hit['label']})")
    return "\n".join(lines)
