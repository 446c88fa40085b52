"""The parameters of a plugin for people: their table, and errors that name the choices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from pydantic import ValidationError

from gipkg.api import Plugin
from gipkg.errors import InvalidParameterError, did_you_mean

P = TypeVar("P", bound=Plugin)

_BOUNDS = {
    "exclusiveMinimum": "> {}",
    "minimum": ">= {}",
    "exclusiveMaximum": "< {}",
    "maximum": "<= {}",
    "multipleOf": "multiple of {}",
    "minItems": "at least {} items",
    "maxItems": "at most {} items",
    "const": "only {!r}",
}


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a plugin, as text."""

    name: str
    type: str
    default: str
    bounds: str
    """Limits or choices; empty where every value of the type will do."""
    help: str


def parameters_of(plugin: type[Plugin]) -> tuple[Parameter, ...]:
    """Describe the parameters of a plugin, in the order of its fields."""
    schema = plugin.model_json_schema()
    definitions = schema.get("$defs", {})
    return tuple(
        Parameter(
            name=name,
            type=_type_name(info.annotation),
            default=repr(info.get_default(call_default_factory=True, validated_data={})),
            bounds=_bounds(schema["properties"][name], definitions),
            help=info.description or "",
        )
        for name, info in plugin.model_fields.items()
    )


def validated(plugin: type[P], label: str, parameters: Mapping[str, Any]) -> P:
    """Build a plugin from parameters of unknown quality.

    Parameters
    ----------
    plugin : type[Plugin]
        The class to instantiate.
    label : str
        What to call it in an error, such as ``descriptor 'hks'``.
    parameters : mapping
        Names to values, as they stand in a config.

    Raises
    ------
    InvalidParameterError
        Names the parameter, the value, and the bounds or choices.
    """
    try:
        return plugin.model_validate(dict(parameters))
    except ValidationError as error:
        known = {parameter.name: parameter for parameter in parameters_of(plugin)}
        faults = "; ".join(_fault(fault, known) for fault in error.errors())
        raise InvalidParameterError(f"{label}: {faults}") from error


def _fault(fault: Any, known: Mapping[str, Parameter]) -> str:
    if not fault["loc"]:
        return str(fault["msg"])
    name = str(fault["loc"][0])
    if name not in known:
        takes = ", ".join(known) or "none"
        return f"no parameter {name!r}{did_you_mean(name, known)} (parameters: {takes})"
    parameter = known[name]
    allowed = ", ".join(filter(None, (parameter.type, parameter.bounds)))
    return f"{name} = {fault['input']!r}: {fault['msg']} ({allowed}; default {parameter.default})"


def _type_name(annotation: Any) -> str:
    if isinstance(annotation, type) and not hasattr(annotation, "__args__"):
        return annotation.__name__
    return str(annotation).replace("typing.", "")


def _bounds(schema: Mapping[str, Any], definitions: Mapping[str, Any]) -> str:
    if reference := schema.get("$ref"):
        return _bounds(definitions[reference.rsplit("/", 1)[-1]], definitions)
    parts = [text.format(schema[key]) for key, text in _BOUNDS.items() if key in schema]
    if choices := schema.get("enum"):
        parts.append("one of " + ", ".join(map(repr, choices)))
    parts += [_bounds(option, definitions) for option in schema.get("anyOf", ())]
    if isinstance(items := schema.get("items"), Mapping) and (each := _bounds(items, definitions)):
        parts.append(f"each {each}")
    return ", ".join(filter(None, parts))
