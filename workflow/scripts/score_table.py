"""Set a table from its scores: for programs, for readers, and where it comes from."""

from pathlib import Path

from gipkg.api import Protocol
from gipkg.files import write_csv, write_text
from gipkg.reporting import notes, score_table
from gipkg.reporting.records import as_table
from gipkg.reporting.survey import Survey
from gipkg.reporting.trainings import Training

import job
from documents import read_listing, read_sealed, write_provenance

job.start(snakemake)
config, seeds = snakemake.params.config, snakemake.params.seeds
protocols = {
    database: {split: Protocol(**protocol) for split, protocol in of_database.items()}
    for database, of_database in snakemake.params.protocols.items()
}
rows = [(database, split) for database, splits in protocols.items() for split in splits]
name = snakemake.wildcards.table
columns = config[name]["columns"]
headings = [column["column"] for column in columns]
databases = list(protocols)
plugins = job.plugins(snakemake.params.plugins)

evaluations = map(read_sealed, snakemake.input.evaluations)
table = [
    score_table.Row(*row, {one: score_table.Cell.of(next(evaluations)) for one in headings})
    for row in rows
]
surveys = dict(zip(databases, map(read_sealed, snakemake.input.surveys), strict=True))
lost = map(read_sealed, snakemake.input.failures)
failures = {database: {heading: next(lost) for heading in headings} for database in databases}

text = [
    notes.database_note(
        database,
        list(protocols[database]),
        plugins["dataset", database],
        Survey(**surveys[database]),
    )
    for database in databases
]
for database, path in zip(databases, snakemake.input.listings, strict=True):
    listing = read_listing(path)
    text += notes.selection_notes(database, protocols[database], listing)
text += [notes.column_note(column, plugins) for column in columns]
text += [
    notes.failure_note(heading, database, failures[database][heading])
    for database in databases
    for heading in headings
    if failures[database][heading]
]
official = {
    database
    for database, splits in protocols.items()
    if all(protocol.train_per_class == "official" for protocol in splits.values())
}
text.append(notes.seeds_note(seeds, official))
text += [notes.ahead_note(table, own) for own in score_table.own_columns(columns)[:1]]

timings = map(read_sealed, snakemake.input.timings)
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
about = {
    database: {
        "survey": surveys[database],
        "sha256": dict(plugins["dataset", database].tags.files),
        "failures": failures[database],
    }
    for database in databases
}
write_provenance(
    snakemake.output.provenance,
    snakemake.params,
    networks=snakemake.params.networks,
    databases=about,
)
