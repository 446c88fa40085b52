rule complete:
    input:
        shards_of("results/{stage}/{database}/{method}/{shard}.npz"),
    output:
        "results/failures/{stage}/{database}/{method}.json",
    log:
        "results/logs/failures/{stage}/{database}/{method}.log",
    wildcard_constraints:
        stage="images|baselines",
        method="[a-z0-9+/-]+",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(500),
    params:
        max_failures=config["max_failures"],
    script:
        "../scripts/complete.py"


rule evaluate:
    input:
        predictions=predictions,
        splits=splits,
    output:
        "results/evaluation/{table}/{database}/{column}/{protocol}.json",
    log:
        "results/logs/evaluation/{table}/{database}/{column}/{protocol}.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        seeds=seeds,
        code=fingerprint_module("gipkg.evaluation.scores"),
    script:
        "../scripts/evaluate.py"


rule distort:
    input:
        surfaces=shards_of("results/surfaces/{database}/{shard}.npz"),
        maps=shards_of("results/parametrizers/{database}/{parametrizer}/{shard}.npz"),
        seconds=shards_of("results/benchmarks/parametrizers/{database}/{parametrizer}/{shard}.csv"),
    output:
        shapes="results/distortion/{database}/{parametrizer}.csv",
        histogram="results/distortion/{database}/{parametrizer}.histogram.csv",
    log:
        "results/logs/distortion/{database}/{parametrizer}.log",
    benchmark:
        "results/benchmarks/distortion/{database}/{parametrizer}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        code=[
            fingerprint_module(name)
            for name in ("gipkg.evaluation.histogram", "gipkg.reporting.shapes")
        ],
    script:
        "../scripts/distort.py"


rule reconstruct:
    input:
        shapes="results/datasets/{database}/shapes.csv",
        surfaces=shards_of("results/surfaces/{database}/{shard}.npz"),
        maps=shards_of("results/parametrizers/{database}/{parametrizer}/{shard}.npz"),
    output:
        "results/reconstruction/{database}/{parametrizer}.csv",
    log:
        "results/logs/reconstruction/{database}/{parametrizer}.log",
    benchmark:
        "results/benchmarks/reconstruction/{database}/{parametrizer}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        shapes=config["reconstruction"]["shapes"],
        sizes=config["reconstruction"]["sizes"],
        sampling=IMAGES["standard"]["sampling"],
        code=[
            fingerprint_module(name)
            for name in (
                "gipkg.evaluation.surface_distance",
                "gipkg.images",
                "gipkg.datasets.selection",
            )
        ],
    script:
        "../scripts/reconstruct.py"
