"""Tables and documents: the shapes of a database, what was found out, where a result comes from."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gipkg.api import Shape
from gipkg.files import read_csv, read_json, write_json
from gipkg.reporting.provenance import environment


def read_listing(path: str) -> list[Shape]:
    """Read the shapes of a database, their classes and parts of the official split."""
    return [Shape(row["id"], row["label"], row["part"] or None) for row in read_csv(Path(path))]


def read_sealed(path: str) -> Any:
    """Read the JSON document of an earlier stage, its checksum tested."""
    return read_json(Path(path), sealed=True)


def write_provenance(path: str, params: Any, **more: Any) -> None:
    """Write what made a table or a figure: code, libraries, configuration and plugins."""
    chosen = {"config": params.config, "plugins": params.plugins, **more}
    write_json(Path(path), {**environment(), **chosen})
