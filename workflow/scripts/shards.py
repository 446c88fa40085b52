"""All shards of a database as one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from gipkg.shards import Arrays, Shard


class Shards(Mapping[str, Arrays]):
    """The arrays of every shape of a database, read from its shard when asked for.

    Attributes
    ----------
    failures : dict
        Identifier -> reason, of the shapes that have none.
    """

    def __init__(self, paths: Iterable[str]) -> None:
        shards = [Shard.open(Path(path)) for path in paths]
        self._shard = {shape_id: shard for shard in shards for shape_id in shard}
        self.failures = {
            shape_id: reason for shard in shards for shape_id, reason in shard.failures.items()
        }

    def __getitem__(self, shape_id: str) -> Arrays:
        return self._shard[shape_id][shape_id]

    def __iter__(self) -> Iterator[str]:
        return iter(self._shard)

    def __len__(self) -> int:
        return len(self._shard)

    def __contains__(self, shape_id: object) -> bool:
        return shape_id in self._shard
