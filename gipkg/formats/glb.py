"""Reader of GLB scenes: the triangles of all of its parts, in the coordinates of the scene.

Colours, textures, skins and animations are left alone, and no other file is opened. Format:
Khronos, glTF 2.0, sections 3 and 4.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gipkg.formats.limits import check_counts

_HEADER = struct.Struct("<4s8xI4s")
_CHUNK = struct.Struct("<I4s")
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC3": 3}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6

Scene = dict[str, Any]


def parse_glb(data: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read the triangles of a GLB file's content.

    Parameters
    ----------
    data : bytes
        All of it.

    Returns
    -------
    vertices : (V, 3) float64 array
    faces : (F, 3) int64 array

    Raises
    ------
    ValueError
        It is no GLB file, is damaged or too large, or keeps its arrays elsewhere
        or compressed.
    """
    try:
        scene, binary = _chunks(data)
        vertices, faces = [np.zeros((0, 3))], [np.zeros((0, 3), np.int64)]
        count = shown = 0
        for mesh, matrix in _places(scene):
            with np.errstate(invalid="ignore", over="ignore"):
                # The sign alone: a determinant of small scales would vanish.
                mirrored = np.linalg.slogdet(matrix[:3, :3])[0] < 0
            for primitive in scene["meshes"][mesh]["primitives"]:
                points, triangles = _triangles(scene, binary, primitive)
                if mirrored:
                    triangles = triangles[:, ::-1]
                with np.errstate(invalid="ignore", over="ignore"):  # array_fault finds them
                    vertices.append(points @ matrix[:3, :3].T + matrix[:3, 3])
                faces.append(triangles + count)
                count, shown = count + len(points), shown + len(triangles)
                # A short file can show the same part at any number of places.
                check_counts(count, shown)
    except (LookupError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"its description is not that of a scene: {error!r}") from error
    return np.concatenate(vertices), np.concatenate(faces)


def _chunks(data: bytes) -> tuple[Scene, bytes]:
    """Return the description of the scene, and the numbers that it speaks of."""
    if len(data) < _HEADER.size:
        raise ValueError("it ends within its header")
    magic, length, kind = _HEADER.unpack_from(data)
    if magic != b"glTF" or kind != b"JSON":
        raise ValueError("it does not begin with the header of a GLB file")
    end = _HEADER.size + length
    scene = json.loads(data[_HEADER.size : end])
    if len(data) < end + _CHUNK.size:
        return scene, b""
    length, kind = _CHUNK.unpack_from(data, end)
    return scene, data[end + _CHUNK.size :][:length] if kind == b"BIN\0" else b""


def _places(scene: Scene) -> Iterator[tuple[int, NDArray[np.float64]]]:
    """Walk through the tree of nodes: the number of each mesh, and where it is put."""
    nodes = scene["nodes"]
    roots = scene["scenes"][scene.get("scene", 0)].get("nodes", [])
    waiting = [(root, np.eye(4)) for root in reversed(roots)]
    seen: set[int] = set()
    while waiting:
        number, above = waiting.pop()
        if number in seen:
            raise ValueError(f"node {number} of its scene is there twice")
        seen.add(number)
        node = nodes[number]
        matrix = above @ _matrix(node)
        if "mesh" in node:
            yield node["mesh"], matrix
        waiting += [(child, matrix) for child in reversed(node.get("children", []))]


def _matrix(node: Scene) -> NDArray[np.float64]:
    """Return what takes a node's coordinates to those of the node above it."""
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), np.float64)
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * np.array(node.get("scale", (1, 1, 1)), np.float64)
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def _triangles(
    scene: Scene, binary: bytes, primitive: Scene
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read one part; lines and points have no triangles."""
    mode = primitive.get("mode", _TRIANGLES)
    if mode not in (_TRIANGLES, _STRIP, _FAN):
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    with np.errstate(invalid="ignore"):  # array_fault finds what is no number
        points = _array(scene, binary, primitive["attributes"]["POSITION"]).astype(np.float64)
    corners = np.arange(len(points))
    if "indices" in primitive:
        corners = _array(scene, binary, primitive["indices"]).ravel().astype(np.int64)
        if len(corners) and not 0 <= corners.min() <= corners.max() < len(points):
            raise ValueError("a triangle names a vertex that does not exist")
    if mode == _STRIP:
        triangles = np.column_stack((corners[:-2], corners[1:-1], corners[2:]))
        triangles[1::2] = triangles[1::2, ::-1]
        return points, triangles
    if mode == _FAN:
        first = np.broadcast_to(corners[:1], len(corners[2:]))
        return points, np.column_stack((first, corners[1:-1], corners[2:]))
    if len(corners) % 3:
        raise ValueError(f"{len(corners)} corners do not make triangles")
    return points, corners.reshape(-1, 3)


def _array(scene: Scene, binary: bytes, number: int) -> NDArray[Any]:
    """Read one of the arrays, (items, width); numpy sees to it that it lies within the file."""
    accessor = scene["accessors"][number]
    if "sparse" in accessor or "bufferView" not in accessor:
        raise ValueError("an array is sparse or compressed; export the scene plainly")
    view = scene["bufferViews"][accessor["bufferView"]]
    if view["buffer"] != 0 or "uri" in scene["buffers"][0]:
        raise ValueError("an array is in another file; export the scene as one")
    kind, width = np.dtype(_TYPES[accessor["componentType"]]), _WIDTHS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * width)
    if stride < kind.itemsize * width:
        raise ValueError("the items of an array lie on each other")
    return np.ndarray((accessor["count"], width), kind, binary, start, (stride, kind.itemsize))
