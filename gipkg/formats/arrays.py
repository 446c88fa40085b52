"""NumPy's own files from anywhere: no pickles, and no more memory than the file is long."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Collection
from pathlib import Path
from tokenize import TokenError
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from gipkg.zip_damage import damage_as_value_error


def read_array(path: Path) -> NDArray[Any]:
    """Read an ``.npy`` file.

    Raises
    ------
    ValueError
        It is none, holds Python objects, or says that it holds more or less than it does.
    """
    with path.open("rb") as stream:
        return _read(stream, path.stat().st_size)


def array_names(path: Path) -> tuple[str, ...]:
    """Return the names of the arrays of an ``.npz`` file, in its order.

    Raises
    ------
    ValueError
        It is none.
    """
    with damage_as_value_error(), zipfile.ZipFile(path) as archive:
        return tuple(name.removesuffix(".npy") for name in archive.namelist())


def read_arrays(path: Path, names: Collection[str] | None = None) -> dict[str, NDArray[Any]]:
    """Read arrays of an uncompressed ``.npz`` file, as :func:`gipkg.files.write_arrays` writes.

    Parameters
    ----------
    path : Path
    names : collection of str, optional
        By default all.

    Raises
    ------
    KeyError
        One that is named is not there.
    ValueError
        It is none, is compressed, damaged or holds Python objects, or says that it holds more or
        less than it does.
    """
    arrays = {}
    free = path.stat().st_size
    with damage_as_value_error(), zipfile.ZipFile(path) as archive:
        asked = None if names is None else [archive.getinfo(f"{name}.npy") for name in names]
        for member in archive.infolist() if asked is None else asked:
            if member.compress_type != zipfile.ZIP_STORED:
                raise ValueError(f"{member.filename} is compressed; write it with numpy.savez")
            with archive.open(member) as stream:
                array = _read(stream, free)
            # Members that lie on each other do not make more of the file either.
            free -= array.nbytes
            arrays[member.filename.removesuffix(".npy")] = array
    return arrays


def _read(stream: IO[bytes], available: int) -> NDArray[Any]:
    version = np.lib.format.read_magic(stream)
    readers = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }
    if version not in readers:
        raise ValueError(f"version {version} of NumPy's format holds no plain numbers")
    try:
        shape, by_columns, dtype = readers[version](stream)
    except (SyntaxError, TokenError) as error:  # NumPy lets through what its parser says.
        raise ValueError(f"its header cannot be read: {error}") from error
    if dtype.hasobject:
        raise ValueError("it holds Python objects, which are not read")
    size = math.prod(shape) * dtype.itemsize
    if min(shape, default=0) < 0 or size > available:
        raise ValueError(f"the header asks for {size} bytes, the file has {available}")
    content = stream.read(size)
    if len(content) != size:
        raise ValueError("it ends early")
    # At the end of a member its checksum is tested, which a header that asks for less would avoid.
    if stream.read(1):
        raise ValueError("it holds more than its header says")
    array = np.frombuffer(content, dtype)
    return array.reshape(shape, order="F" if by_columns else "C").copy(order="K")
