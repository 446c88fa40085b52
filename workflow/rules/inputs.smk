def shards_of(pattern):
    """Return an input function: the files of all shards of a database, in order."""

    def shards(wildcards):
        # A faulty database is some test shapes of its source: one shard.
        faulty = wildcards.get("database") in BEYOND["perturbed"]
        count = 1 if faulty else config["datasets"][source_of(wildcards)]["shards"]
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


def splits(wildcards):
    """Return the splits of a database under one protocol, one for each seed of a table."""
    pattern = "results/datasets/{source}/splits/{protocol}-{seed}.csv"
    source = source_of(wildcards)
    return expand(pattern, source=source, seed=seeds(wildcards), allow_missing=True)


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


def surface_shard(subject):
    """Return the shard with the surface of one shape."""
    count = config["datasets"][subject["database"]]["shards"]
    shard = shard_of(subject["shape"], count)
    return f"results/surfaces/{subject['database']}/{shard}.npz"


def figure_surfaces(figure):
    """Return the shards with the shapes that a figure shows, one for each of them."""
    return [surface_shard(subject) for subject in SUBJECTS[figure]]


def beyond_evaluations(wildcards):
    """Return the scores of the table beyond the paper: setting by setting, column by column."""
    return [
        f"results/evaluation/beyond/{database}/{column}/{protocol}.json"
        for _, database, protocol, _ in beyond_settings()
        for column in BEYOND["columns"]
    ]
