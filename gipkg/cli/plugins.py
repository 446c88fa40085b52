"""``gipkg plugins``: list, show, diagnose, check and create plugins."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from gipkg import registry
from gipkg.cli._options import folder_type
from gipkg.cli._plugins import require_no_file, resolve
from gipkg.cli._tables import table
from gipkg.errors import UnknownPluginError, did_you_mean
from gipkg.registry import KINDS, Kind, PluginRef

kind_option = click.option("--kind", type=click.Choice(KINDS), help="Only this kind of plugin.")


@click.group()
def command() -> None:
    """List, show, check and create plugins.

    They are parametrizers, descriptors, baselines and datasets, by name. Where NAME is asked for,
    PATH/FILE.py:CLASS with --kind means a plugin in one file.
    """


@command.command("list")
@kind_option
@click.option("--json", "as_json", is_flag=True, help="One JSON array of objects.")
def list_(kind: Kind | None, as_json: bool) -> None:
    """List plugins without importing them."""
    refs = _all(kind)
    if as_json:
        click.echo(json.dumps([asdict(ref) for ref in refs], indent=2))
    else:
        rows = [(ref.kind, ref.name, ref.origin) for ref in refs]
        click.echo(table(("kind", "name", "from"), rows))


@command.command()
@click.argument("name")
@kind_option
def show(name: str, kind: Kind | None) -> None:
    """Show a plugin's parameters and promises.

    And its citation, and the file that it is in.
    """
    from inspect import getsourcefile

    from gipkg.parameters import Parameter, parameters_of

    ref = _find(name, kind)
    plugin: Any = registry.load(ref)
    header = tuple(Parameter.__dataclass_fields__)
    parameters = [tuple(asdict(parameter).values()) for parameter in parameters_of(plugin)]
    click.echo(f"{ref}: {plugin.summary}\n")
    click.echo(table(header, parameters) if parameters else "no parameters")
    click.echo()
    for key, value in asdict(plugin.tags).items():
        click.echo(f"{key}: {_as_text(value)}")
    click.echo(f"citation: {plugin.citation}")
    click.echo(f"file: {getsourcefile(plugin)}")


@command.command()
def doctor() -> None:
    """Say what is wrong with any plugin.

    Each is imported; the exit code is 1 if anything is wrong.
    """
    rows, faults = [], []
    for kind in KINDS:
        refs = registry.list_plugins(kind)
        for ref in refs:
            fault = registry.diagnose(ref, refs)
            rows.append((ref.kind, ref.name, ref.origin, "broken" if fault else "ok"))
            faults += [str(fault)] if fault else []
    click.echo(table(("kind", "name", "from", "state"), rows))
    for text in dict.fromkeys(faults):
        click.echo(f"\n{text}")
    if faults:
        raise click.exceptions.Exit(1)


@command.command()
@click.argument("name")
@kind_option
@click.option("--data-root", type=folder_type, help="Folder of the real databases.")
@click.option(
    "--expect-failure",
    "expected",
    metavar="CHECK=REASON",
    multiple=True,
    help="A check that is known to fail; passing it is then a fault. May be repeated.",
)
def check(name: str, kind: Kind | None, data_root: Path | None, expected: tuple[str, ...]) -> None:
    """Run the conformance suite on a plugin.

    The exit code is 1 unless it conforms.
    """
    from gipkg.testing import run_checks

    ref = _find(name, kind)
    plugin = registry.create(ref.kind, ref.name)
    try:
        report = run_checks(plugin, ref.name, _expected_failures(expected), data_root)
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--expect-failure") from error
    for outcome in report.outcomes:
        if outcome.status != "passed":
            click.echo(f"{outcome.status} {outcome.name}: {outcome.detail}")
    click.echo(report.summary())
    if report.fault:
        raise click.ClickException(f"{ref} does not conform: {report.fault}")


@command.command()
@click.argument("kind", type=click.Choice(KINDS))
@click.argument("name")
@click.option(
    "--directory",
    type=folder_type,
    default=Path(),
    help="Where the package's folder is made; the working directory by default.",
)
def new(kind: Kind, name: str, directory: Path) -> None:
    """Write a package with a new plugin.

    It can be installed and checked as it stands.
    """
    from gipkg.cli._scaffold import write_package

    if not registry.is_valid_name(name):
        raise click.BadParameter("lower case letters, digits and '-', please", param_hint="NAME")
    if name in (ref.name for ref in registry.list_plugins(kind)):
        raise click.BadParameter(f"there is a {kind} {name!r} already", param_hint="NAME")
    folder = directory / f"gipkg-{name}"
    try:
        write_package(kind, name, folder)
    except FileExistsError as error:
        raise click.ClickException(f"{folder} exists already; nothing was written") from error
    click.echo(f"{folder} is written; next: pip install -e {folder} && gipkg plugins check {name}")


def _all(kind: Kind | None) -> list[PluginRef]:
    return [ref for each in ([kind] if kind else KINDS) for ref in registry.list_plugins(each)]


def _find(name: str, kind: Kind | None) -> PluginRef:
    """Find a plugin among all kinds, or load the file that is named instead."""
    if kind:
        return registry.find(kind, resolve(kind, name))
    if ":" in name:
        raise click.UsageError(f"a plugin in one file needs --kind {{{'|'.join(KINDS)}}}")
    require_no_file(name)
    refs = _all(None)
    kinds = sorted({ref.kind for ref in refs if ref.name == registry.normalise(name)})
    if not kinds:
        hint = did_you_mean(name, (ref.name for ref in refs))
        raise UnknownPluginError(f"no plugin is named {name!r}{hint} (see gipkg plugins list)")
    if len(kinds) > 1:
        raise click.UsageError(f"{name!r} is the name of several: say --kind {' or '.join(kinds)}")
    return registry.find(kinds[0], name)


def _expected_failures(pairs: Iterable[str]) -> dict[str, str]:
    expected = {}
    for pair in pairs:
        name, _, reason = pair.partition("=")
        if not reason:
            raise click.BadParameter(f"{pair!r} gives no reason", param_hint="--expect-failure")
        expected[name] = reason
    return expected


def _as_text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} ({text})" for key, text in sorted(value.items())) or "none"
    if isinstance(value, (set, frozenset)):
        return ", ".join(sorted(map(str, value))) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)
