"""The one decorator for compiled functions.

Numba keeps compiled code from one process to the next and recompiles a function when its own file
changes, but not when a function in another file that it calls does. Here the cache is kept in a
folder named after the source of every compiled function of gipkg, so that none is ever stale.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numba
import pooch

_config: Any = numba.config


@cache
def _cache_folder() -> str:
    digest = sha256(numba.__version__.encode())
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        source = path.read_bytes()
        if b"gipkg.compilation" in source:
            digest.update(source)
    return str(Path(pooch.os_cache("gipkg")) / "compiled" / digest.hexdigest()[:16])


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function of arrays and numbers at its first call, and keep the code."""
    before = _config.CACHE_DIR
    _config.CACHE_DIR = _cache_folder()
    try:
        return numba.njit(cache=True)(function)
    finally:
        _config.CACHE_DIR = before
