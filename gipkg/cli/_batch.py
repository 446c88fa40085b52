"""One function on many files: each is named with what became of it, none is lost for another."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import click

from gipkg.errors import GipkgError, PluginError, RenderingError
from gipkg.progress import progress

Facts = Mapping[str, Any]
"""What is known of a file that was dealt with, as JSON takes it."""

Item = TypeVar("Item")

_NOT_ITS_FAULT = (PluginError, RenderingError, ImportError)
"""Faults of the command or the installation: they would meet every file alike."""


@dataclass(frozen=True, slots=True)
class Job:
    """A file to read, and the one to write."""

    source: Path
    target: Path

    def __str__(self) -> str:
        return str(self.source)


def plan(
    files: Sequence[Path], output: Path, suffix: str | None, suffixes: Sequence[str]
) -> list[Job]:
    """Say which file becomes which.

    Parameters
    ----------
    files : sequence of Path
    output : Path
        A file, where its suffix is one of `suffixes`; a folder, where it has none or is there.
    suffix : str, optional
        Of the files in the folder; the first of `suffixes` by default.
    suffixes : sequence of str
        The formats that can be written.

    Raises
    ------
    click.UsageError
        Two files would become one, the suffix is asked for twice, or is none of `suffixes`.
    """
    if output.suffix.lower() in suffixes and not output.is_dir():
        if len(files) > 1:
            raise click.UsageError(f"{len(files)} files do not fit into one: name a folder")
        if suffix not in (None, output.suffix.lower()):
            raise click.UsageError(f"{output} is not named as a {suffix} file is")
        return [Job(files[0], output)]
    if output.suffix and not output.is_dir():
        raise click.UsageError(
            f"{output}: the suffix is none of {', '.join(suffixes)} (a folder that is to be made "
            "has no suffix)"
        )
    jobs = [Job(file, output / (file.stem + (suffix or suffixes[0]))) for file in files]
    first: dict[Path, Path] = {}
    for job in jobs:
        if (other := first.setdefault(job.target, job.source)) is not job.source:
            raise click.UsageError(
                f"{other} and {job.source} would both become {job.target}: "
                "write them to two folders"
            )
    return jobs


def convert(
    label: str,
    jobs: Sequence[Job],
    work: Callable[[Job], Facts],
    *,
    say: Callable[[Facts], str],
    force: bool,
    as_json: bool,
) -> None:
    """Make one file of each, as :func:`for_each` does, and replace none unless forced to."""

    def one(job: Job) -> Facts:
        require_absent(job.target, force)
        return {"output": str(job.target), **work(job)}

    def said(facts: Facts) -> str:
        return f"{facts['output']}: {say(facts)}"

    for_each(label, jobs, one, say=said, as_json=as_json)


def require_absent(target: Path, force: bool) -> None:
    """Refuse to replace a file, unless forced to.

    Raises
    ------
    click.ClickException
        It exists.
    """
    if target.exists() and not force:
        raise click.ClickException(f"{target} exists already; --force replaces it")


def for_each(
    label: str,
    items: Sequence[Item],
    work: Callable[[Item], Facts],
    *,
    say: Callable[[Facts], str],
    as_json: bool,
    key: str = "file",
) -> None:
    """Deal with all items; what fails is named and the others finish.

    On standard output, each item is a line: a text, or a JSON object with ``key``, ``status``
    (``ok`` or ``failed``), ``seconds`` and the facts, or ``error`` and ``message``. Faults and
    progress go to standard error.

    Parameters
    ----------
    label : str
        What is done, for the progress display.
    items : sequence
        Each has its name as its text.
    work : callable
        Item -> what is known of it then.
    say : callable
        The same facts -> one line for people.
    as_json : bool
    key : str
        What an item is, in JSON.

    Raises
    ------
    click.exceptions.Exit
        With code 1, if any item failed.
    """
    failed = 0
    # One item needs no bar.
    for item in progress(items, label) if len(items) > 1 else iter(items):
        began = time.perf_counter()
        record: dict[str, Any] = {key: str(item)}
        message = ""
        try:
            facts = work(item)
            seconds = round(time.perf_counter() - began, 3)
            done = {**record, "status": "ok", "seconds": seconds, **facts}
            line = _json(done) if as_json else _after(item, " -> ", say(facts))
        except _NOT_ITS_FAULT:
            raise
        except Exception as error:  # whatever befalls one file, the others are dealt with
            failed += 1
            message = _message(error, str(item))
            record |= {"status": "failed", "error": type(error).__name__, "message": message}
            line = _json(record) if as_json else ""
        with _above_the_bar():
            if message:
                click.echo(_after(item, ": ", message), err=True)
            if line:
                click.echo(line)
    if failed and len(items) > 1:
        click.echo(f"{failed} of {len(items)} failed", err=True)
    if failed:
        raise click.exceptions.Exit(1)


def printable(text: str) -> str:
    """Escape what a name could do to a terminal; a new line is one where the text is ours."""
    return "".join(
        letter if letter.isprintable() else letter.encode("unicode_escape").decode("ascii")
        for letter in text
    )


def _after(item: object, mark: str, text: str) -> str:
    """Put the name of an item before a text of one or more lines, or nothing before nothing."""
    lines = "\n".join(map(printable, text.splitlines()))
    return f"{printable(str(item))}{mark}{lines}" if text else ""


def _json(record: Facts) -> str:
    return json.dumps(record, allow_nan=False)


def _message(error: Exception, name: str) -> str:
    """Word a fault without the name of the file, which stands before it."""
    if isinstance(error, click.ClickException):
        return error.message
    if isinstance(error, GipkgError):
        return str(error).removeprefix(f"{name}: ")
    if isinstance(error, OSError):
        place = f" ({error.filename})" if error.filename and str(error.filename) != name else ""
        return f"{error.strerror or error}{place}"
    return f"{type(error).__name__}: {error}; this is a fault of gipkg or of a plugin, report it"


def _above_the_bar() -> AbstractContextManager[Any]:
    """Keep a progress bar in the terminal and the lines that are written apart."""
    if not sys.stderr.isatty():
        return nullcontext()
    from tqdm import tqdm

    return tqdm.external_write_mode()


def counted(number: int, thing: str) -> str:
    """Return ``1 vertex``, ``1,234 vertices``."""
    plural = {"vertex": "vertices"}.get(thing, f"{thing}s")
    return f"{number:,} {thing if number == 1 else plural}"


def joined(*parts: str) -> str:
    """Return the parts that say something, with commas between."""
    return ", ".join(filter(None, parts))
