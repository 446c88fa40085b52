"""What scripts read of earlier stages: the shapes of a database, and what was found out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gipkg.api import Shape
from gipkg.files import read_csv, read_json


def read_listing(path: str) -> list[Shape]:
    """Read the shapes of a database and their classes."""
    return [Shape(row["id"], row["label"]) for row in read_csv(Path(path))]


def read_sealed(path: str) -> Any:
    """Read the JSON document of an earlier stage, its checksum tested."""
    return read_json(Path(path), sealed=True)
