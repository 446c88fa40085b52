"""``gipkg data``: which databases there are, what of them is at hand, and whether it is whole."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gipkg import registry
from gipkg.cli._batch import Facts, for_each
from gipkg.cli._options import folder_type, json_option
from gipkg.cli._plugins import build, completion, resolve
from gipkg.cli._tables import table
from gipkg.errors import DatasetNotFound

if TYPE_CHECKING:
    from gipkg.api import Dataset

root_option = click.option(
    "--data-root",
    "root",
    type=folder_type,
    envvar="GIPKG_DATA_ROOT",
    default=Path("data"),
    show_default=True,
    show_envvar=True,
    help="Folder of the databases.",
)


@click.group()
def command() -> None:
    """List, fetch and check the databases."""


@command.command("list")
@root_option
@json_option
def list_(root: Path, as_json: bool) -> None:
    """List the databases.

    With their licence and source, and whether they are at hand; no checksum is computed.
    """
    known = [_facts(name, _dataset(name), root) for name in _all()]
    if as_json:
        for facts in known:
            click.echo(json.dumps(facts))
        return
    header = ("name", "shapes", "classes", "at hand", "licence", "source")
    keys = ("database", "shapes", "classes", "at_hand", "licence", "source")
    shown = [{**facts, "at_hand": "yes" if facts["at_hand"] else "no"} for facts in known]
    cells = [["–" if facts[key] is None else str(facts[key]) for key in keys] for facts in shown]
    click.echo(table(header, cells))


@command.command()
@click.argument("names", metavar="NAME...", nargs=-1, shell_complete=completion("dataset"))
@root_option
@json_option
def fetch(names: tuple[str, ...], root: Path, as_json: bool) -> None:
    """Download databases, and verify them.

    Of one that cannot be downloaded, this says where to get it.
    """
    if not names:
        raise click.UsageError(f"name what to fetch: {', '.join(_all())}")
    datasets = {name: _dataset(name) for name in names}

    def work(name: str) -> Facts:
        datasets[name].fetch(root)
        return _facts(name, datasets[name], root)

    for_each("fetch", names, work, say=_say, as_json=as_json, key="database")


@command.command()
@click.argument("names", metavar="[NAME]...", nargs=-1, shell_complete=completion("dataset"))
@root_option
@json_option
def check(names: tuple[str, ...], root: Path, as_json: bool) -> None:
    """Compare databases with their checksums.

    Without a name, of all that are at hand; a database that is named has to be.
    """
    from gipkg.datasets.downloads import require_intact

    datasets = {name: _dataset(name) for name in names or _all()}
    asked = names or [name for name, one in datasets.items() if _at_hand(one, root)]

    def work(name: str) -> Facts:
        files = datasets[name].tags.files
        if any((root / file).is_file() for file in files) or not datasets[name].available(root):
            for file, sha256 in files.items():
                require_intact(root / file, sha256)
        if not datasets[name].available(root):
            raise DatasetNotFound(f"not under {root}; gipkg data fetch {name} gets it")
        return _facts(name, datasets[name], root)

    for_each("check", asked, work, say=_say, as_json=as_json, key="database")


def _all() -> list[str]:
    return [ref.name for ref in registry.list_plugins("dataset")]


def _dataset(name: str) -> Dataset:
    dataset: Dataset = build("dataset", resolve("dataset", name), {})
    return dataset


def _facts(name: str, dataset: Dataset, root: Path) -> dict[str, Any]:
    tags = dataset.tags
    return {
        "database": name,
        "at_hand": _at_hand(dataset, root),
        "generated": tags.generated,
        "shapes": tags.shapes,
        "classes": tags.classes,
        "licence": tags.licence,
        "source": tags.source,
        "citation": dataset.citation,
        "files": {str(root / file): sha256 for file, sha256 in tags.files.items()},
    }


def _at_hand(dataset: Dataset, root: Path) -> bool:
    """Tell whether the files are there, or what the database takes in their place."""
    files = dataset.tags.files
    # Asked itself, a database would compute the checksums of files that are there.
    listed = bool(files) and all((root / file).is_file() for file in files)
    return listed or dataset.available(root)


def _say(facts: Facts) -> str:
    files = ", ".join(file for file in facts["files"] if Path(file).is_file())
    if not files:
        files = "a folder without checksums" if facts["files"] else "nothing to be downloaded"
    return f"{facts['shapes']} shapes in {facts['classes']} classes, whole: {files}"
