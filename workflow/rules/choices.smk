def slug(column):
    """Turn the heading of a column into a name for files."""
    return re.sub("[^a-z0-9]+", "-", column.lower()).strip("-")


def chosen_columns(table):
    """Return the columns of a table by slug, every reference in them checked."""
    columns = {}
    for number, column in enumerate(config[table]["columns"]):
        key = f"{table}.columns.{number}"
        for field, section in (("baseline", "baselines"), ("parametrizer", "parametrizers")):
            if field in column:
                require_defined(f"{key}.{field}", column[field], section)
        for descriptor in column.get("descriptors", ()):
            require_defined(f"{key}.descriptors", descriptor, "descriptors")
        if "network" in column:
            require_defined(f"{key}.network", column["network"], "networks")
            require_defined(f"{key}.images", column.get("images", "standard"), "images")
            require_fit(key, column)
        name = slug(column["column"])
        if name in columns:
            raise WorkflowError(f"configuration, {key}: {name!r} names two columns")
        columns[name] = column
    return columns


def chosen_methods():
    """Return the methods of the distortion table: parametrizer -> name in the paper, or None."""
    methods = config["distortion"]["methods"]
    for number, method in enumerate(methods):
        key = f"distortion.methods.{number}.parametrizer"
        require_defined(key, method["parametrizer"], "parametrizers")
    return {method["parametrizer"]: method.get("paper") for method in methods}


def chosen_databases(section, suits, upright=False):
    """Return the databases that a section asks for; by default the real ones at hand that suit.

    Where there is none of them, the generated ones that suit stand in. By default shapes that
    stand upright and shapes that do not are never mixed.
    """
    asked = config[section]["databases"]
    if asked != "auto":
        for name in asked:
            require_defined(f"{section}.databases", name, "datasets")
        return asked
    root = Path(config["data_root"])
    plugins = {name: dataset_plugin(name) for name in config["datasets"]}
    fitting = [
        name
        for name, plugin in plugins.items()
        if (plugin.upright is not None) == upright and suits(name)
    ]
    generated = [name for name in fitting if plugins[name].tags.generated]
    real = [name for name in fitting if name not in generated and plugins[name].available(root)]
    return real or generated


def chosen_tables():
    """Return what the tables of scores hold: table -> columns by slug, databases and seeds."""
    tables = {}
    standing = {"table1": False, "table1_study": False, "table2": True, "table2_study": True}
    for name, upright in standing.items():
        databases = chosen_databases(name, protocols_of, upright)
        for database in databases:
            require_protocols(f"{name}.databases", database)
        columns, seeds = chosen_columns(name), config[name]["seeds"]
        tables[name] = {"columns": columns, "databases": databases, "seeds": seeds}
    return tables


def first_at_hand(key, choices):
    """Return the first of the choices, each with a database, whose database is at hand."""
    for number, choice in enumerate(choices):
        require_defined(f"{key}.{number}.database", choice["database"], "datasets")
        if is_at_hand(choice["database"]):
            return choice
    named = ", ".join(dict.fromkeys(choice["database"] for choice in choices))
    raise WorkflowError(
        f"configuration, {key}: none of the databases is at hand ({named}); put one under "
        "data_root, or add a generated one"
    )


def chosen_subjects():
    """Return the shapes of the figures that show one or two: figure -> database and shape."""
    chosen = config["figures"]
    subject = first_at_hand("figures.shapes", chosen["shapes"])
    whole, holed, upright = (
        first_at_hand(f"figures.{figure}.{part}", chosen[figure][part])
        for figure, part in (("figure1", "whole"), ("figure1", "holed"), ("figure6", "upright"))
    )
    alone = ("figure2", "figure3", "figure4", "figure5")
    return {
        "figure1": [whole, holed],
        **{figure: [subject] for figure in alone},
        "figure6": [subject, upright],
    }


def chosen_beyond():
    """Return what goes beyond the paper: database, columns, seeds, splits and faulty databases."""
    section, key = config["beyond"], "beyond.databases"
    chosen = first_at_hand(key, section["databases"])
    database = chosen["database"]
    require_protocols(key, database)
    protocols = protocols_of(database)
    protocol = chosen.get("protocol", list(protocols)[-1])
    if protocol not in protocols:
        raise WorkflowError(
            f"configuration, {key}: {database!r} has no protocol {protocol!r}"
            f"{did_you_mean(protocol, protocols)} ({', '.join(protocols)})"
        )
    seeds = section["seeds"][: config["datasets"][database].get("splits")]
    faults = section["robustness"]["faults"]
    for number, fault in enumerate(faults):
        name = fault["perturbation"]
        if name not in PERTURBATIONS:
            raise WorkflowError(
                f"configuration, beyond.robustness.faults.{number}.perturbation: there is no "
                f"{name!r}{did_you_mean(name, PERTURBATIONS)} ({', '.join(PERTURBATIONS)})"
            )
    return {
        "database": database,
        "databases": [database],
        "columns": chosen_columns("beyond"),
        "seeds": seeds,
        "few_shot": {
            f"Train{count}": replace(protocols[protocol], train_per_class=count)
            for count in section["few_shot"]
        },
        "protocol": protocol,
        "perturbed_seeds": seeds[: section["robustness"]["splits"]],
        "perturbed": {
            f"{database}~{fault['perturbation']}-{strength:g}": {
                "name": fault["perturbation"],
                "strength": strength,
            }
            for fault in faults
            for strength in fault["strengths"]
        },
    }


def is_at_hand(database):
    """Tell whether a database needs no download."""
    return dataset_plugin(database).available(Path(config["data_root"]))


def chosen_scenes():
    """Return the shapes of the page's view: those whose database is at hand."""
    for number, subject in enumerate(config["page"]["shapes"]):
        require_defined(f"page.shapes.{number}.database", subject["database"], "datasets")
    for kind in ("parametrizers", "descriptors"):
        for name in config["page"][kind]:
            require_defined(f"page.{kind}", name, kind)
    return [subject for subject in config["page"]["shapes"] if is_at_hand(subject["database"])]


def dataset_plugin(name):
    spec = instance("dataset", name)
    return registry.create("dataset", spec["plugin"], spec["parameters"])


def protocols_of(database):
    """Return the protocols of a database by name, as gipkg.api.Protocol."""
    own = config["datasets"][database].get("protocols")
    if own is None:
        return dataset_plugin(database).protocols
    return {
        name: Protocol(**chosen) if isinstance(chosen, dict) else Protocol(chosen)
        for name, chosen in own.items()
    }


def require_protocols(key, database):
    """Stop where a database has no protocol to split it by."""
    if not protocols_of(database):
        raise WorkflowError(
            f"configuration, {key}: {database!r} has no protocol to split it by; "
            f"datasets.{database}.protocols can name one"
        )


def is_mapped_only(database):
    """Tell whether a database is there for its surfaces: nothing is classified in it."""
    return not protocols_of(database)
