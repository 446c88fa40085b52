"""How large a file is read: beyond that it is refused by name, not ended by the system."""

LARGEST_FILE = 2**29
"""Bytes of a mesh. Reading one takes up to ten times as much memory; thirty, and a gigabyte at the
most, where it is nothing but faces of a byte."""

MOST_FACES = 10_000_000
"""Faces of a mesh, and vertices three times as many: as many as triangles that share none."""


def check_counts(vertices: int, faces: int) -> None:
    """Refuse a mesh that is too large.

    Raises
    ------
    ValueError
        It has more vertices or faces than are read.
    """
    if faces > MOST_FACES or vertices > 3 * MOST_FACES:
        raise ValueError(
            f"it has {vertices} vertices and {faces} faces, more than {3 * MOST_FACES} and "
            f"{MOST_FACES}; decimate it"
        )
