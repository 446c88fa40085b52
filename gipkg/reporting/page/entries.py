"""What the page says of each table and figure, gathered from the files of a run."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from gipkg.files import read_csv, read_json
from gipkg.reporting import score_table, table_distortion
from gipkg.reporting.page.claims import Checked, check
from gipkg.reporting.page.clocks import read_clocks, seconds_of
from gipkg.reporting.page.comparisons import (
    Comparison,
    compare_distortion,
    compare_scores,
)
from gipkg.reporting.page.reference import Item, Paper
from gipkg.reporting.page.verdicts import Verdict, reason_for

_WIDTH = 1600
"""Pixels of a picture on the page; the figures themselves are wider."""


@dataclass(frozen=True, slots=True)
class Entry:
    """A table or figure of the paper, and what this run made of it.

    Attributes
    ----------
    item : Item
    made : bool
        Whether this run has it.
    why : str
        The reason, where it has not.
    command : str
    seconds, work : float
        What the last step took, and all stages of its databases; 0 where no clock was kept.
    provenance : str
        As JSON; empty where there is none.
    picture : str
        Address with the data themselves; empty for a table.
    checks : tuple of Checked
    comparison : Comparison or None
    reasons : tuple of (where, verdict, why)
    table : list of rows, or None
        Where there is nothing of the paper to set it beside.
    """

    item: Item
    made: bool
    why: str
    command: str
    seconds: float
    work: float
    provenance: str
    picture: str
    checks: tuple[Checked, ...]
    comparison: Comparison | None
    reasons: tuple[tuple[str, Verdict, str], ...]
    table: list[dict[str, str]] | None


def gather(item: Item, paper: Paper, results: Path, reference: Path) -> Entry:
    """Collect what a run has of one table or figure.

    Parameters
    ----------
    item : Item
    paper : Paper
    results : Path
        Folder of the results.
    reference : Path
        Folder with the paper's tables.
    """
    csv, picture, notes = (results / f"{item.name}{end}" for end in (".csv", ".png", ".json"))
    made = csv.is_file()
    provenance = read_json(notes) if notes.is_file() else {}
    comparison = _comparison(item.name, csv, provenance, reference, paper)
    clocks = {clock.stage: clock.seconds for clock in read_clocks(results / "benchmarks")}
    databases = provenance.get("databases", ())
    target = picture if picture.is_file() else csv
    return Entry(
        item,
        made,
        "" if made else _absence(item, paper),
        f"snakemake --cores 2 results/{target.name}",
        clocks.get(item.name, 0.0),
        seconds_of(databases, results / "benchmarks") if databases else 0.0,
        json.dumps(provenance, indent=1, sort_keys=True) if provenance else "",
        _as_address(picture) if picture.is_file() else "",
        tuple(check(claim, results) for claim in item.claims),
        comparison,
        _reasons(comparison) if comparison else (),
        read_csv(csv) if made and comparison is None and not picture.is_file() else None,
    )


def _absence(item: Item, paper: Paper) -> str:
    why = reason_for(paper.reasons, item.name, "", "", Verdict.NOT_IN_THIS_RUN)
    return why or "the workflow was not asked for it"


def _comparison(
    name: str, csv: Path, provenance: Mapping[str, Any], reference: Path, paper: Paper
) -> Comparison | None:
    """Set a table beside the paper's; None for what the paper has no table of."""
    rows = read_csv(csv) if csv.is_file() else []
    if name in score_table.TITLES:
        columns = provenance["config"][name]["columns"] if rows else []
        printed = score_table.read_reference(reference / f"{name}.csv")
        return compare_scores(name, rows, columns, printed, paper)
    if name == "table_distortion":
        methods = provenance["config"]["methods"] if rows else []
        in_paper = {method["parametrizer"]: method.get("paper") for method in methods}
        figures = table_distortion.read_reference(reference / f"{name}.csv")
        return compare_distortion(rows, in_paper, figures, paper)
    return None


def _reasons(comparison: Comparison) -> tuple[tuple[str, Verdict, str], ...]:
    """List what is said of the figures that are not as in the paper, and of which cells."""
    found: dict[tuple[Verdict, str], dict[str, None]] = {}
    for cell in comparison.cells.values():
        for figure in cell.figures:
            if figure.why:
                cells = found.setdefault((figure.verdict, figure.why), {})
                cells[f"{cell.row} {cell.column}"] = None
    return tuple((", ".join(cells), verdict, why) for (verdict, why), cells in found.items())


def _as_address(picture: Path) -> str:
    """Return a picture as an address that holds it, no wider than a screen."""
    from PIL import Image

    with Image.open(picture) as image:
        drawn = image.convert("RGB")
    if drawn.width > _WIDTH:
        drawn = drawn.resize(
            (_WIDTH, round(drawn.height * _WIDTH / drawn.width)), Image.Resampling.LANCZOS
        )
    buffer = BytesIO()
    drawn.save(buffer, "WEBP", quality=85, method=6)
    return f"data:image/webp;base64,{b64encode(buffer.getvalue()).decode()}"


def verdicts(entries: Sequence[Entry]) -> list[Verdict]:
    """Return the verdicts of all tables."""
    return [one for entry in entries if entry.comparison for one in entry.comparison.verdicts]
