"""Set the page: the paper's tables and figures beside ours, and shapes to turn."""

from pathlib import Path

from gipkg.files import write_text
from gipkg.reporting.page.clocks import read_clocks
from gipkg.reporting.page.entries import gather
from gipkg.reporting.page.html import render
from gipkg.reporting.page.reference import read_paper
from gipkg.reporting.provenance import environment

import job
from documents import read_sealed

job.start(snakemake)
page, description = Path(snakemake.output[0]), Path(snakemake.input.paper)
results = page.parent
paper = read_paper(description)
entries = [gather(item, paper, results, description.parent) for item in paper.items]
scenes = read_sealed(snakemake.input.scenes)
write_text(page, render(entries, read_clocks(results / "benchmarks"), scenes, environment()))
