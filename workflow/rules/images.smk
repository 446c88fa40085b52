rule images:
    input:
        surfaces="results/surfaces/{database}/{shard}.npz",
        maps="results/parametrizers/{database}/{parametrizer}/{shard}.npz",
        descriptors=channels,
    output:
        "results/images/{database}/{parametrizer}/{descriptors}/{images}/{shard}.npz",
    log:
        "results/logs/images/{database}/{parametrizer}/{descriptors}/{images}/{shard}.log",
    benchmark:
        "results/benchmarks/images/{database}/{parametrizer}/{descriptors}/{images}/{shard}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        images=lookup("{images}", within=IMAGES),
        code=fingerprint_module("gipkg.images"),
    script:
        "../scripts/images.py"
