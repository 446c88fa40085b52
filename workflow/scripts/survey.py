"""Sum up the surfaces of a database: how fine they are and what was repaired."""

import json
from dataclasses import asdict
from pathlib import Path

from gipkg.files import write_json
from gipkg.reporting.survey import survey
from gipkg.shards import Shard

import job

job.start(snakemake)
shards = [Shard.open(Path(path)) for path in snakemake.input]
reports = {
    shape_id: json.loads(str(shard[shape_id]["report"])) for shard in shards for shape_id in shard
}
failures = {shape_id: reason for shard in shards for shape_id, reason in shard.failures.items()}
write_json(Path(snakemake.output[0]), asdict(survey(reports, failures)), sealed=True)
