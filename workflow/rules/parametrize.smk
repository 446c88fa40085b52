rule parametrize:
    input:
        "results/surfaces/{database}/{shard}.npz",
    output:
        maps="results/parametrizers/{database}/{parametrizer}/{shard}.npz",
        seconds="results/benchmarks/parametrizers/{database}/{parametrizer}/{shard}.csv",
    log:
        "results/logs/parametrizers/{database}/{parametrizer}/{shard}.log",
    benchmark:
        "results/benchmarks/parametrizers/{database}/{parametrizer}/{shard}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
        runtime=720,
    params:
        parametrizer=lookup("{parametrizer}", within=PARAMETRIZERS),
    script:
        "../scripts/parametrize.py"
