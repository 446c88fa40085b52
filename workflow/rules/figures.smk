rule figure2:
    input:
        SUBJECT_SURFACES,
    output:
        png="results/figure2.png",
        csv="results/figure2.csv",
        provenance="results/figure2.json",
    log:
        "results/logs/figure2.log",
    conda:
        "../../environment.yml"
    params:
        **figure_params("figure2"),
        shape=SUBJECT["shape"],
        size=config["figures"]["size"],
    script:
        "../scripts/figure2.py"


rule figure3:
    input:
        SUBJECT_SURFACES,
    output:
        png="results/figure3.png",
        csv="results/figure3.csv",
        provenance="results/figure3.json",
    log:
        "results/logs/figure3.log",
    conda:
        "../../environment.yml"
    params:
        **figure_params("figure3"),
        shape=SUBJECT["shape"],
        size=config["figures"]["size"],
    script:
        "../scripts/figure3.py"


rule figure4:
    input:
        SUBJECT_SURFACES,
    output:
        png="results/figure4.png",
        csv="results/figure4.csv",
        provenance="results/figure4.json",
    log:
        "results/logs/figure4.log",
    conda:
        "../../environment.yml"
    params:
        **figure_params("figure4"),
        shape=SUBJECT["shape"],
        size=config["figures"]["size"],
    script:
        "../scripts/figure4.py"


rule figure7:
    input:
        shapes=f"results/datasets/{MAPPED[0]}/shapes.csv",
        surfaces=expand(
            "results/surfaces/{database}/{shard}.npz",
            database=MAPPED[0],
            shard=range(config["datasets"][MAPPED[0]]["shards"]),
        ),
        maps=expand(
            "results/parametrizers/{database}/{parametrizer}/{shard}.npz",
            database=MAPPED[0],
            parametrizer=METHODS,
            shard=range(config["datasets"][MAPPED[0]]["shards"]),
        ),
        figures=expand(
            "results/distortion/{database}/{parametrizer}.csv",
            database=MAPPED,
            parametrizer=METHODS,
        ),
        histograms=expand(
            "results/distortion/{database}/{parametrizer}.histogram.csv",
            database=MAPPED,
            parametrizer=METHODS,
        ),
    output:
        png="results/figure7.png",
        csv="results/figure7.csv",
        shapes="results/figure7_shapes.csv",
        provenance="results/figure7.json",
    log:
        "results/logs/figure7.log",
    conda:
        "../../environment.yml"
    params:
        config=config["distortion"],
        sampling=config["images"]["sampling"],
        methods=list(METHODS),
        databases=MAPPED,
        plugins={
            "dataset": picked(DATASETS, MAPPED),
            "parametrizer": picked(PARAMETRIZERS, METHODS),
        },
        code=fingerprint_module("gipkg.reporting.figures.figure7"),
    script:
        "../scripts/figure7.py"
