rule shapes:
    output:
        "results/datasets/{database}/shapes.csv",
    log:
        "results/logs/datasets/{database}.log",
    wildcard_constraints:
        database=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
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
    wildcard_constraints:
        database=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(500),
    params:
        protocol=protocol,
        code=fingerprint_module("gipkg.datasets.splits"),
    script:
        "../scripts/split.py"
