def channels(wildcards):
    return expand(
        "results/descriptors/{database}/{descriptor}/{shard}.npz",
        descriptor=wildcards.descriptors.split("+"),
        allow_missing=True,
    )


rule images:
    input:
        surfaces="results/surfaces/{database}/{shard}.npz",
        maps="results/parametrizers/{database}/{parametrizer}/{shard}.npz",
        descriptors=channels,
    output:
        "results/images/{database}/{parametrizer}/{descriptors}/{shard}.npz",
    params:
        images=config["images"],
        code=fingerprint_module("gipkg.images"),
    log:
        "results/logs/images/{database}/{parametrizer}/{descriptors}/{shard}.log",
    benchmark:
        "results/benchmarks/images/{database}/{parametrizer}/{descriptors}/{shard}.tsv"
    wildcard_constraints:
        descriptors="[a-z0-9+-]+",
    conda:
        "../../environment.yml"
    script:
        "../scripts/images.py"
