"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

Command = TypeVar("Command", bound=Callable[..., Any])

PICTURE_SUFFIXES = (".png",)
"""Of pictures for the eye, which no command reads."""

folder_type = click.Path(file_okay=False, path_type=Path)

json_option = click.option("--json", "as_json", is_flag=True, help="One JSON object a line.")

force_option = click.option("--force", is_flag=True, help="Replace files that exist.")

allow_option = click.option(
    "--allow",
    "allowed",
    metavar="FILE.py:CLASS",
    multiple=True,
    help="Run this plugin, in a file, where the network's images were made by it.",
)


def files_argument(metavar: str) -> Callable[[Command], Command]:
    """One or more files; what is wrong with one of them is said when its turn comes."""
    return click.argument(
        "files", metavar=f"{metavar}...", nargs=-1, required=True, type=click.Path(path_type=Path)
    )


def output_options(suffixes: Sequence[str]) -> Callable[[Command], Command]:
    """``--output``, ``--format`` and ``--force`` of a command that writes one file for each."""

    def decorate(command: Command) -> Command:
        names = [suffix.lstrip(".") for suffix in suffixes]
        format_option = click.option(
            "--format",
            "suffix",
            type=click.Choice(names, case_sensitive=False),
            callback=lambda _ctx, _option, name: name and f".{name}",
            help=f"Format of the files in a folder; {names[0]} by default.",
        )
        output_option = click.option(
            "-o",
            "--output",
            required=True,
            type=click.Path(path_type=Path),
            help="The file to write, or a folder for files named after those read.",
        )
        return output_option(format_option(force_option(command)))

    return decorate
