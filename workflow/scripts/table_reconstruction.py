"""Set the table of what geometry images keep of the shapes."""

from pathlib import Path

from gipkg.files import read_csv, write_csv, write_text
from gipkg.reporting import notes
from gipkg.reporting import table_reconstruction as table

import job
from documents import write_provenance

job.start(snakemake)
params, plugins = snakemake.params, job.plugins(snakemake.params.plugins)
methods = params.config["parametrizers"]
cells = [(database, method) for database in params.databases for method in methods]
entries = [
    table.Entry.of(*cell, row)
    for cell, path in zip(cells, snakemake.input, strict=True)
    for row in read_csv(Path(path))
]
text = [
    f"{notes.literal(database)}: {plugins['dataset', database].summary}."
    for database in params.databases
]
text += [notes.column_note({"column": one, "parametrizer": one}, plugins) for one in methods]
for database, method in cells:
    failed = {
        one.id: one.failure
        for one in entries
        if (one.database, one.parametrizer) == (database, method) and one.failure
    }
    if failed:
        text.append(notes.missing_note(method, database, failed))

header, lines = table.as_csv(entries, methods)
write_csv(Path(snakemake.output.csv), header, lines)
write_text(Path(snakemake.output.markdown), table.as_markdown(entries, methods, text))
about = {
    database: {"sha256": dict(plugins["dataset", database].tags.files)}
    for database in params.databases
}
write_provenance(snakemake.output.provenance, params, databases=about)
