rule surfaces:
    input:
        "results/datasets/{database}/shapes.csv",
    output:
        surfaces="results/surfaces/{database}/{shard}.npz",
        seconds="results/benchmarks/surfaces/{database}/{shard}.csv",
    log:
        "results/logs/surfaces/{database}/{shard}.log",
    benchmark:
        "results/benchmarks/surfaces/{database}/{shard}.tsv"
    wildcard_constraints:
        database=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        dataset=lookup("{database}", within=DATASETS),
        options=surface_options,
        code=[
            fingerprint_module(name)
            for name in ("gipkg.surfaces.preparation", "gipkg.surfaces.upright")
        ],
    script:
        "../scripts/surfaces.py"


rule survey:
    input:
        shards_of("results/surfaces/{database}/{shard}.npz"),
    output:
        "results/surfaces/{database}.json",
    log:
        "results/logs/surfaces/{database}.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        code=fingerprint_module("gipkg.reporting.survey"),
    script:
        "../scripts/survey.py"
