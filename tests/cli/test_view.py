"""``gipkg view``: pictures that show something, and what to install where they cannot."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gipkg.cli import _extras
from tests.cli.commands import records, run, run_well


def test_meshes_maps_and_images_are_drawn(mesh_file: Path, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    run_well("parametrize", mesh_file, "-o", folder / "map.ply")
    run_well("image", folder / "map.ply", "-o", folder / "image.npy", "--size", "16")
    run_well("image", folder / "map.ply", "-o", folder / "hks.npy", "--size", "16", "-d", "hks")
    files = (mesh_file, *(folder / name for name in ("map.ply", "image.npy", "hks.npy")))
    drawn = records(run_well("view", *files, "-o", tmp_path / "out", "--size", "64", "--json"))
    for record, panels in zip(drawn, (1, 3, 2, 5), strict=True):
        picture = np.asarray(Image.open(io.BytesIO(Path(record["output"]).read_bytes())))
        assert picture.shape == (64, 64 * panels, 3)
        for panel in np.hsplit(picture, panels):
            assert panel.std() > 5


def test_a_missing_extra_is_named(
    mesh_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_extras, "find_spec", lambda name: None)
    result = run("view", mesh_file, "-o", tmp_path / "a.png")
    assert result.exit_code == 1
    assert 'this needs pyvista and matplotlib: pip install "gipkg[figures]"' in result.stderr
    assert not (tmp_path / "a.png").exists()
