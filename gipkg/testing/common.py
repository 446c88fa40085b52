"""Checks that every kind of plugin passes: its metadata and its parameters."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import ValidationError

from gipkg.api import Plugin
from gipkg.testing.suite import Suite, require


def add_common_checks(suite: Suite) -> None:
    """Add the checks of this module to a suite."""
    for function in (
        metadata_is_complete,
        parameters_survive_json,
        survives_pickling,
        refuses_unknown_parameters,
        enforces_bounds,
        cannot_be_changed,
    ):
        suite.check()(function)


def metadata_is_complete(plugin: Plugin) -> None:
    """Summary and citation are there; the summary is one line."""
    require(plugin.citation.strip(), "the citation is empty")
    require(
        plugin.summary.strip() and "\n" not in plugin.summary, "the summary is not one line of text"
    )


def parameters_survive_json(plugin: Plugin) -> None:
    """The parameters come back from JSON as they were: fit for a config and for provenance."""
    again = type(plugin).model_validate_json(plugin.model_dump_json())
    require(again == plugin, f"{plugin!r} comes back from JSON as {again!r}")


def survives_pickling(plugin: Plugin) -> None:
    """The plugin can be sent to another process."""
    again = pickle.loads(pickle.dumps(plugin))
    require(again == plugin, f"{plugin!r} comes back from pickle as {again!r}")


def refuses_unknown_parameters(plugin: Plugin) -> None:
    """A misspelt parameter is an error, not a default."""
    require(_refuses(plugin, "not_a_parameter", 0), "it accepts a parameter it does not have")


def enforces_bounds(plugin: Plugin) -> None:
    """Every limit and choice in the schema is enforced."""
    schema = type(plugin).model_json_schema()
    for name, field in schema["properties"].items():
        for value in _out_of_bounds(field):
            require(_refuses(plugin, name, value), f"it accepts {name} = {value!r}, out of bounds")


def cannot_be_changed(plugin: Plugin) -> None:
    """Parameters are fixed at construction, so that results cannot depend on their history."""
    for name in type(plugin).model_fields:
        try:
            setattr(plugin, name, getattr(plugin, name))
        except (ValidationError, AttributeError, TypeError):
            continue
        require(False, f"its parameter {name} can be changed after construction")


def _refuses(plugin: Plugin, name: str, value: Any) -> bool:
    try:
        type(plugin).model_validate({name: value})
    except ValidationError:
        return True
    return False


def _out_of_bounds(schema: Mapping[str, Any]) -> Iterator[Any]:
    step = 1 if schema.get("type") == "integer" else None
    if "minimum" in schema:
        limit = schema["minimum"]
        yield limit - step if step else float(np.nextafter(limit, -np.inf))
    if "maximum" in schema:
        limit = schema["maximum"]
        yield limit + step if step else float(np.nextafter(limit, np.inf))
    yield from (schema[key] for key in ("exclusiveMinimum", "exclusiveMaximum") if key in schema)
    if "enum" in schema:
        yield "not one of the choices"
