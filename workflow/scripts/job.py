"""What every script begins with: its log, its plugins, and the map over its shapes."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from gipkg import registry
from gipkg.api import Plugin
from gipkg.errors import GipkgError
from gipkg.shards import Arrays, content_key, map_shard


def start(snakemake: Any) -> None:
    """Send all output of this process to the job's log; say errors of ours in one line."""
    with Path(snakemake.log[0]).open("w", encoding="utf-8") as log:
        for stream in (sys.stdout, sys.stderr):
            os.dup2(log.fileno(), stream.fileno())
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    sys.excepthook = _say


def plugin(kind: registry.Kind, spec: Mapping[str, Any]) -> Plugin:
    """Build a plugin as the rules resolved it."""
    if spec["target"]:
        registry.register_local(kind, spec["plugin"], spec["target"])
    return registry.create(kind, spec["plugin"], spec["parameters"])


def plugins(specs: Mapping[registry.Kind, Mapping[str, Any]]) -> dict[tuple[str, str], Plugin]:
    """Build the plugins of several kinds: (kind, name in the configuration) -> plugin."""
    return {
        (kind, name): plugin(kind, spec)
        for kind, instances in specs.items()
        for name, spec in instances.items()
    }


def map_shapes(
    snakemake: Any,
    ids: Collection[str],
    compute: Callable[[str], Arrays],
    failures: Mapping[str, str],
) -> None:
    """Fill the job's output, resuming what an earlier run of the same job has left.

    An output named ``seconds`` becomes the table of what each shape took.
    """
    out = Path(snakemake.output[0])
    seconds = snakemake.output.get("seconds")
    key = content_key(dict(snakemake.params.items()), map(Path, snakemake.input))
    label = "/".join(out.with_suffix("").parts[1:])  # below results/
    work = out.with_suffix(".work")
    clock = Path(seconds) if seconds else None
    map_shard(ids, compute, out, work, label, key=key, failures=failures, seconds=clock)


def _say(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, GipkgError):
        sys.stderr.write(f"{kind.__name__}: {error}\n")
    else:
        sys.__excepthook__(kind, error, trace)
