"""A new plugin package from the template: a working example to replace line by line."""

from __future__ import annotations

from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from gipkg.registry import KINDS, Kind

_PACKAGE = "gipkg_my_method"


def write_package(kind: Kind, name: str, folder: Path) -> None:
    """Write an installable package with one plugin into a folder that does not exist yet.

    Parameters
    ----------
    kind, name : str
        What the plugin will be registered as; the name in its normal spelling.
    folder : Path
        Where `pyproject.toml` goes.

    Raises
    ------
    FileExistsError
        The folder exists.
    """
    folder.mkdir(parents=True)
    names = {
        "my-method": name,
        "my_method": name.replace("-", "_"),
        "MyMethod": "".join(part.capitalize() for part in name.split("-")),
        "my-kind": kind,
    }
    _copy(files("gipkg.cli").joinpath("template"), folder, names, kind)


def _copy(source: Traversable, target: Path, names: dict[str, str], kind: Kind) -> None:
    target.mkdir(exist_ok=True)
    for entry in source.iterdir():
        if entry.is_dir() and entry.name != "__pycache__":
            _copy(entry, target / _renamed(entry.name, names), names, kind)
        elif entry.is_file() and (file := _file_name(entry.name, source.name, kind)):
            text = _renamed(entry.read_text(encoding="utf-8"), names)
            (target / _renamed(file, names)).write_text(text, encoding="utf-8")


def _file_name(name: str, folder: str, kind: Kind) -> str | None:
    """Return what a file becomes: the template's package holds one module for each kind."""
    stem = name.removesuffix(".py")
    if folder != _PACKAGE or stem not in KINDS:
        return name
    return "__init__.py" if stem == kind else None


def _renamed(text: str, names: dict[str, str]) -> str:
    for placeholder, value in names.items():
        text = text.replace(placeholder, value)
    return text
