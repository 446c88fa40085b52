"""Set a table from its scores: for programs, for readers, and where it comes from."""

import json
from pathlib import Path
from typing import Any

from gipkg.api import Shape
from gipkg.files import read_csv, write_csv, write_json, write_text
from gipkg.reporting import notes, score_table
from gipkg.reporting.provenance import environment
from gipkg.reporting.records import as_table
from gipkg.reporting.survey import Survey
from gipkg.reporting.trainings import Training

import job

job.start(snakemake)
config, rows = snakemake.params.config, [tuple(row) for row in snakemake.params.rows]
seeds = snakemake.params.seeds
name = snakemake.wildcards.table
columns = config[name]["columns"]
headings = [column["column"] for column in columns]
databases = list(dict.fromkeys(database for database, _ in rows))
plugins = job.plugins(snakemake.params.plugins)


def read(path: str) -> Any:
    """Read what an earlier stage found out."""
    return json.loads(Path(path).read_text(encoding="utf-8"))


evaluations = map(read, snakemake.input.evaluations)
table = [
    score_table.Row(*row, {one: score_table.Cell.of(next(evaluations)) for one in headings})
    for row in rows
]
surveys = dict(zip(databases, map(read, snakemake.input.surveys), strict=True))
lost = map(read, snakemake.input.failures)
failures = {database: {heading: next(lost) for heading in headings} for database in databases}

text = [
    notes.database_note(
        database,
        [split for one, split in rows if one == database],
        plugins["dataset", database],
        Survey(**surveys[database]),
    )
    for database in databases
]
listings = zip(databases, snakemake.input.listings, strict=True)
text += [
    notes.selection_note(database, [Shape(row["id"], row["label"]) for row in read_csv(Path(path))])
    for database, path in listings
    if plugins["dataset", database].tags.selected
]
text += [notes.column_note(column, plugins) for column in columns]
text += [
    notes.failure_note(heading, database, failures[database][heading])
    for database in databases
    for heading in headings
    if failures[database][heading]
]
text.append(notes.seeds_note(seeds))
text += [notes.ahead_note(table, own) for own in score_table.own_columns(columns)[:1]]

timings = map(read, snakemake.input.timings)
taken = [
    Training.of(*row, heading, [next(timings) for _ in seeds[row[0]]])
    for row in rows
    for heading in headings
]
write_csv(Path(snakemake.output.seconds), *as_table(taken))
header, lines = score_table.as_csv(table, headings)
write_csv(Path(snakemake.output.csv), header, lines)
in_paper = {column["column"]: column.get("paper") for column in columns}
reference = score_table.read_reference(Path(snakemake.input.reference))
title = score_table.TITLES[name]
markdown = score_table.as_markdown(title, table, in_paper, reference, text)
write_text(Path(snakemake.output.markdown), markdown)
provenance = {
    **environment(),
    "config": config,
    "networks": snakemake.params.networks,
    "plugins": snakemake.params.plugins,
    "databases": {
        database: {
            "survey": surveys[database],
            "sha256": dict(plugins["dataset", database].tags.files),
            "failures": failures[database],
        }
        for database in databases
    },
}
write_json(Path(snakemake.output.provenance), provenance)
