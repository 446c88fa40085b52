"""Channels come back with their names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gipkg.files import read_csv
from gipkg.formats.channels import write_channels

CHANNELS = np.random.default_rng(0).normal(size=(5, 2)) * [1e-9, 1e9]


def test_both_formats_are_exact(tmp_path: Path) -> None:
    for suffix in (".npy", ".csv"):
        write_channels(tmp_path / f"a{suffix}", CHANNELS, ("one", "two"))
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy", allow_pickle=False), CHANNELS)
    rows = read_csv(tmp_path / "a.csv")
    assert [[float(row["one"]), float(row["two"])] for row in rows] == CHANNELS.tolist()


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.npy, \.csv"):
        write_channels(tmp_path / "a.txt", CHANNELS, ("one", "two"))
