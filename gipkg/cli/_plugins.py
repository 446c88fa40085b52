"""Plugins and their parameters as options: checked before any file is read."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from gipkg import registry
from gipkg.errors import InvalidParameterError, PluginError, UnknownPluginError, did_you_mean
from gipkg.registry import Kind

Command = TypeVar("Command", bound=Callable[..., Any])


def completion(kind: Kind) -> Callable[[click.Context, click.Parameter, str], list[str]]:
    """Return what completes the name of a plugin in the shell; it imports none."""

    def complete(_ctx: click.Context, _option: click.Parameter, incomplete: str) -> list[str]:
        known = (ref.name for ref in registry.list_plugins(kind))
        return [name for name in known if name.startswith(incomplete)]

    return complete


def plugin_option(*names: str, kind: Kind, **attributes: Any) -> Callable[[Command], Command]:
    """Return an option that takes the name of a plugin."""
    return click.option(*names, metavar="NAME", shell_complete=completion(kind), **attributes)


method_option = plugin_option(
    "-m",
    "--method",
    kind="parametrizer",
    default="authalic",
    show_default=True,
    help="The parametrizer, or FILE.py:CLASS.",
)

parameter_option = click.option(
    "-p",
    "--parameter",
    "parameters",
    metavar="[NAME.]KEY=VALUE",
    multiple=True,
    help="A parameter of the plugin (see gipkg plugins show). May be repeated.",
)


def resolve(kind: Kind, name: str) -> str:
    """Return the name of a plugin; ``path/file.py:Class`` gets one for this process.

    Raises
    ------
    click.UsageError
        There is no such file, or its name is taken.
    """
    if ":" not in name:
        require_no_file(name)
        return registry.normalise(name)
    stem = Path(name.rpartition(":")[0]).stem.lower()
    try:
        return registry.register_local(kind, stem, name).name
    except PluginError as error:
        raise click.UsageError(str(error)) from error


def require_no_file(name: str) -> None:
    """Refuse a file that is named without the class in it.

    Raises
    ------
    click.UsageError
        Says how a plugin in a file is named.
    """
    if name.endswith(".py"):
        raise click.UsageError(f"{name}: a plugin in a file is named {name}:CLASS")


def build(kind: Kind, name: str, parameters: Mapping[str, Any]) -> Any:
    """Build a plugin; a name or value that will not do is wrong usage.

    Parameters
    ----------
    kind, name : str
    parameters : mapping

    Raises
    ------
    click.UsageError
        Names the nearest name, or the parameter with its bounds.
    """
    try:
        return registry.create(kind, name, parameters)
    except (UnknownPluginError, InvalidParameterError) as error:
        raise click.UsageError(str(error)) from error


def assigned(pairs: Iterable[str], names: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Sort ``[NAME.]KEY=VALUE`` by the plugin they are for.

    Parameters
    ----------
    pairs : iterable of str
        One without a name is for the first plugin. Values are text, and lists and mappings as
        JSON; the plugin makes numbers of them.
    names : sequence of str
        The plugins that take part.

    Returns
    -------
    dict
        Name -> parameters, for every one of the names.

    Raises
    ------
    click.UsageError
        A pair is malformed, or names another plugin.
    """
    found: dict[str, dict[str, Any]] = {name: {} for name in names}
    for pair in pairs:
        left, equals, value = pair.partition("=")
        name, _, key = left.rpartition(".") if not left.startswith(".") else ("", "", "")
        if not (key and equals):
            raise click.BadParameter(f"{pair!r} is not KEY=VALUE", param_hint="-p")
        name = registry.normalise(name) or names[0]
        if name not in found:
            hint = did_you_mean(name, names)
            raise click.BadParameter(
                f"{pair!r}: {name!r} takes no part here{hint} ({', '.join(names)})", param_hint="-p"
            )
        found[name][key] = _value(value)
    return found


def _value(text: str) -> Any:
    if text != "null" and not text.startswith(("[", "{", '"')):
        return text
    try:
        return json.loads(text)
    except ValueError:
        return text
