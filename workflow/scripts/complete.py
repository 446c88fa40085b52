"""Stop where more shapes failed on the way to a column than the configuration allows."""

from pathlib import Path

from gipkg.errors import TooManyFailures
from gipkg.files import write_json

import job
from shards import Shards

job.start(snakemake)
failures = Shards(snakemake.input).failures
if len(failures) > snakemake.params.max_failures:
    listing = "".join(f"\n  {shape_id}: {reason}" for shape_id, reason in sorted(failures.items()))
    allowed = snakemake.params.max_failures
    raise TooManyFailures(
        f"{len(failures)} shapes failed and max_failures is {allowed}; mend what is said below, or "
        f"allow more in the configuration:{listing}"
    )
write_json(Path(snakemake.output[0]), failures, sealed=True)
