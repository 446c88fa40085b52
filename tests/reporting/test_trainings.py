from __future__ import annotations

import math

from gipkg.reporting.trainings import Training


def test_only_trainings_seen_whole_count() -> None:
    timings = [
        {"cpu": 10.0, "wall": 6.0, "resumed": False},
        {"cpu": 20.0, "wall": 8.0, "resumed": False},
        {"cpu": 0.1, "wall": 0.1, "resumed": True},
    ]
    found = Training.of("db", "A", "Ours", timings)
    assert (found.seconds_trainings, found.seconds_cpu, found.seconds_wall) == (2, 15.0, 7.0)
    none = Training.of("db", "A", "Ours", timings[2:])
    assert none.seconds_trainings == 0
    assert math.isnan(none.seconds_cpu)
