rule shapes:
    output:
        "results/datasets/{database}/shapes.csv",
    log:
        "results/logs/datasets/{database}.log",
    conda:
        "../../environment.yml"
    params:
        dataset=lookup("{database}", within=DATASETS),
        shards=lookup("{database}/shards", within=config["datasets"]),
    script:
        "../scripts/shapes.py"


rule split:
    input:
        "results/datasets/{database}/shapes.csv",
    output:
        "results/datasets/{database}/splits/{protocol}-{seed}.csv",
    log:
        "results/logs/splits/{database}/{protocol}-{seed}.log",
    conda:
        "../../environment.yml"
    params:
        train_per_class=lookup("{database}/{protocol}", within=PROTOCOLS),
        code=fingerprint_module("gipkg.datasets.splits"),
    script:
        "../scripts/split.py"
