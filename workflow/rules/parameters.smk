def source_of(wildcards):
    """Return the database that a job's shapes are of; of faulty shapes, what they are made of."""
    return wildcards.get("source", wildcards.get("database")).partition("~")[0]


def surface_options(wildcards):
    """Return what the surface stage is told about a database; a faulty one has its source's."""
    return config["datasets"][source_of(wildcards)].get("surface", {})


def recipe(wildcards):
    """Return how images are made, for other shapes to be shown to the network trained on them."""

    def plugin(spec):
        return {key: spec[key] for key in ("plugin", "target", "parameters")}

    return {
        "surface": surface_options(wildcards),
        "up": dataset_plugin(wildcards.database).upright,
        "parametrizer": plugin(PARAMETRIZERS[wildcards.parametrizer]),
        "descriptors": [plugin(DESCRIPTORS[one]) for one in wildcards.descriptors.split("+")],
        "eigenpairs": config["eigenpairs"],
        **IMAGES[wildcards.images],
    }


def protocol(wildcards):
    """Return what takes part and trains under a protocol of a database, or beyond the paper."""
    known = {**BEYOND["few_shot"], **PROTOCOLS[wildcards.database]}
    return asdict(known[wildcards.protocol])


def table_seeds(wildcards):
    """Return the seeds that each database of a table takes: all of the table, or the first few."""
    table = TABLES[wildcards.table]
    return {
        database: table["seeds"][: config["datasets"][database].get("splits")]
        for database in table["databases"]
    }


def seeds(wildcards):
    """Return the seeds of a table that a database takes."""
    if wildcards.table == "beyond":
        faulty = wildcards.database in BEYOND["perturbed"]
        return BEYOND["perturbed_seeds"] if faulty else BEYOND["seeds"]
    return table_seeds(wildcards)[wildcards.database]


def table_rows(wildcards):
    """Return the rows of a table: database and protocol."""
    databases = TABLES[wildcards.table]["databases"]
    return [(database, protocol) for database in databases for protocol in PROTOCOLS[database]]


def table_protocols(wildcards):
    """Return what takes part and trains in the rows of a table: database -> protocol by name."""
    return {
        database: {name: asdict(one) for name, one in PROTOCOLS[database].items()}
        for database in TABLES[wildcards.table]["databases"]
    }


def picked(among, names):
    """Return some of the instances, in one order."""
    return {name: among[name] for name in sorted(set(names))}


def plugins_of(table):
    """Return the plugins of the columns and databases of a table."""
    columns = table["columns"].values()
    learned = [column for column in columns if "network" in column]
    descriptors = [name for column in learned for name in column["descriptors"]]
    return {
        "dataset": picked(DATASETS, table["databases"]),
        "parametrizer": picked(PARAMETRIZERS, [one["parametrizer"] for one in learned]),
        "descriptor": picked(DESCRIPTORS, descriptors),
        "baseline": picked(BASELINES, [one["baseline"] for one in columns if "baseline" in one]),
    }


def table_plugins(wildcards):
    """Return the plugins that a table is made of."""
    return plugins_of(TABLES[wildcards.table])


def networks_of(table):
    """Return the networks of the columns of a table."""
    columns = table["columns"]
    return {
        name: NETWORKS[column["network"]] for name, column in columns.items() if "network" in column
    }


def table_networks(wildcards):
    """Return the networks of a table with all of their parameters: slug of the column -> network."""
    return networks_of(TABLES[wildcards.table])


def table_config(wildcards):
    """Return the sections of the configuration that a table depends on.

    What it takes of plugins and networks is said of each of them, resolved.
    """
    apart = ("parametrizers", "descriptors", "baselines", "networks")
    other = {*TABLES, *apart, "beyond", "distortion", "reconstruction", "figures", "page"}
    return {key: part for key, part in config.items() if key not in other - {wildcards.table}}


def drawn(of_table):
    """Return what a function says of a table as a function of the wildcards of its curves."""
    return lambda wildcards: of_table(SimpleNamespace(table=CURVES[wildcards.figure]))


def figure_params(figure):
    """Return what the script of a figure of one or two shapes depends on beside its input."""
    chosen, subjects = config["figures"][figure], SUBJECTS[figure]
    return {
        "config": chosen,
        "shapes": [subject["shape"] for subject in subjects],
        "databases": [subject["database"] for subject in subjects],
        "size": config["figures"]["size"],
        "plugins": {
            "dataset": picked(DATASETS, [subject["database"] for subject in subjects]),
            "parametrizer": picked(PARAMETRIZERS, chosen["parametrizers"]),
        },
        "code": fingerprint_module(f"gipkg.reporting.figures.{figure}"),
    }


def beyond_protocols():
    """Return the protocols of the table beyond the paper: those of few training shapes, and its own."""
    own = BEYOND["protocol"]
    return {**BEYOND["few_shot"], own: PROTOCOLS[BEYOND["database"]][own]}


def beyond_settings():
    """Return what the table beyond the paper compares, a row each: where its scores are, and what
    is said of them.
    """
    database, protocol = BEYOND["database"], BEYOND["protocol"]
    few = [
        ("few-shot", database, name, str(one.train_per_class))
        for name, one in beyond_protocols().items()
    ]
    faults = [
        (one["name"], faulty, protocol, f"{one['strength']:g}")
        for faulty, one in BEYOND["perturbed"].items()
    ]
    return [*few, ("clean", database, protocol, ""), *faults]
