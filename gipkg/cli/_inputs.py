"""What commands read: a surface of any mesh, and a spherical map of any mesh or of a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from gipkg.cli._batch import Facts

if TYPE_CHECKING:
    from gipkg.api import Parametrizer, SphericalMap
    from gipkg.surfaces import Surface


def read_surface(path: Path) -> tuple[Surface, dict[str, Any]]:
    """Read a mesh and repair it as far as needed; say which steps that took."""
    from gipkg.surfaces import prepare

    surface = prepare(path)
    return surface, {
        "vertices": len(surface.mesh.vertices),
        "faces": len(surface.mesh.faces),
        "prepared": [step.name for step in surface.report.steps],
    }


def read_map(path: Path, parametrizer: Parametrizer) -> tuple[SphericalMap, dict[str, Any]]:
    """Read a spherical map as it is, or a mesh, which is prepared and mapped."""
    from gipkg.api import SphericalMap
    from gipkg.formats import maps

    if maps.is_map(path):
        known = maps.read_map(path)
        return known, {"vertices": len(known.mesh.vertices), "faces": len(known.mesh.faces)}
    surface, facts = read_surface(path)
    return SphericalMap(surface.mesh, parametrizer.parametrize(surface.mesh)), facts


def repairs(facts: Facts) -> str:
    """Word what was done to a mesh before anything else; nothing where it was left as it is."""
    steps = facts.get("prepared")
    return f"repaired first ({', '.join(steps)})" if steps else ""
