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
        # Not the package: what only gives a mesh back, or pads, changes no image.
        code=[fingerprint_module(name) for name in ("gipkg.images.config", "gipkg.images.lookup")],
    script:
        "../scripts/images.py"
