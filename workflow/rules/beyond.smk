rule perturb:
    input:
        surfaces=shards_of("results/surfaces/{source}/{shard}.npz"),
        splits=expand(
            "results/datasets/{{source}}/splits/{protocol}-{seed}.csv",
            protocol=BEYOND["protocol"],
            seed=BEYOND["perturbed_seeds"],
        ),
    output:
        "results/surfaces/{source}~{perturbation}/0.npz",
    log:
        "results/logs/surfaces/{source}~{perturbation}/0.log",
    benchmark:
        "results/benchmarks/surfaces/{source}~{perturbation}/0.tsv"
    wildcard_constraints:
        source=alternatives(DATASETS),
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        perturbation=lookup("{source}~{perturbation}", within=BEYOND["perturbed"]),
        seed=config["beyond"]["robustness"]["seed"],
        options=surface_options,
        code=fingerprint_module("gipkg.surfaces.perturbations"),
    script:
        "../scripts/perturb.py"


rule predict_perturbed:
    input:
        split="results/datasets/{source}/splits/{protocol}-{seed}.csv",
        model="results/learning/{source}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.model.npz",
        images="results/images/{source}~{perturbation}/{parametrizer}/{descriptors}/{images}/0.npz",
    output:
        "results/learning/{source}~{perturbation}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.npz",
    log:
        "results/logs/learning/{source}~{perturbation}/{parametrizer}/{descriptors}/{images}/{network}/{protocol}-{seed}.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory_of_input(1000, times=1.5),
    params:
        code=fingerprint_module("gipkg.learning"),
    script:
        "../scripts/predict_perturbed.py"


rule classify_perturbed:
    input:
        split="results/datasets/{source}/splits/{protocol}-{seed}.csv",
        clean=shards_of("results/baselines/{source}/{baseline}/{shard}.npz"),
        perturbed="results/baselines/{source}~{perturbation}/{baseline}/0.npz",
    output:
        "results/baselines/{source}~{perturbation}/{baseline}/{protocol}-{seed}.npz",
    log:
        "results/logs/baselines/{source}~{perturbation}/{baseline}/{protocol}-{seed}.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory_of_input(1000, times=2),
    params:
        baseline=lookup("{baseline}", within=BASELINES),
    script:
        "../scripts/classify_perturbed.py"


rule table_beyond:
    input:
        evaluations=beyond_evaluations,
        survey=f"results/surfaces/{BEYOND['database']}.json",
        listing=f"results/datasets/{BEYOND['database']}/shapes.csv",
    output:
        csv=report("results/table1_beyond.csv", "../report/table_beyond.rst", category="Tables"),
        markdown="results/table1_beyond.md",
        provenance="results/table1_beyond.json",
        figure=report(
            "results/figure_beyond.png",
            "../report/figure_beyond.rst",
            category="Figures",
            labels={"figure": "beyond"},
        ),
        figure_csv="results/figure_beyond.csv",
        figure_provenance="results/figure_beyond.json",
    log:
        "results/logs/table1_beyond.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        config=config["beyond"],
        database=BEYOND["database"],
        seeds=BEYOND["seeds"],
        perturbed_seeds=BEYOND["perturbed_seeds"],
        settings=beyond_settings(),
        protocols={name: asdict(one) for name, one in beyond_protocols().items()},
        plugins=plugins_of(BEYOND),
        networks=networks_of(BEYOND),
        code=[
            fingerprint_module(name)
            for name in (
                "gipkg.reporting.table_beyond",
                "gipkg.reporting.figures.beyond",
                "gipkg.reporting.notes",
                "gipkg.reporting.records",
            )
        ],
    script:
        "../scripts/table_beyond.py"
