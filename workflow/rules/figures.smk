rule figure1:
    input:
        figure_surfaces("figure1"),
    output:
        png=report(
            "results/figure1.png",
            "../report/figure1.rst",
            category="Figures",
            labels={"figure": "1"},
        ),
        csv="results/figure1.csv",
        shapes="results/figure1_shapes.csv",
        provenance="results/figure1.json",
    log:
        "results/logs/figure1.log",
    benchmark:
        "results/benchmarks/figure1.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure1"),
    script:
        "../scripts/figure1.py"


rule figure2:
    input:
        figure_surfaces("figure2"),
    output:
        png=report(
            "results/figure2.png",
            "../report/figure2.rst",
            category="Figures",
            labels={"figure": "2"},
        ),
        csv="results/figure2.csv",
        provenance="results/figure2.json",
    log:
        "results/logs/figure2.log",
    benchmark:
        "results/benchmarks/figure2.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure2"),
    script:
        "../scripts/figure2.py"


rule figure3:
    input:
        figure_surfaces("figure3"),
    output:
        png=report(
            "results/figure3.png",
            "../report/figure3.rst",
            category="Figures",
            labels={"figure": "3"},
        ),
        csv="results/figure3.csv",
        provenance="results/figure3.json",
    log:
        "results/logs/figure3.log",
    benchmark:
        "results/benchmarks/figure3.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure3"),
    script:
        "../scripts/figure3.py"


rule figure4:
    input:
        figure_surfaces("figure4"),
    output:
        png=report(
            "results/figure4.png",
            "../report/figure4.rst",
            category="Figures",
            labels={"figure": "4"},
        ),
        csv="results/figure4.csv",
        provenance="results/figure4.json",
    log:
        "results/logs/figure4.log",
    benchmark:
        "results/benchmarks/figure4.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure4"),
    script:
        "../scripts/figure4.py"


rule figure5:
    input:
        figure_surfaces("figure5"),
    output:
        png=report(
            "results/figure5.png",
            "../report/figure5.rst",
            category="Figures",
            labels={"figure": "5"},
        ),
        csv="results/figure5.csv",
        provenance="results/figure5.json",
    log:
        "results/logs/figure5.log",
    benchmark:
        "results/benchmarks/figure5.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure5"),
    script:
        "../scripts/figure5.py"


rule figure6:
    input:
        figure_surfaces("figure6"),
    output:
        png=report(
            "results/figure6.png",
            "../report/figure6.rst",
            category="Figures",
            labels={"figure": "6"},
        ),
        csv="results/figure6.csv",
        provenance="results/figure6.json",
    log:
        "results/logs/figure6.log",
    benchmark:
        "results/benchmarks/figure6.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        **figure_params("figure6"),
    script:
        "../scripts/figure6.py"


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
        png=report(
            "results/figure7.png",
            "../report/figure7.rst",
            category="Figures",
            labels={"figure": "7"},
        ),
        csv="results/figure7.csv",
        shapes="results/figure7_shapes.csv",
        provenance="results/figure7.json",
    log:
        "results/logs/figure7.log",
    benchmark:
        "results/benchmarks/figure7.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        config=config["distortion"],
        sampling=IMAGES["standard"]["sampling"],
        methods=list(METHODS),
        databases=MAPPED,
        plugins={
            "dataset": picked(DATASETS, MAPPED),
            "parametrizer": picked(PARAMETRIZERS, METHODS),
        },
        code=[
            fingerprint_module(name)
            for name in (
                "gipkg.reporting.figures.figure7",
                "gipkg.reporting.table_distortion",
                "gipkg.datasets.selection",
            )
        ],
    script:
        "../scripts/figure7.py"


rule precision_recall:
    input:
        drawn(evaluations),
    output:
        png=report(
            "results/{figure}.png",
            "../report/precision_recall.rst",
            category="Figures",
            labels={"figure": "{figure}"},
        ),
        csv="results/{figure}.csv",
        provenance="results/{figure}.json",
    log:
        "results/logs/{figure}.log",
    wildcard_constraints:
        figure=alternatives(CURVES),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        config=lambda wildcards: config[CURVES[wildcards.figure]],
        rows=drawn(table_rows),
        plugins=drawn(table_plugins),
        code=[
            fingerprint_module(name)
            for name in (
                "gipkg.reporting.figures.precision_recall",
                "gipkg.reporting.score_table",
                "gipkg.reporting.records",
            )
        ],
    script:
        "../scripts/precision_recall.py"
