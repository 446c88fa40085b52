"""Snakemake's own report of a run holds every table and figure, each with a caption."""

from __future__ import annotations

import re
from pathlib import Path

from tests.workflow.workdir import Workdir


def test_the_report_holds_what_the_run_made(smoke: Workdir, tmp_path: Path) -> None:
    workdir, report = smoke.copy(tmp_path / "run"), tmp_path / "report.html"
    done = workdir.run("--report", report)
    assert done.returncode == 0, done.stdout
    text = report.read_text(encoding="utf-8")
    tables = ("table1", "table1_beyond", "table_distortion", "table_reconstruction")
    figures = (*(f"figure{number}" for number in range(1, 9)), "figure_beyond")
    names = (*(f"{one}.csv" for one in tables), *(f"{one}.png" for one in figures))
    for name in ("index.html", *names):
        assert re.search(rf"results/{re.escape(name)}\b", text), name
    # Captions know what the run was of.
    assert "those of chair-000, which stands upright" in " ".join(text.replace("\\n", " ").split())
