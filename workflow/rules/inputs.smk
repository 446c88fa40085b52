def shards_of(pattern):
    """Return an input function: the files of all shards of a database, in order."""

    def shards(wildcards):
        # A faulty database is some test shapes of its source: one shard.
        faulty = wildcards.get("database") in BEYOND["perturbed"]
        source = wildcards.get("source", wildcards.get("database"))
        count = 1 if faulty else config["datasets"][source]["shards"]
        return expand(pattern, shard=range(count), allow_missing=True)

    return shards


def images_of(column):
    """Return where the images of a learned column are, below their database."""
    descriptors = "+".join(column["descriptors"])
    return f"{column['parametrizer']}/{descriptors}/{column.get('images', 'standard')}"


def trained(column):
    """Return where the predictions of a column are, below results/."""
    if "baseline" in column:
        return f"baselines/{{database}}/{column['baseline']}"
    return f"learning/{{database}}/{images_of(column)}/{column['network']}"


def shown(column):
    """Return what a column is trained on, made shape by shape: stage and method."""
    if "baseline" in column:
        return "baselines", column["baseline"]
    return "images", images_of(column)


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


def channels(wildcards):
    """Return the shards of the descriptors that an image shows, in the order of its name."""
    return expand(
        "results/descriptors/{database}/{descriptor}/{shard}.npz",
        descriptor=wildcards.descriptors.split("+"),
        allow_missing=True,
    )


def predictions(wildcards):
    """Return the predictions of a column under one protocol, one for each seed."""
    table = BEYOND if wildcards.table == "beyond" else TABLES[wildcards.table]
    folder = trained(table["columns"][wildcards.column])
    pattern = f"results/{folder}/{{protocol}}-{{seed}}.npz"
    return expand(pattern, seed=seeds(wildcards), allow_missing=True)


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


def protocol(wildcards):
    """Return what takes part and trains under a protocol of a database, or beyond the paper."""
    known = {**BEYOND["few_shot"], **PROTOCOLS[wildcards.database]}
    return asdict(known[wildcards.protocol])


def splits(wildcards):
    """Return the splits of a database under one protocol, one for each seed of a table."""
    pattern = "results/datasets/{source}/splits/{protocol}-{seed}.csv"
    source = source_of(wildcards.database)
    return expand(pattern, source=source, seed=seeds(wildcards), allow_missing=True)


def table_protocols(wildcards):
    """Return what takes part and trains in the rows of a table: database -> protocol by name."""
    return {
        database: {name: asdict(one) for name, one in PROTOCOLS[database].items()}
        for database in TABLES[wildcards.table]["databases"]
    }


def table_rows(wildcards):
    """Return the rows of a table: database and protocol."""
    databases = TABLES[wildcards.table]["databases"]
    return [(database, protocol) for database in databases for protocol in PROTOCOLS[database]]


def table_failures(wildcards):
    """Return the shapes lost to each column of a table, database by database."""
    table = TABLES[wildcards.table]
    columns = [shown(column) for column in table["columns"].values()]
    return [
        f"results/failures/{stage}/{database}/{method}.json"
        for database in table["databases"]
        for stage, method in columns
    ]


def evaluations(wildcards):
    """Return the scores of a table, row by row."""
    return [
        f"results/evaluation/{wildcards.table}/{database}/{column}/{protocol}.json"
        for database, protocol in table_rows(wildcards)
        for column in TABLES[wildcards.table]["columns"]
    ]


def timings(wildcards):
    """Return what the trainings of a table took: row by row, column by column, seed by seed."""
    chosen = table_seeds(wildcards)
    return [
        f"results/benchmarks/{trained(column)}/{protocol}-{seed}.json".format(database=database)
        for database, protocol in table_rows(wildcards)
        for column in TABLES[wildcards.table]["columns"].values()
        for seed in chosen[database]
    ]


def table_listings(wildcards):
    """Return the lists of shapes of the databases of a table."""
    databases = TABLES[wildcards.table]["databases"]
    return expand("results/datasets/{database}/shapes.csv", database=databases)


def table_reference(wildcards):
    """Return the paper's own figures; a study of the settings of a table has that table's."""
    name = wildcards.table.removesuffix("_study")
    return Path(workflow.basedir) / "results" / "reference" / f"{name}.csv"


def table_surveys(wildcards):
    """Return what is said of the surfaces of the databases of a table."""
    databases = TABLES[wildcards.table]["databases"]
    return expand("results/surfaces/{database}.json", database=databases)


def table_plugins(wildcards):
    """Return the plugins that a table is made of."""
    return plugins_of(TABLES[wildcards.table])


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


def table_networks(wildcards):
    """Return the networks of a table with all of their parameters: slug of the column -> network."""
    return networks_of(TABLES[wildcards.table])


def networks_of(table):
    """Return the networks of the columns of a table."""
    columns = table["columns"]
    return {
        name: NETWORKS[column["network"]] for name, column in columns.items() if "network" in column
    }


def drawn(of_table):
    """Return what a function says of a table as an input function of the table's curves."""
    return lambda wildcards: of_table(SimpleNamespace(table=CURVES[wildcards.figure]))


def table_config(wildcards):
    """Return the sections of the configuration that a table depends on.

    What it takes of plugins and networks is said of each of them, resolved.
    """
    apart = ("parametrizers", "descriptors", "baselines", "networks")
    other = {*TABLES, *apart, "beyond", "distortion", "reconstruction", "figures", "page"}
    return {key: part for key, part in config.items() if key not in other - {wildcards.table}}


def surface_shard(subject):
    """Return the shard with the surface of one shape."""
    count = config["datasets"][subject["database"]]["shards"]
    shard = shard_of(subject["shape"], count)
    return f"results/surfaces/{subject['database']}/{shard}.npz"


def figure_surfaces(figure):
    """Return the shards with the shapes that a figure shows, one for each of them."""
    return [surface_shard(subject) for subject in SUBJECTS[figure]]


def figure_params(figure):
    """Return what the script of a figure of one or two shapes depends on beside its input."""
    chosen, subjects = config["figures"][figure], SUBJECTS[figure]
    return {
        "config": chosen,
        "shapes": [subject["shape"] for subject in subjects],
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


def beyond_evaluations(wildcards):
    """Return the scores of the table beyond the paper: setting by setting, column by column."""
    return [
        f"results/evaluation/beyond/{database}/{column}/{protocol}.json"
        for _, database, protocol, _ in beyond_settings()
        for column in BEYOND["columns"]
    ]
