import re
from dataclasses import asdict, replace
from pathlib import Path
from types import SimpleNamespace

import yaml
from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match
from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

from gipkg import registry
from gipkg.api import Protocol
from gipkg.errors import LearningError, PluginError, did_you_mean
from gipkg.fingerprints import fingerprint_module
from gipkg.images.config import ImageConfig
from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.learning.feature_maps import feature_map_size, padded_size
from gipkg.parameters import validated
from gipkg.shards import shard_of
from gipkg.surfaces.perturbations import PERTURBATIONS

min_version("9.9")


def require_valid(config):
    """Stop at the first fault of the configuration, naming the key and the choices."""
    path = Path(workflow.basedir) / "workflow" / "schemas" / "config.schema.yaml"
    schema = yaml.safe_load(path.read_text(encoding="utf-8"))
    error = best_match(Draft202012Validator(schema).iter_errors(config))
    if error is not None:
        key = ".".join(map(str, error.absolute_path)) or "the top level"
        choices = error.schema.get("properties", {}) if isinstance(error.schema, dict) else {}
        hint = f" (keys: {', '.join(choices)})" if error.validator == "additionalProperties" else ""
        raise WorkflowError(f"configuration, {key}: {error.message}{hint}")


def require_defined(key, name, section):
    """Stop where the configuration refers to an instance that it does not define."""
    known = config[section]
    if name not in known:
        hint = did_you_mean(name, known)
        raise WorkflowError(
            f"configuration, {key}: {name!r} is not defined under {section}{hint} "
            f"({', '.join(known)})"
        )


def instance(kind, name):
    """Resolve an instance of a plugin to what its jobs need, its code's fingerprint included."""
    key = f"{kind}s.{name}"
    parameters = dict(config[f"{kind}s"][name])
    plugin, target = parameters.pop("plugin"), None
    for reserved in ("shards", "splits", "protocols", "surface") if kind == "dataset" else ():
        parameters.pop(reserved, None)
    try:
        if ":" in plugin:
            plugin, target = name, plugin
            registry.register_local(kind, name, target)
        code = registry.fingerprint(kind, plugin)
        spec = {"plugin": plugin, "target": target, "parameters": parameters, "code": code}
        if kind == "dataset":
            dataset = registry.create(kind, plugin, parameters)
            spec["stamp"] = dataset.stamp(Path(config["data_root"]))
        elif parameters:
            registry.create(kind, plugin, parameters)
    except PluginError as error:
        raise WorkflowError(f"configuration, {key}: {error}") from error
    return spec


def network(name):
    """Resolve a network to all of its parameters, defaults included."""
    parts = {"network": NetworkConfig, "training": TrainingConfig}
    chosen = config["networks"][name]
    try:
        return {
            part: validated(model, part, chosen.get(part, {})).model_dump(mode="json")
            for part, model in parts.items()
        }
    except PluginError as error:
        raise WorkflowError(f"configuration, networks.{name}: {error}") from error


def require_fit(key, column):
    """Stop where a column's network would leave nothing of its images."""
    chosen = NetworkConfig(**network(column["network"])["network"])
    shown = column.get("images", "standard")
    try:
        feature_map_size(chosen, padded_size(chosen, image_config(shown)["size"]))
    except LearningError as error:
        raise WorkflowError(
            f"configuration, {key}: network {column['network']!r} on images {shown!r}: {error}"
        ) from error


def image_config(name):
    """Resolve images to all of their parameters, defaults included."""
    try:
        return validated(ImageConfig, "images", config["images"][name]).model_dump()
    except PluginError as error:
        raise WorkflowError(f"configuration, images.{name}: {error}") from error


def instances(kind, names):
    return {name: instance(kind, name) for name in sorted(set(names))}
