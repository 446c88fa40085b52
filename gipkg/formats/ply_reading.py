"""Reader of PLY meshes: text and binary of both byte orders, any properties, any polygons.

Format: G. Turk, The PLY Polygon File Format, 1994. The numbers of a text are made a binary file
of double precision, so that both are walked through in one way.
"""

from __future__ import annotations

import re
import struct
import warnings
from array import array
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gipkg.formats.limits import check_counts
from gipkg.formats.polygons import Polygons

_LONGEST_HEADER = 1 << 16
_END = re.compile(rb"\bend_header[ \t]*(?:\r\n|\n|\r)")
_CODES = {
    **{"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I"},
    **{"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"},
    **{"int64": "q", "uint64": "Q", "float": "f", "double": "d", "float32": "f", "float64": "d"},
}
"""Name of a type -> how struct and NumPy call it."""
_ORDERS = {"ascii": "<", "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = ("vertex_indices", "vertex_index")

_Columns = dict[str, NDArray | Polygons]


@dataclass(frozen=True)
class _Property:
    name: str
    type: str
    counter: str | None
    """Type of the length of a list; None where there is one value."""


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


def parse_ply(data: bytes) -> tuple[NDArray[np.float64], Polygons]:
    """Read the vertices and the polygons of a PLY file's content.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : Polygons
        Nothing is said of whether their corners exist.

    Raises
    ------
    ValueError
        It is no PLY file, ends early, is too large, or has no vertices or faces.
    """
    end = _END.search(data, 0, _LONGEST_HEADER)
    if data[:3] != b"ply" or end is None:
        raise ValueError("it does not begin with the header of a PLY file")
    text, elements = _header(data[: end.start()])
    body = _as_binary(data[end.end() :], elements) if text else data[end.end() :]
    found = {}
    at = 0
    for element in elements:
        found[element.name], at = _rows(body, at, element)
    try:
        with np.errstate(invalid="ignore"):  # array_fault finds what is no number
            columns = [np.asarray(found["vertex"][axis], np.float64) for axis in "xyz"]
    except (KeyError, TypeError) as error:
        raise ValueError(f"its vertices have no {error}") from error
    vertices, faces = np.column_stack(columns), found.get("face", {})
    polygons = next((faces[name] for name in _CORNERS if name in faces), None)
    if not isinstance(polygons, Polygons):
        raise ValueError("it has no faces with vertex_indices")
    return vertices, polygons


def _header(head: bytes) -> tuple[bool, list[_Element]]:
    """Return whether text follows, and the elements."""
    text, order, elements = False, "<", list[_Element]()
    for line in head.decode("latin-1").splitlines()[1:]:
        match line.split():
            case ["format", name, _] if name in _ORDERS:
                text, order = name == "ascii", _ORDERS[name]
            case ["element", name, count]:
                elements.append(_Element(name, int(count)))
            case ["property", "list", counter, kind, name] if elements:
                codes = [order + _CODES.get(one, "?") for one in (kind, counter)]
                elements[-1].properties.append(_Property(name, *codes))
            case ["property", kind, name] if elements:
                code = order + _CODES.get(kind, "?")
                elements[-1].properties.append(_Property(name, code, None))
            case [] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise ValueError(f"the line {line[:80]!r} of its header is not understood")
    for element in elements:
        types = [one.type + (one.counter or "") for one in element.properties]
        if element.count < 0 or (element.count and not types) or "?" in "".join(types):
            raise ValueError(f"its header does not say what a {element.name[:80]!r} holds")
        check_counts(*((0, element.count) if element.name == "face" else (element.count, 0)))
    return text, elements


def _as_binary(text: bytes, elements: list[_Element]) -> bytes:
    """Turn numbers in text into double precision, and say so in the elements."""
    with warnings.catch_warnings():
        # What is not a number ends the parser of older NumPy with no more than a warning.
        warnings.simplefilter("error")
        try:
            numbers = np.fromstring(text.decode("latin-1"), np.float64, sep=" ")
        except (DeprecationWarning, ValueError) as error:
            raise ValueError("there is something else than numbers in it") from error
    for element in elements:
        element.properties = [
            _Property(one.name, "<d", one.counter and "<d") for one in element.properties
        ]
    return numbers.tobytes()


def _rows(data: bytes, at: int, element: _Element) -> tuple[_Columns, int]:
    """Read one element: its columns by name, and where it ends."""
    if not element.count:
        return {}, at
    row, fits = _like_the_first(data, at, element)
    size = element.count * row.itemsize
    if fits and at + size <= len(data):
        block = np.frombuffer(data, row, element.count, at)
        lists = [number for number, one in enumerate(element.properties) if one.counter]
        if all((block[f"n{number}"] == block[f"n{number}"][0]).all() for number in lists):
            columns: _Columns = {
                one.name: _polygons(block[f"{k}"]) if one.counter else block[f"{k}"]
                for k, one in enumerate(element.properties)
            }
            return columns, at + size
    if not any(one.counter for one in element.properties):
        raise ValueError(f"it ends before its {element.count} {element.name[:80]!r}")
    return _of_all_lengths(data, at, element)


def _polygons(corners: NDArray[np.number], lengths: NDArray[np.int64] | None = None) -> Polygons:
    """Make faces of their corners, as many of each where nothing else is said."""
    if lengths is None:
        lengths = np.full(len(corners), corners.shape[1])
    with np.errstate(invalid="ignore"):  # what is no number becomes one that no vertex has
        return Polygons(corners.astype(np.int64).ravel(), lengths)


def _like_the_first(data: bytes, at: int, element: _Element) -> tuple[np.dtype, bool]:
    """Return the layout of the first row, and whether the file holds that row."""
    fields: list[tuple] = []
    for number, one in enumerate(element.properties):
        length = 1
        if one.counter:
            length = _length(data, at, one)
            fields.append((f"n{number}", one.counter))
            at += struct.calcsize(one.counter)
        at += length * struct.calcsize(one.type)
        if at > len(data):
            return np.dtype(fields), False
        fields.append(
            (f"{number}", one.type, (length,)) if one.counter else (f"{number}", one.type)
        )
    return np.dtype(fields), True


def _of_all_lengths(data: bytes, at: int, element: _Element) -> tuple[_Columns, int]:
    """Read rows whose lists differ in length; only the lists of corners are kept."""
    corners, lengths = bytearray(), array("q")
    kept = next((one for one in element.properties if one.counter and one.name in _CORNERS), None)
    for _ in range(element.count):
        for one in element.properties:
            length = 1
            if one.counter:
                length = _length(data, at, one)
                at += struct.calcsize(one.counter)
            end = at + length * struct.calcsize(one.type)
            if end > len(data):
                raise ValueError(f"it ends before its {element.count} {element.name[:80]!r}")
            if one is kept:
                corners += data[at:end]
                lengths.append(length)
            at = end
    if kept is None:
        return {}, at
    return {kept.name: _polygons(np.frombuffer(corners, kept.type), np.array(lengths))}, at


def _length(data: bytes, at: int, one: _Property) -> int:
    """Read how long a list is."""
    assert one.counter is not None
    if at + struct.calcsize(one.counter) > len(data):
        raise ValueError("it ends within a list")
    (length,) = struct.unpack_from(one.counter, data, at)
    if not 0 <= length <= len(data) or length % 1:
        raise ValueError(f"a list of {length} numbers is none that the file holds")
    return int(length)
