"""Set the distortion table: for programs, for readers, and where it comes from."""

from pathlib import Path

from gipkg.files import write_csv, write_text
from gipkg.reporting import notes
from gipkg.reporting import table_distortion as table
from gipkg.reporting.shapes import read_shapes
from gipkg.reporting.survey import Survey

import job
from documents import read_sealed, write_provenance

job.start(snakemake)
params, plugins = snakemake.params, job.plugins(snakemake.params.plugins)
surveys = dict(zip(params.databases, map(read_sealed, snakemake.input.surveys), strict=True))
cells = [(database, method) for database in params.databases for method in params.methods]
shapes = dict(zip(cells, map(read_shapes, map(Path, snakemake.input.shapes)), strict=True))
rows = [table.summarise(*cell, shapes[cell]) for cell in cells]
failures = {
    f"{database} {method}": {
        shape.id: shape.failure
        for shape in shapes[database, method]
        if shape.failure and shape.id not in surveys[database]["failures"]
    }
    for database, method in cells
}

text = []
for database in params.databases:
    dataset, survey = plugins["dataset", database], Survey(**surveys[database])
    text.append(notes.database_note(database, [database], dataset, survey))
    if survey.failures:
        text.append(notes.missing_note("The surface stage", database, survey.failures))
    text += [
        notes.missing_note(method, database, failures[f"{database} {method}"])
        for method in params.methods
        if failures[f"{database} {method}"]
    ]
text += [notes.column_note({"column": one, "parametrizer": one}, plugins) for one in params.methods]

header, lines = table.as_csv(rows)
write_csv(Path(snakemake.output.csv), header, lines)
reference = table.read_reference(Path(snakemake.input.reference))
markdown = table.as_markdown(rows, params.methods, reference, text)
write_text(Path(snakemake.output.markdown), markdown)
about = {
    database: {
        "survey": surveys[database],
        "sha256": dict(plugins["dataset", database].tags.files),
    }
    for database in params.databases
}
write_provenance(snakemake.output.provenance, params, databases=about, failures=failures)
