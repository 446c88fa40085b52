import gipkg
from gipkg.shards import content_key

# Of the package and not of the checkout: the workflow may be somewhere without it.
ASSETS = Path(gipkg.__file__).parent / "reporting" / "page" / "assets"


rule scenes:
    input:
        [surface_shard(subject) for subject in ON_PAGE],
    output:
        "results/page/scenes.json",
    log:
        "results/logs/page/scenes.log",
    benchmark:
        "results/benchmarks/page/scenes.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(2000),
    params:
        shapes=[subject["shape"] for subject in ON_PAGE],
        databases=[subject["database"] for subject in ON_PAGE],
        eigenpairs=config["eigenpairs"],
        plugins={
            "dataset": picked(DATASETS, [subject["database"] for subject in ON_PAGE]),
            "parametrizer": picked(PARAMETRIZERS, config["page"]["parametrizers"]),
            "descriptor": picked(DESCRIPTORS, config["page"]["descriptors"]),
        },
        code=fingerprint_module("gipkg.reporting.page.scene"),
    script:
        "../scripts/scenes.py"


rule page:
    input:
        rules.paper.input,
        scenes="results/page/scenes.json",
        paper=Path(workflow.basedir) / "results" / "reference" / "paper.yaml",
    output:
        report("results/index.html", "../report/page.rst", category="Page"),
    log:
        "results/logs/page/page.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=memory(1000),
    params:
        code=fingerprint_module("gipkg.reporting.page.html"),
        # Fingerprints follow Python alone; the page is its template, styles and scripts, too.
        assets=content_key(None, sorted(filter(Path.is_file, ASSETS.iterdir()))),
    script:
        "../scripts/page.py"
