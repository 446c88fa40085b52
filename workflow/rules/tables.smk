rule score_table:
    input:
        evaluations=evaluations,
        failures=table_failures,
        surveys=table_surveys,
        listings=table_listings,
        timings=timings,
        reference=table_reference,
    output:
        csv=report("results/{table}.csv", "../report/table.rst", category="Tables"),
        seconds="results/{table}_seconds.csv",
        markdown="results/{table}.md",
        provenance="results/{table}.json",
    log:
        "results/logs/{table}.log",
    wildcard_constraints:
        table=alternatives(TABLES),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        config=table_config,
        protocols=table_protocols,
        seeds=table_seeds,
        plugins=table_plugins,
        networks=table_networks,
        code=[
            fingerprint_module(name)
            for name in (
                "gipkg.reporting.score_table",
                "gipkg.reporting.notes",
                "gipkg.reporting.trainings",
                "gipkg.reporting.records",
            )
        ],
    script:
        "../scripts/score_table.py"


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
        csv=report(
            "results/table_distortion.csv", "../report/table_distortion.rst", category="Tables"
        ),
        markdown="results/table_distortion.md",
        provenance="results/table_distortion.json",
    log:
        "results/logs/table_distortion.log",
    benchmark:
        "results/benchmarks/table_distortion.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
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
        csv=report(
            "results/table_reconstruction.csv",
            "../report/table_reconstruction.rst",
            category="Tables",
        ),
        markdown="results/table_reconstruction.md",
        provenance="results/table_reconstruction.json",
    log:
        "results/logs/table_reconstruction.log",
    benchmark:
        "results/benchmarks/table_reconstruction.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
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
