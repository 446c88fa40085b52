rule spectra:
    input:
        "results/surfaces/{database}/{shard}.npz",
    output:
        "results/spectra/{database}/{shard}.npz",
    log:
        "results/logs/spectra/{database}/{shard}.log",
    benchmark:
        "results/benchmarks/spectra/{database}/{shard}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        eigenpairs=config["eigenpairs"],
        code=fingerprint_module("gipkg.descriptors.operators"),
    script:
        "../scripts/spectra.py"


rule describe:
    input:
        surfaces="results/surfaces/{database}/{shard}.npz",
        spectra="results/spectra/{database}/{shard}.npz",
    output:
        "results/descriptors/{database}/{descriptor}/{shard}.npz",
    log:
        "results/logs/descriptors/{database}/{descriptor}/{shard}.log",
    benchmark:
        "results/benchmarks/descriptors/{database}/{descriptor}/{shard}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        descriptor=lookup("{descriptor}", within=DESCRIPTORS),
    script:
        "../scripts/describe.py"
