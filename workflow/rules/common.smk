def alternatives(names):
    """Return a regular expression for any of the names, and for nothing where there is none."""
    return "|".join(map(re.escape, names)) or "(?!)"


require_valid(config)
for database in config["datasets"].values():
    database.setdefault("shards", 1)

CURVES = {"figure8": "table1", "figure_table2": "table2"}
"""Precision-recall curves: figure -> table."""

TABLES = chosen_tables()
BEYOND = chosen_beyond()
COLUMNS = [one for table in (*TABLES.values(), BEYOND) for one in table["columns"].values()]
LEARNED = [column for column in COLUMNS if "network" in column]
CLASSIFIED = [database for table in TABLES.values() for database in table["databases"]]
PROTOCOLS = {database: protocols_of(database) for database in (*CLASSIFIED, BEYOND["database"])}
METHODS = chosen_methods()
MAPPED = chosen_databases("distortion", is_mapped_only)
for name in config["reconstruction"]["parametrizers"]:
    require_defined("reconstruction.parametrizers", name, "parametrizers")
SUBJECTS = chosen_subjects()
for figure in SUBJECTS:
    for name in config["figures"][figure]["parametrizers"]:
        require_defined(f"figures.{figure}.parametrizers", name, "parametrizers")

ON_PAGE = chosen_scenes()
PICTURED = [one["database"] for subjects in (*SUBJECTS.values(), ON_PAGE) for one in subjects]
DATASETS = instances("dataset", (*CLASSIFIED, BEYOND["database"], *MAPPED, *PICTURED))
PARAMETRIZERS = instances(
    "parametrizer",
    (
        *(column["parametrizer"] for column in LEARNED),
        *METHODS,
        *config["reconstruction"]["parametrizers"],
        *(name for figure in SUBJECTS for name in config["figures"][figure]["parametrizers"]),
        *config["page"]["parametrizers"],
    ),
)
DESCRIPTORS = instances(
    "descriptor",
    (
        *(one for column in LEARNED for one in column["descriptors"]),
        *config["page"]["descriptors"],
    ),
)
BASELINES = instances("baseline", (one["baseline"] for one in COLUMNS if "baseline" in one))
NETWORKS = {column["network"]: network(column["network"]) for column in LEARNED}
IMAGES = {name: image_config(name) for name in config["images"]}


wildcard_constraints:
    database=alternatives((*DATASETS, *BEYOND["perturbed"])),
    parametrizer=alternatives(PARAMETRIZERS),
    descriptor=alternatives(DESCRIPTORS),
    descriptors="[a-z0-9+-]+",
    images=alternatives(IMAGES),
    network=alternatives(NETWORKS),
    baseline=alternatives(BASELINES),
    table=alternatives((*TABLES, "beyond")),
    column="[a-z0-9-]+",
    protocol="[A-Za-z0-9]+",
    seed=r"\d+",
    shard=r"\d+",
