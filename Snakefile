from pathlib import Path


configfile: Path(workflow.basedir) / "config" / "config.yaml"


report: "workflow/report/workflow.rst"


onstart:
    # For its limit on submissions Snakemake looks for work again a second after each look, so that
    # every finished job adds one look a second, to the end: hundreds of them take a core away
    # from the jobs. A cluster needs the limit, this machine does not.
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None


include: "workflow/rules/configuration.smk"
include: "workflow/rules/choices.smk"
include: "workflow/rules/common.smk"
include: "workflow/rules/parameters.smk"
include: "workflow/rules/inputs.smk"
include: "workflow/rules/resources.smk"
include: "workflow/rules/datasets.smk"
include: "workflow/rules/surfaces.smk"
include: "workflow/rules/parametrize.smk"
include: "workflow/rules/describe.smk"
include: "workflow/rules/images.smk"
include: "workflow/rules/learn.smk"
include: "workflow/rules/baselines.smk"
include: "workflow/rules/evaluate.smk"
include: "workflow/rules/beyond.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"


rule paper:
    input:
        expand("results/{table}.csv", table=CURVES.values()),
        expand("results/{figure}.png", figure=CURVES),
        "results/table1_beyond.csv",
        "results/table_distortion.csv",
        "results/table_reconstruction.csv",
        expand("results/figure{number}.png", number=range(1, 8)),


include: "workflow/rules/page.smk"


rule all:
    default_target: True
    input:
        rules.paper.input,
        "results/index.html",
