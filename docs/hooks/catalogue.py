"""Pages of the catalogue, made of the registry when the site is built."""

from __future__ import annotations

from html import escape
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from gipkg import registry
from gipkg.api import Plugin

TITLES = {
    "parametrizer": "Parametrizers",
    "descriptor": "Descriptors",
    "baseline": "Baselines",
    "dataset": "Databases",
}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add a page for each kind of plugin (called by MkDocs)."""
    for kind, title in TITLES.items():
        path = f"catalogue/{kind}s.md"
        files.append(File.generated(config, path, content=_page(kind, title)))
    return files


def _page(kind: registry.Kind, title: str) -> str:
    refs = registry.list_plugins(kind)
    parts = [
        f"# {title}",
        "What `gipkg plugins list` and `gipkg plugins show NAME` tell, made of the registry.",
    ]
    return "\n\n".join(parts + [_entry(ref.name, registry.load(ref)) for ref in refs]) + "\n"


def _entry(name: str, plugin: type[Plugin]) -> str:
    summary = _text(plugin.summary)
    lines = [f"## `{name}`", f"{summary[0].upper()}{summary[1:]}.", f"*{_text(plugin.citation)}*"]
    lines += [f"::: {plugin.__module__}.{plugin.__name__}\n    options:\n{_OPTIONS}"]
    promises = _promises(plugin.tags)
    if promises:
        lines.append(f"Tags: {promises}.")
    if plugin.model_fields:
        rows = [
            f"| `{field}` | `{_default(info.default)}` | {_text(info.description or '')} |"
            for field, info in plugin.model_fields.items()
        ]
        lines.append("\n".join(["| parameter | default | |", "|---|---|---|", *rows]))
    return "\n\n".join(lines)


_OPTIONS = "\n".join(
    f"      {option}"
    for option in (
        "show_root_heading: false",
        "show_root_toc_entry: false",
        "members: false",
        "show_bases: false",
    )
)


def _promises(tags: Any) -> str:
    """Say what a plugin promises: the tags that are set."""
    told = []
    for name in tags.__slots__:
        value = getattr(tags, name)
        if value is True:
            told.append(name.replace("_", " "))
        elif isinstance(value, frozenset) and value:
            told.append(f"guarantees {', '.join(sorted(value))}")
        elif isinstance(value, str | int) and not isinstance(value, bool) and value:
            told.append(f"{name.replace('_', ' ')} {_text(str(value))}")
    return "; ".join(told)


def _default(value: object) -> str:
    return str(value).replace("|", "¦")


def _text(text: str) -> str:
    """Quote a text for a page in which brackets and tables mean something."""
    return escape(" ".join(text.split()), quote=False).replace("|", "¦").rstrip(".")
