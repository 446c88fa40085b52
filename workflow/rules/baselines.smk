rule represent:
    input:
        surfaces="results/surfaces/{database}/{shard}.npz",
        spectra="results/spectra/{database}/{shard}.npz",
    output:
        "results/baselines/{database}/{baseline}/{shard}.npz",
    log:
        "results/logs/baselines/{database}/{baseline}/{shard}.log",
    benchmark:
        "results/benchmarks/baselines/{database}/{baseline}/{shard}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        baseline=lookup("{baseline}", within=BASELINES),
    script:
        "../scripts/represent.py"


rule classify:
    input:
        split="results/datasets/{database}/splits/{protocol}-{seed}.csv",
        representations=shards_of("results/baselines/{database}/{baseline}/{shard}.npz"),
    output:
        prediction="results/baselines/{database}/{baseline}/{protocol}-{seed}.npz",
        seconds="results/benchmarks/baselines/{database}/{baseline}/{protocol}-{seed}.json",
    log:
        "results/logs/baselines/{database}/{baseline}/{protocol}-{seed}.log",
    benchmark:
        "results/benchmarks/baselines/{database}/{baseline}/{protocol}-{seed}.tsv"
    wildcard_constraints:
        database=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory_of_input(1000, times=2),
        runtime=240,
    params:
        baseline=lookup("{baseline}", within=BASELINES),
    script:
        "../scripts/classify.py"
