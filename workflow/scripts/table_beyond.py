"""Set and draw what goes beyond the paper: few training shapes, and faulty test shapes."""

from pathlib import Path

from gipkg.api import Protocol
from gipkg.files import write_csv, write_text
from gipkg.reporting import notes
from gipkg.reporting import table_beyond as table
from gipkg.reporting.figures import beyond as figure
from gipkg.reporting.figures.layout import write_png
from gipkg.reporting.records import as_table
from gipkg.reporting.score_table import Cell, own_columns
from gipkg.reporting.survey import Survey
from gipkg.surfaces.perturbations import PERTURBATIONS

import job
from documents import read_listing, read_sealed, write_provenance

job.start(snakemake)
params, database = snakemake.params, snakemake.params.database
columns = params.config["columns"]
headings = [column["column"] for column in columns]
plugins = job.plugins(params.plugins)
seeds = {"few-shot": params.seeds, "robustness": params.perturbed_seeds}

evaluations = map(read_sealed, snakemake.input.evaluations)
rows = []
for setting, _, _, amount in params.settings:
    part = "few-shot" if setting == "few-shot" else "robustness"
    scores = [[one for one in next(evaluations) if one["seed"] in seeds[part]] for _ in headings]
    cells = dict(zip(headings, map(Cell.of, scores), strict=True))
    said = {"few-shot": table.FEW_SHOT, "clean": table.CLEAN}.get(setting, setting)
    rows.append(table.Row(part, said, amount, len(seeds[part]), cells))

protocols = {split: Protocol(**protocol) for split, protocol in params.protocols.items()}
splits = list(protocols)
survey = Survey(**read_sealed(snakemake.input.survey))
listing = read_listing(snakemake.input.listing)
text = [notes.database_note(database, splits, plugins["dataset", database], survey)]
text += notes.selection_notes(database, protocols, listing)
text += [notes.column_note(column, plugins) for column in columns]
text += [
    f"**{fault['perturbation']}**: {PERTURBATIONS[fault['perturbation']].summary}."
    for fault in params.config["robustness"]["faults"]
]
text.append(
    "A faulty surface is prepared again like any other of its database. What cannot be prepared "
    "or mapped counts as misclassified. Networks and baselines learn from surfaces as they are "
    f"({notes.literal(splits[-1])})."
)
text.append(notes.seeds_note(seeds))

write_csv(Path(snakemake.output.csv), *table.as_csv(rows))
write_text(Path(snakemake.output.markdown), table.as_markdown(rows, text))
write_png(Path(snakemake.output.figure), figure.draw(rows, own_columns(columns)))
write_csv(Path(snakemake.output.figure_csv), *as_table(figure.points(rows)))
about = {database: {"sha256": dict(plugins["dataset", database].tags.files)}}
for path in (snakemake.output.provenance, snakemake.output.figure_provenance):
    write_provenance(path, params, networks=params.networks, seeds=seeds, databases=about)
