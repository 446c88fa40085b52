rule represent:
    input:
        surfaces="results/surfaces/{database}/{shard}.npz",
        spectra="results/spectra/{database}/{shard}.npz",
    output:
        "results/baselines/{database}/{baseline}/{shard}.npz",
    params:
        baseline=lookup("{baseline}", within=BASELINES),
    log:
        "results/logs/baselines/{database}/{baseline}/{shard}.log",
    benchmark:
        "results/benchmarks/baselines/{database}/{baseline}/{shard}.tsv"
    conda:
        "../../environment.yml"
    script:
        "../scripts/represent.py"


rule classify:
    input:
        split="results/datasets/{database}/splits/{protocol}-{seed}.csv",
        representations=shards_of("results/baselines/{database}/{baseline}/{shard}.npz"),
    output:
        "results/baselines/{database}/{baseline}/{protocol}-{seed}.npz",
    params:
        code=fingerprint_module("gipkg.baselines.svm"),
    log:
        "results/logs/baselines/{database}/{baseline}/{protocol}-{seed}.log",
    benchmark:
        "results/benchmarks/baselines/{database}/{baseline}/{protocol}-{seed}.tsv"
    conda:
        "../../environment.yml"
    script:
        "../scripts/classify.py"
