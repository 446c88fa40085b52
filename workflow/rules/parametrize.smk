rule parametrize:
    input:
        "results/surfaces/{database}/{shard}.npz",
    output:
        "results/parametrizers/{database}/{parametrizer}/{shard}.npz",
    params:
        parametrizer=lookup("{parametrizer}", within=PARAMETRIZERS),
    log:
        "results/logs/parametrizers/{database}/{parametrizer}/{shard}.log",
    benchmark:
        "results/benchmarks/parametrizers/{database}/{parametrizer}/{shard}.tsv"
    conda:
        "../../environment.yml"
    script:
        "../scripts/parametrize.py"
