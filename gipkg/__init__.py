"""Geometry images for learning 3D shapes: mesh to authalic sphere to octahedron to image.

The names below are imported at first use, so that ``import gipkg`` costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gipkg.api import SphericalMap, Volume
    from gipkg.descriptors import describe
    from gipkg.evaluation.distortion import distortion
    from gipkg.images.lookup import geometry_image
    from gipkg.images.reconstruct import reconstruct
    from gipkg.parametrizers import parametrize
    from gipkg.surfaces import prepare

__version__ = "0.1.0"

__all__ = [
    "SphericalMap",
    "Volume",
    "__version__",
    "describe",
    "distortion",
    "geometry_image",
    "parametrize",
    "prepare",
    "reconstruct",
]

_EXPORTS = {
    "SphericalMap": "gipkg.api",
    "Volume": "gipkg.api",
    "describe": "gipkg.descriptors",
    "distortion": "gipkg.evaluation.distortion",
    "geometry_image": "gipkg.images.lookup",
    "parametrize": "gipkg.parametrizers",
    "prepare": "gipkg.surfaces",
    "reconstruct": "gipkg.images.reconstruct",
}


def __getattr__(name: str) -> Any:
    """Import an exported name at first use (PEP 562)."""
    if name not in _EXPORTS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_EXPORTS[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
