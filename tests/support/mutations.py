"""Small mesh files of every format and kind, and what can go wrong with their bytes."""

from __future__ import annotations

import struct
from functools import cache
from random import Random

import trimesh

from tests.surfaces.solids import bare, sphere, torus

WILD = [b"nan", b"-inf", b"1e308", b"1e-310", b"-1", b"0", b"4294967295", b"99999999999999999999"]
WORDS = [0, 1, 0x7F, 0x80, 0xFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000]
"""Counts that are too large or negative, infinity and no number, as 32 bits."""

POLYGONS = b"8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n" + b"".join(
    b"%d %b\n" % (len(face.split()), face)
    for face in (b"0 3 2 1", b"4 5 6 7", b"0 1 5 4", b"1 2 6 5", b"2 3 7 6", b"3 0 4", b"3 4 7")
).replace(b"8 6", b"8 7")
PLY_TEXT = (
    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    b"property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"
)
OBJ_TEXT = (
    b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl a\n"
    b"f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf -2 -1 -3\nf 3 1 4\n"
)


@cache
def whole_files() -> dict[str, tuple[str, bytes]]:
    """Return the files that damage begins with: name -> suffix and content."""
    ring, cup = torus(9, 6), bare(sphere(1).vertices, sphere(1).faces[5:])
    files = {}
    for name, mesh in (("ring", ring), ("cup", cup)):
        for kind in ("off", "obj", "ply", "stl", "stl_ascii", "glb"):
            content = mesh.export(file_type=kind)
            content = content.encode() if isinstance(content, str) else content
            files[f"{name}.{kind}"] = kind.partition("_")[0], content
    scene = trimesh.Scene([ring, cup])
    binary = b"OFF BINARY\n" + struct.pack(">3i", len(cup.vertices), len(cup.faces), 0)
    binary += cup.vertices.astype(">f4").tobytes()
    binary += b"".join(struct.pack(">5i", 3, *face, 0) for face in cup.faces)
    return files | {
        "scene.glb": ("glb", scene.export(file_type="glb")),
        "binary.off": ("off", binary),
        "polygons.off": ("off", b"OFF\n" + POLYGONS),
        "text.ply": ("ply", PLY_TEXT),
        "text.obj": ("obj", OBJ_TEXT),
    }


def damaged(random: Random) -> tuple[str, bytes]:
    """Return the suffix and the content of a file to which up to five things have happened."""
    files = whole_files()
    suffix, whole = files[random.choice(sorted(files))]
    content = bytearray(whole)
    for _ in range(random.randint(1, 5)):
        if not content:
            break
        at = random.randrange(len(content))
        match random.randrange(8):
            case 0:
                del content[at:]
            case 1:
                content[at] = random.randrange(256)
            case 2:
                del content[at : at + random.randint(1, 40)]
            case 3:
                content[at:at] = content[at : at + random.randint(1, 400)] * random.randint(1, 9)
            case 4:
                content[at : at + 4] = struct.pack("<I", random.choice(WORDS))
            case 5:
                content[at : at + 4] = struct.pack(">I", random.choice(WORDS))
            case 6:
                _replace_a_word(content, at, random)
            case 7:
                _, other = files[random.choice(sorted(files))]
                content[at:] = other[random.randrange(len(other)) :]
    return suffix, bytes(content)


def _replace_a_word(content: bytearray, at: int, random: Random) -> None:
    """Put a number that is hard to bear in place of the word, or the JSON value, at a place."""
    separators = b" \n\t,:[]{}"
    end = next((k for k in range(at, len(content)) if content[k] in separators), len(content))
    start = next((k + 1 for k in range(at, -1, -1) if content[k] in separators), 0)
    content[min(start, end) : end] = random.choice(WILD)
