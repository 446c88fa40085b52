import re
from pathlib import Path

import yaml
from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match
from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

from gipkg import registry
from gipkg.errors import PluginError, did_you_mean
from gipkg.fingerprints import fingerprint_module
from gipkg.learning.config import NetworkConfig, TrainingConfig
from gipkg.parameters import validated
from gipkg.shards import shard_of

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
    for reserved in ("shards", "protocols") if kind == "dataset" else ():
        parameters.pop(reserved, None)
    try:
        if ":" in plugin:
            plugin, target = name, plugin
            registry.register_local(kind, name, target)
        code = registry.fingerprint(kind, plugin)
        if parameters:
            registry.create(kind, plugin, parameters)
    except PluginError as error:
        raise WorkflowError(f"configuration, {key}: {error}") from error
    return {"plugin": plugin, "target": target, "parameters": parameters, "code": code}


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


def slug(column):
    """Turn the heading of a column into a name for files."""
    return re.sub("[^a-z0-9]+", "-", column.lower()).strip("-")


def chosen_columns():
    """Return the columns by slug, every reference in them checked."""
    columns = {}
    for number, column in enumerate(config["columns"]):
        key = f"columns.{number}"
        for field, section in (("baseline", "baselines"), ("parametrizer", "parametrizers")):
            if field in column:
                require_defined(f"{key}.{field}", column[field], section)
        for descriptor in column.get("descriptors", ()):
            require_defined(f"{key}.descriptors", descriptor, "descriptors")
        if "network" in column:
            require_defined(f"{key}.network", column["network"], "networks")
        name = slug(column["column"])
        if name in columns:
            raise WorkflowError(f"configuration, {key}: {name!r} names two columns")
        columns[name] = column
    return columns


def instances(kind, names):
    return {name: instance(kind, name) for name in sorted(set(names))}


def picked(among, names):
    """Return some of the instances, in one order."""
    return {name: among[name] for name in sorted(set(names))}


def chosen_methods():
    """Return the methods of the distortion table: parametrizer -> name in the paper, or None."""
    methods = config["distortion"]["methods"]
    for number, method in enumerate(methods):
        key = f"distortion.methods.{number}.parametrizer"
        require_defined(key, method["parametrizer"], "parametrizers")
    return {method["parametrizer"]: method.get("paper") for method in methods}


def chosen_databases(key, asked, suits):
    """Return the databases asked for under a key; by default the real ones at hand that suit.

    Where there is none of them, the generated ones stand in.
    """
    if asked != "auto":
        for name in asked:
            require_defined(key, name, "datasets")
        return asked
    root = Path(config["data_root"])
    plugins = {name: dataset_plugin(name) for name in config["datasets"]}
    real = [name for name, plugin in plugins.items() if not plugin.tags.generated]
    found = [name for name in real if suits(name) and plugins[name].available(root)]
    return found or [name for name in plugins if name not in real]


def chosen_subject():
    """Return the database and shape of Figures 2 to 4: the first whose database is at hand."""
    for number, subject in enumerate(config["figures"]["shapes"]):
        key = f"figures.shapes.{number}.database"
        require_defined(key, subject["database"], "datasets")
        if dataset_plugin(subject["database"]).available(Path(config["data_root"])):
            return subject
    raise WorkflowError("configuration, figures.shapes: none of the databases is at hand")


def dataset_plugin(name):
    spec = instance("dataset", name)
    return registry.create("dataset", spec["plugin"], spec["parameters"])


def protocols_of(database):
    """Return how a database is split: protocol -> shapes of each class that train."""
    own = config["datasets"][database].get("protocols")
    if own:
        return own
    protocols = dataset_plugin(database).protocols
    return {name: protocol.train_per_class for name, protocol in protocols.items()}


def is_mapped_only(database):
    """Tell whether a database is there for its surfaces: nothing is classified in it."""
    return not protocols_of(database)


def alternatives(names):
    """Return a regular expression for any of the names, and for nothing where there is none."""
    return "|".join(map(re.escape, names)) or "(?!)"


def shards_of(pattern):
    """Return an input function: the files of all shards of a database, in order."""

    def shards(wildcards):
        count = config["datasets"][wildcards.database]["shards"]
        return expand(pattern, shard=range(count), allow_missing=True)

    return shards


def column_shards(wildcards):
    """Return the last files of a column that are made shape by shape."""
    column = COLUMNS[wildcards.column]
    if "baseline" in column:
        pattern = f"results/baselines/{{database}}/{column['baseline']}/{{shard}}.npz"
    else:
        images = f"{column['parametrizer']}/{'+'.join(column['descriptors'])}"
        pattern = f"results/images/{{database}}/{images}/{{shard}}.npz"
    return shards_of(pattern)(wildcards)


def channels(wildcards):
    """Return the shards of the descriptors that an image shows, in the order of its name."""
    return expand(
        "results/descriptors/{database}/{descriptor}/{shard}.npz",
        descriptor=wildcards.descriptors.split("+"),
        allow_missing=True,
    )


def predictions(wildcards):
    """Return the predictions of a column under one protocol, one for each seed."""
    column = COLUMNS[wildcards.column]
    if "baseline" in column:
        pattern = f"results/baselines/{{database}}/{column['baseline']}/{{protocol}}-{{seed}}.npz"
    else:
        pattern = "results/learning/{database}/{column}/{protocol}-{seed}.npz"
    return expand(pattern, seed=config["seeds"], allow_missing=True)


def figure_params(figure):
    """Return what the script of one of Figures 2 to 4 depends on beside its input."""
    chosen = config["figures"][figure]
    return {
        "config": chosen,
        "plugins": {
            "dataset": picked(DATASETS, [SUBJECT["database"]]),
            "parametrizer": picked(PARAMETRIZERS, chosen["parametrizers"]),
        },
        "code": fingerprint_module(f"gipkg.reporting.figures.{figure}"),
    }


require_valid(config)

OTHER_RESULTS = ("distortion", "reconstruction", "figures")
"""Sections of the configuration that Table 1 does not depend on."""

COLUMNS = chosen_columns()
DATABASES = chosen_databases("databases", config["databases"], protocols_of)
PROTOCOLS = {database: protocols_of(database) for database in DATABASES}
LEARNED = [name for name, column in COLUMNS.items() if "network" in column]
METHODS = chosen_methods()
MAPPED = chosen_databases("distortion.databases", config["distortion"]["databases"], is_mapped_only)
for name, protocols in PROTOCOLS.items():
    if not protocols:
        raise WorkflowError(
            f"configuration, databases: {name!r} has no protocol to split it by; "
            f"datasets.{name}.protocols can name one"
        )
for name in config["reconstruction"]["parametrizers"]:
    require_defined("reconstruction.parametrizers", name, "parametrizers")
SUBJECT = chosen_subject()
for figure in ("figure2", "figure3", "figure4"):
    for name in config["figures"][figure]["parametrizers"]:
        require_defined(f"figures.{figure}.parametrizers", name, "parametrizers")

DATASETS = instances("dataset", (*DATABASES, *MAPPED, SUBJECT["database"]))
PARAMETRIZERS = instances(
    "parametrizer",
    (
        *(COLUMNS[name]["parametrizer"] for name in LEARNED),
        *METHODS,
        *config["reconstruction"]["parametrizers"],
        *config["figures"]["figure2"]["parametrizers"],
        *config["figures"]["figure3"]["parametrizers"],
        *config["figures"]["figure4"]["parametrizers"],
    ),
)
DESCRIPTORS = instances(
    "descriptor", (one for name in LEARNED for one in COLUMNS[name]["descriptors"])
)
BASELINES = instances(
    "baseline", (column["baseline"] for column in COLUMNS.values() if "baseline" in column)
)
NETWORKS = {name: network(COLUMNS[name]["network"]) for name in LEARNED}

SUBJECT_SHARD = shard_of(SUBJECT["shape"], config["datasets"][SUBJECT["database"]]["shards"])
SUBJECT_SURFACES = f"results/surfaces/{SUBJECT['database']}/{SUBJECT_SHARD}.npz"


wildcard_constraints:
    database=alternatives(DATASETS),
    parametrizer=alternatives(PARAMETRIZERS),
    descriptor=alternatives(DESCRIPTORS),
    baseline=alternatives(BASELINES),
    column=alternatives(COLUMNS),
    protocol="[A-Za-z0-9]+",
    seed=r"\d+",
    shard=r"\d+",
