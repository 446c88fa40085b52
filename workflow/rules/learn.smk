rule learn:
    input:
        split="results/datasets/{database}/splits/{protocol}-{seed}.csv",
        images=column_shards,
        complete=ancient("results/failures/{database}/{column}.json"),
    output:
        prediction="results/learning/{database}/{column}/{protocol}-{seed}.npz",
        seconds="results/benchmarks/learning/{database}/{column}/{protocol}-{seed}.json",
    log:
        "results/logs/learning/{database}/{column}/{protocol}-{seed}.log",
    benchmark:
        "results/benchmarks/learning/{database}/{column}/{protocol}-{seed}.tsv"
    conda:
        "../../environment.yml"
    params:
        network=lookup("{column}", within=NETWORKS),
        code=fingerprint_module("gipkg.learning"),
    script:
        "../scripts/learn.py"
