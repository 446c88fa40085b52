rule table1:
    input:
        evaluations=[
            f"results/evaluation/{database}/{column}/{protocol}.json"
            for database in DATABASES
            for protocol in PROTOCOLS[database]
            for column in COLUMNS
        ],
        failures=expand(
            "results/failures/{database}/{column}.json", database=DATABASES, column=COLUMNS
        ),
        surveys=expand("results/surfaces/{database}.json", database=DATABASES),
        reference=Path(workflow.basedir) / "results" / "reference" / "table1.csv",
    output:
        csv="results/table1.csv",
        markdown="results/table1.md",
        provenance="results/table1.json",
    log:
        "results/logs/table1.log",
    conda:
        "../../environment.yml"
    params:
        config={key: part for key, part in config.items() if key not in OTHER_RESULTS},
        rows=[(database, protocol) for database in DATABASES for protocol in PROTOCOLS[database]],
        plugins={
            "dataset": picked(DATASETS, DATABASES),
            "parametrizer": picked(
                PARAMETRIZERS, (COLUMNS[name]["parametrizer"] for name in LEARNED)
            ),
            "descriptor": DESCRIPTORS,
            "baseline": BASELINES,
        },
        networks=NETWORKS,
        code=fingerprint_module("gipkg.reporting"),
    script:
        "../scripts/table1.py"


rule table_distortion:
    input:
        shapes=expand(
            "results/distortion/{database}/{parametrizer}.csv",
            database=MAPPED,
            parametrizer=METHODS,
        ),
        surveys=expand("results/surfaces/{database}.json", database=MAPPED),
        reference=Path(workflow.basedir) / "results" / "reference" / "table_distortion.csv",
    output:
        csv="results/table_distortion.csv",
        markdown="results/table_distortion.md",
        provenance="results/table_distortion.json",
    log:
        "results/logs/table_distortion.log",
    conda:
        "../../environment.yml"
    params:
        config=config["distortion"],
        methods=METHODS,
        databases=MAPPED,
        plugins={
            "dataset": picked(DATASETS, MAPPED),
            "parametrizer": picked(PARAMETRIZERS, METHODS),
        },
        code=fingerprint_module("gipkg.reporting.table_distortion"),
    script:
        "../scripts/table_distortion.py"


rule table_reconstruction:
    input:
        expand(
            "results/reconstruction/{database}/{parametrizer}.csv",
            database=MAPPED,
            parametrizer=config["reconstruction"]["parametrizers"],
        ),
    output:
        csv="results/table_reconstruction.csv",
        markdown="results/table_reconstruction.md",
        provenance="results/table_reconstruction.json",
    log:
        "results/logs/table_reconstruction.log",
    conda:
        "../../environment.yml"
    params:
        config=config["reconstruction"],
        databases=MAPPED,
        plugins={
            "dataset": picked(DATASETS, MAPPED),
            "parametrizer": picked(PARAMETRIZERS, config["reconstruction"]["parametrizers"]),
        },
        code=fingerprint_module("gipkg.reporting.table_reconstruction"),
    script:
        "../scripts/table_reconstruction.py"
