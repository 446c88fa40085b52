"""What a method did to each shape of a database: one row a shape, failed ones included."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from gipkg.evaluation.distortion import Distortion
from gipkg.files import read_csv, write_csv


@dataclass(frozen=True, slots=True)
class MappedShape:
    """One shape, its surface and its map.

    Attributes
    ----------
    id : str
    vertices, faces : int
        Of the surface that was mapped; 0 where there is none.
    surface : str
        What the surface stage did to the shape.
    variance, face_std, weighted_face_std, vertex_std, flips, degree
        As in :class:`gipkg.evaluation.distortion.Distortion`; NaN and 0 flips without a map.
    seconds : float
        CPU seconds that the map took.
    failure : str
        Why there is no map; empty where there is one.
    """

    id: str
    vertices: int
    faces: int
    surface: str
    variance: float = float("nan")
    face_std: float = float("nan")
    weighted_face_std: float = float("nan")
    vertex_std: float = float("nan")
    flips: int = 0
    degree: float = float("nan")
    seconds: float = float("nan")
    failure: str = ""

    @classmethod
    def mapped(
        cls, shape_id: str, report: Mapping[str, Any], distortion: Distortion, seconds: float
    ) -> MappedShape:
        """Gather what is known of a shape that has a map.

        Parameters
        ----------
        shape_id : str
        report : mapping
            Of the surface stage (:meth:`gipkg.surfaces.report.Report.as_dict`).
        distortion : Distortion
        seconds : float
        """
        return cls(
            shape_id,
            report["after"]["vertices"],
            report["after"]["faces"],
            repairs(report),
            distortion.variance,
            distortion.face_std,
            distortion.weighted_face_std,
            distortion.vertex_std,
            distortion.flips,
            distortion.degree,
            seconds,
        )

    @classmethod
    def failed(cls, shape_id: str, report: Mapping[str, Any] | None, reason: str) -> MappedShape:
        """Gather what is known of a shape without a map, and perhaps without a surface."""
        if report is None:
            return cls(shape_id, 0, 0, "failed", failure=reason)
        after = report["after"]
        return cls(shape_id, after["vertices"], after["faces"], repairs(report), failure=reason)


def repairs(report: Mapping[str, Any]) -> str:
    """Say in a line what the surface stage did to a shape, with the figures of each step."""
    steps = [f"{step['name']} ({_figures(step['figures'])})" for step in report["steps"]]
    return "; ".join(steps) or "as it was"


def _figures(figures: Mapping[str, Any]) -> str:
    parts = []
    for name, value in figures.items():
        values = value if isinstance(value, list) else [value]
        parts.append(f"{name} {' '.join(f'{one:.4g}' for one in values)}")
    return ", ".join(parts)


def write_shapes(path: Path, shapes: Iterable[MappedShape]) -> None:
    """Write one row a shape; a figure that is not there is empty."""
    names = [field.name for field in fields(MappedShape)]
    rows = ([_text(getattr(shape, name)) for name in names] for shape in shapes)
    write_csv(path, names, rows, sealed=True)


def _text(value: str | float) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return str(value)


def read_shapes(path: Path) -> list[MappedShape]:
    """Read what :func:`write_shapes` wrote."""
    kind = {field.name: _READERS[str(field.type)] for field in fields(MappedShape)}
    rows = read_csv(path)
    return [MappedShape(**{name: kind[name](text) for name, text in row.items()}) for row in rows]


_READERS: Mapping[str, Callable[[str], Any]] = {
    "str": str,
    "int": int,
    "float": lambda text: float(text or "nan"),
}
