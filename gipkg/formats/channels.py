"""What descriptors say of the vertices of a mesh, to a file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gipkg.files import atomic, write_csv
from gipkg.formats import CHANNEL_SUFFIXES


def write_channels(path: Path, channels: NDArray[np.floating], names: Sequence[str]) -> None:
    """Write one row a vertex, in the mesh's order, atomically and exactly.

    Parameters
    ----------
    path : Path
        Ends in one of `CHANNEL_SUFFIXES`.
    channels : (V, C) array
    names : sequence of C str
        The header of a ``.csv``; an ``.npy`` has none.

    Raises
    ------
    ValueError
        The suffix is none of them.
    """
    match path.suffix.lower():
        case ".npy":
            with atomic(path) as stream:
                np.save(stream, channels, allow_pickle=False)
        case ".csv":
            write_csv(path, names, channels.tolist())
        case _:
            raise ValueError(f"{path}: channels are written as {', '.join(CHANNEL_SUFFIXES)}")
