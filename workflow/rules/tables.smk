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
        config=config,
        rows=[(database, protocol) for database in DATABASES for protocol in PROTOCOLS[database]],
        plugins={
            "dataset": DATASETS,
            "parametrizer": PARAMETRIZERS,
            "descriptor": DESCRIPTORS,
            "baseline": BASELINES,
        },
        networks=NETWORKS,
        code=fingerprint_module("gipkg.reporting"),
    script:
        "../scripts/table1.py"
