rule complete:
    input:
        column_shards,
    output:
        "results/failures/{database}/{column}.json",
    log:
        "results/logs/failures/{database}/{column}.log",
    conda:
        "../../environment.yml"
    params:
        max_failures=config["max_failures"],
    script:
        "../scripts/complete.py"


rule evaluate:
    input:
        predictions=predictions,
        splits=expand(
            "results/datasets/{database}/splits/{protocol}-{seed}.csv",
            seed=config["seeds"],
            allow_missing=True,
        ),
    output:
        "results/evaluation/{database}/{column}/{protocol}.json",
    log:
        "results/logs/evaluation/{database}/{column}/{protocol}.log",
    conda:
        "../../environment.yml"
    params:
        seeds=config["seeds"],
        code=fingerprint_module("gipkg.evaluation"),
    script:
        "../scripts/evaluate.py"
