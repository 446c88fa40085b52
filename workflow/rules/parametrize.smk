rule parametrize:
    input:
        "results/surfaces/{database}/{shard}.npz",
    output:
        "results/parametrizers/{database}/{parametrizer}/{shard}.npz",
    log:
        "results/logs/parametrizers/{database}/{parametrizer}/{shard}.log",
    benchmark:
        "results/benchmarks/parametrizers/{database}/{parametrizer}/{shard}.tsv"
    conda:
        "../../environment.yml"
    params:
        parametrizer=lookup("{parametrizer}", within=PARAMETRIZERS),
    script:
        "../scripts/parametrize.py"
