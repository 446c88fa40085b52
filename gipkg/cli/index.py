"""``gipkg index``: the signatures of a folder of meshes, to be searched."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gipkg.cli._batch import Facts, for_each
from gipkg.cli._extras import require
from gipkg.cli._options import allow_option, json_option
from gipkg.formats import MESH_SUFFIXES

if TYPE_CHECKING:
    from gipkg.search.index import Index
    from gipkg.search.network import SignatureNetwork

FILE_NAME = "gipkg-index.npz"
SECONDS_BETWEEN_WRITES = 10.0


@click.command()
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option(
    "--network",
    "network_file",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="A trained network, results/learning/.../*.model.npz; not needed for an index that is "
    "there, which holds its own.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(dir_okay=False, path_type=Path),
    help=f"The index; FOLDER/{FILE_NAME} by default.",
)
@allow_option
@click.option("--force", is_flag=True, help="Replace an index of another network.")
@json_option
def command(
    folder: Path,
    network_file: Path | None,
    output: Path | None,
    allowed: tuple[str, ...],
    force: bool,
    as_json: bool,
) -> None:
    """Index a folder of meshes, for gipkg search.

    All meshes in the folder and below are kept by what a trained network makes of them. Run
    again, it goes on where it was stopped, and takes in what is new or has changed. Where the
    network learned from shapes that stand upright, the meshes have to stand as those did.
    """
    require("learn", "torch")
    from gipkg.search.index import mesh_files

    files = mesh_files(folder)
    if not files:
        raise click.UsageError(f"there is no mesh in {folder} ({' '.join(MESH_SUFFIXES)})")
    target = output or folder / FILE_NAME
    index, network = _open(target, network_file, allowed, force)
    index.folder = Path(os.path.relpath(folder, target.parent)).as_posix()
    index.entries = {name: entry for name, entry in index.entries.items() if name in files}
    written = time.monotonic()

    def work(name: str) -> Facts:
        nonlocal written
        before = index.entries.get(name)
        try:
            signature = index.update(name, files[name], network)
        finally:
            # What was done is kept, though all that comes after it may fail.
            if time.monotonic() - written > SECONDS_BETWEEN_WRITES:
                index.write(target)
                written = time.monotonic()
        return {"class": signature.label, "known": index.entries[name] is before}

    try:
        for_each("index", list(files), work, say=_say, as_json=as_json)
    finally:
        index.write(target)


def _open(
    target: Path, network_file: Path | None, allowed: tuple[str, ...], force: bool
) -> tuple[Index, SignatureNetwork]:
    """Return the index to go on with and its network."""
    from gipkg.search.index import Index
    from gipkg.search.network import SignatureNetwork

    known = Index.read(target) if target.exists() else None
    if network_file is not None:
        network = SignatureNetwork.read(network_file, allowed)
    elif known is not None:
        network = SignatureNetwork.of(known.network, allowed)
    else:
        raise click.UsageError("a new index needs --network results/learning/.../*.model.npz")
    if known is not None and known.key == network.key:
        return known, network
    if known is not None and not force:
        raise click.ClickException(
            f"{target} was made by another network or version of gipkg; --force replaces it"
        )
    return Index(network.key, network.content), network


def _say(facts: Facts) -> str:
    return "" if facts["known"] else f"looks like {facts['class']}"
