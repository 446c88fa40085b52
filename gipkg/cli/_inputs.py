"""What commands read: a surface of any mesh, and a spherical map of any mesh or of a file."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature, unwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_type_hints

import click

from gipkg.cli._batch import Facts
from gipkg.errors import InvalidParameterError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gipkg.api import Parametrizer, SphericalMap
    from gipkg.surfaces import Surface

PREPARE = "prepare"
"""What ``-p prepare.KEY=VALUE`` is for: the repair that comes before everything else."""


def preparation(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Check keyword arguments of :func:`gipkg.prepare`, before any file is read.

    Raises
    ------
    click.UsageError
        Names the nearest argument, or the value with its bounds.
    """
    if not parameters:
        return {}
    from pydantic import create_model

    from gipkg.parameters import validated
    from gipkg.surfaces import prepare

    hints = get_type_hints(unwrap(prepare), include_extras=True)
    fields: dict[str, Any] = {
        name: (hints[name], parameter.default)
        for name, parameter in signature(prepare).parameters.items()
        if parameter.kind is parameter.KEYWORD_ONLY
    }
    model: Any = create_model(PREPARE, __config__={"extra": "forbid"}, **fields)
    try:
        known = validated(model, PREPARE, parameters)
    except InvalidParameterError as error:
        raise click.UsageError(str(error)) from error
    return {name: getattr(known, name) for name in parameters}


def read_surface(path: Path, options: Mapping[str, Any]) -> tuple[Surface, dict[str, Any]]:
    """Read a mesh and repair it as far as needed; say which steps that took."""
    from gipkg.surfaces import prepare

    surface = prepare(path, **options)
    return surface, {
        "vertices": len(surface.mesh.vertices),
        "faces": len(surface.mesh.faces),
        "prepared": [step.name for step in surface.report.steps],
    }


def read_map(
    path: Path, parametrizer: Parametrizer, options: Mapping[str, Any]
) -> tuple[SphericalMap, NDArray[np.bool_] | None, dict[str, Any]]:
    """Read a spherical map as it is, or a mesh, which is prepared and mapped.

    What was added to close a mesh is known (its topological mask), that of a map is not.
    """
    from gipkg.api import SphericalMap
    from gipkg.formats import maps

    if maps.is_map(path):
        known = maps.read_map(path)
        return known, None, {"vertices": len(known.mesh.vertices), "faces": len(known.mesh.faces)}
    surface, facts = read_surface(path, options)
    known = SphericalMap(surface.mesh, parametrizer.parametrize(surface.mesh))
    return known, surface.mask, facts


def repairs(facts: Facts) -> str:
    """Word what was done to a mesh before anything else; nothing where it was left as it is."""
    steps = facts.get("prepared")
    return f"repaired first ({', '.join(steps)})" if steps else ""
