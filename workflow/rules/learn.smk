rule learn:
    input:
        split="results/datasets/{database}/splits/{protocol}-{seed}.csv",
        images=shards_of(
            "results/images/{database}/{parametrizer}/{descriptors}/{images}/{shard}.npz"
        ),
        complete=ancient(
            "results/failures/images/{database}/{parametrizer}/{descriptors}/{images}.json"
        ),
    output:
        prediction="results/learning/{database}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.npz",
        model="results/learning/{database}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.model.npz",
        seconds="results/benchmarks/learning/{database}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.json",
    log:
        "results/logs/learning/{database}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.log",
    benchmark:
        "results/benchmarks/learning/{database}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.tsv"
    wildcard_constraints:
        database=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory_of_input(1000, times=1.5),
        runtime=240,
    params:
        network=lookup("{network}", within=NETWORKS),
        recipe=recipe,
        code=fingerprint_module("gipkg.learning"),
    script:
        "../scripts/learn.py"
