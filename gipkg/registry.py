"""Plugins by name: built-ins, installed third parties and one-file local plugins.

All three become the same lazy :class:`PluginRef`; nothing is imported until it is asked for.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, overload

from gipkg import fingerprints
from gipkg.errors import (
    BrokenPluginError,
    DuplicatePluginError,
    PluginError,
    UnknownPluginError,
    did_you_mean,
)
from gipkg.plugin_refs import (
    KINDS,
    Kind,
    PluginRef,
    builtin,
    installed,
    is_valid_name,
    load,
    normalise,
    require_valid_name,
)

if TYPE_CHECKING:
    from gipkg.api import Baseline, Dataset, Descriptor, Parametrizer, Plugin

__all__ = [
    "KINDS",
    "Kind",
    "PluginRef",
    "create",
    "diagnose",
    "find",
    "fingerprint",
    "get",
    "is_valid_name",
    "list_plugins",
    "load",
    "normalise",
    "register_local",
]

STRICT_VARIABLE = "GIPKG_STRICT_PLUGINS"
"""Set to 1 (in continuous integration), it makes every listing load all it lists."""

_NO_PARAMETERS: Mapping[str, Any] = MappingProxyType({})


_local: dict[tuple[Kind, str], PluginRef] = {}


def list_plugins(kind: Kind) -> list[PluginRef]:
    """List the plugins of one kind by name, without importing them.

    A name that two sources claim is listed twice; asking for it is an error.

    Raises
    ------
    BrokenPluginError, DuplicatePluginError
        Only with ``GIPKG_STRICT_PLUGINS=1``, for the first fault of any plugin listed.
    """
    if kind not in KINDS:
        hint = did_you_mean(kind, KINDS)
        raise UnknownPluginError(f"no kind of plugin is named {kind!r}{hint} ({', '.join(KINDS)})")
    local = [ref for (of_kind, _), ref in _local.items() if of_kind == kind]
    refs = sorted(builtin(kind) + installed(kind) + local, key=lambda ref: (ref.name, ref.target))
    if os.environ.get(STRICT_VARIABLE) == "1":
        for ref in refs:
            if reason := diagnose(ref, refs):
                raise reason
    return refs


def find(kind: Kind, name: str) -> PluginRef:
    """Look a plugin up by name (``_`` and ``-`` are the same) without importing it.

    Raises
    ------
    UnknownPluginError
        Names the nearest name, the known ones with their origin, and those not loadable.
    DuplicatePluginError
        Two sources claim the name.
    """
    name = normalise(name)
    refs = list_plugins(kind)
    found = [ref for ref in refs if ref.name == name]
    if not found:
        raise UnknownPluginError(_unknown(kind, name, refs))
    _require_unique(found)
    return found[0]


def get(kind: Kind, name: str) -> type[Plugin]:
    """Import a plugin's class.

    Raises
    ------
    UnknownPluginError, DuplicatePluginError
        The name leads to no plugin, or to several.
    BrokenPluginError
        It cannot be imported or breaks its contract; the cause is chained.
    """
    return load(find(kind, name))


@overload
def create(
    kind: Literal["parametrizer"], name: str, parameters: Mapping[str, Any] = ...
) -> Parametrizer: ...
@overload
def create(
    kind: Literal["descriptor"], name: str, parameters: Mapping[str, Any] = ...
) -> Descriptor: ...
@overload
def create(
    kind: Literal["baseline"], name: str, parameters: Mapping[str, Any] = ...
) -> Baseline: ...
@overload
def create(kind: Literal["dataset"], name: str, parameters: Mapping[str, Any] = ...) -> Dataset: ...
@overload
def create(kind: Kind, name: str, parameters: Mapping[str, Any] = ...) -> Plugin: ...
def create(kind: Kind, name: str, parameters: Mapping[str, Any] = _NO_PARAMETERS) -> Plugin:
    """Build a plugin by name.

    Parameters
    ----------
    kind, name : str
        Which plugin.
    parameters : mapping
        Values of its fields; what is left out takes its default.

    Raises
    ------
    InvalidParameterError
        A parameter is unknown or out of bounds; names it, its value and the choices.
    UnknownPluginError, DuplicatePluginError, BrokenPluginError
        As :func:`get`.
    """
    from gipkg.parameters import validated

    return validated(get(kind, name), f"{kind} {normalise(name)!r}", parameters)


def fingerprint(kind: Kind, name: str) -> str:
    """Hash a plugin's code without importing it; see :mod:`gipkg.fingerprints`."""
    return fingerprints.of_plugin(find(kind, name))


def register_local(kind: Kind, name: str, target: str) -> PluginRef:
    """Add a one-file plugin, for this process, under a name.

    Parameters
    ----------
    kind, name : str
        Under which it will be found; saying the same twice changes nothing.
    target : str
        ``path/file.py:Class``; a relative path counts from the working directory.

    Raises
    ------
    BrokenPluginError
        The name or the target is malformed, or there is no such file.
    DuplicatePluginError
        The name is taken.
    """
    path, _, attribute = target.rpartition(":")
    file = Path(path).resolve()
    ref = PluginRef(kind, normalise(name), f"{file}:{attribute}", None, None, "local")
    if not path or not attribute.isidentifier():
        raise BrokenPluginError(
            f"{kind} {name!r}: {target!r} is not of the form path/file.py:Class"
        )
    if not file.is_file():
        raise BrokenPluginError(f"{kind} {name!r}: there is no file {file}")
    require_valid_name(ref)
    _require_unique({ref, *(other for other in list_plugins(kind) if other.name == ref.name)})
    _local[kind, ref.name] = ref
    return ref


def diagnose(ref: PluginRef, among: list[PluginRef]) -> PluginError | None:
    """Return what is wrong with one of the listed plugins, or None; this imports it."""
    try:
        _require_unique([other for other in among if other.name == ref.name])
        load(ref)
    except PluginError as error:
        return error
    return None


def _require_unique(claims: list[PluginRef] | set[PluginRef]) -> None:
    if len(claims) > 1:
        refs = sorted(claims, key=lambda ref: ref.target)
        owners = " and ".join(f"{ref.target} ({ref.origin})" for ref in refs)
        raise DuplicatePluginError(
            f"{refs[0].kind} {refs[0].name!r} is claimed by {owners}; rename or uninstall one"
        )


def _unknown(kind: Kind, name: str, refs: list[PluginRef]) -> str:
    reasons = {ref: diagnose(ref, refs) for ref in refs}
    good = [f"{ref.name} ({ref.origin})" for ref, reason in reasons.items() if reason is None]
    bad = [str(reason) for reason in reasons.values() if reason is not None]
    hint = did_you_mean(name, (ref.name for ref in refs))
    message = f"no {kind} is named {name!r}{hint} (installed: {', '.join(good) or 'none'}"
    if bad:
        message += f"; not loadable: {'; '.join(dict.fromkeys(bad))}; see gipkg plugins doctor"
    return message + ")"
