"""Sum up the surfaces of a database: how fine they are and what was repaired."""

from dataclasses import asdict
from pathlib import Path

from gipkg.files import write_json
from gipkg.reporting.survey import survey

import job
from meshes import report_of
from shards import Shards

job.start(snakemake)
surfaces = Shards(snakemake.input)
reports = {shape_id: report_of(surface) for shape_id, surface in surfaces.items()}
found = survey(reports, surfaces.failures)
write_json(Path(snakemake.output[0]), asdict(found), sealed=True)
