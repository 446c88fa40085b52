"""The page's tables hold what either table has."""

from __future__ import annotations

from pathlib import Path

import pytest

from gipkg.files import write_csv
from gipkg.reporting import score_table, table_distortion
from gipkg.reporting.page.claims import check
from gipkg.reporting.page.comparisons import compare_distortion, compare_scores
from gipkg.reporting.page.reference import Claim, Paper, read_paper
from gipkg.reporting.page.verdicts import Verdict
from tests.workflow.workdir import REPOSITORY

REFERENCE = REPOSITORY / "results" / "reference"


@pytest.fixture(scope="module")
def paper() -> Paper:
    return read_paper(REFERENCE / "paper.yaml")


@pytest.fixture(scope="module")
def rows() -> list[dict[str, str]]:
    cells = {
        "Ours": score_table.Cell((88.0, 89.0), (0.70, 0.72)),
        "New": score_table.Cell((9,), (1,)),
    }
    table = [
        score_table.Row("shrec11", "SHREC1", cells),
        score_table.Row("tiny", "Tiny1", cells),
    ]
    header, lines = score_table.as_csv(table, list(cells))
    return [dict(zip(header, line, strict=True)) for line in lines]


def test_ours_and_the_papers_columns_are_all_there(
    paper: Paper, rows: list[dict[str, str]]
) -> None:
    columns = [{"column": "Ours", "paper": "Ours"}, {"column": "New"}]
    reference = score_table.read_reference(REFERENCE / "table1.csv")
    compared = compare_scores("table1", rows, columns, reference, paper)
    assert compared.rows == ("SHREC1", "Tiny1", "McGill1", "McGill2", "SHREC2")
    assert compared.columns[:2] == ("Ours", "New")
    assert set(compared.columns[2:]) == {"SG", "Zer", "LFD", "SN", "Conf", "Sph"}

    accuracy, precision = compared.cells["SHREC1", "Ours"].figures
    assert (accuracy.ours, accuracy.printed) == ("88.50 ± 0.71", "88.6")
    assert accuracy.verdict == Verdict.MATCHES
    assert precision.verdict == Verdict.BETTER
    assert "500 faces" in precision.why

    def told(row: str, column: str) -> set[Verdict]:
        return {figure.verdict for figure in compared.cells[row, column].figures}

    assert told("Tiny1", "Ours") == told("SHREC1", "New") == {Verdict.NOT_IN_THE_PAPER}
    assert told("McGill1", "Ours") == {Verdict.NOT_IN_THIS_RUN}
    assert told("SHREC1", "SG") == {Verdict.NOT_ATTEMPTED}
    assert ("McGill1", "SG") not in compared.cells
    assert all(
        figure.why
        for cell in compared.cells.values()
        for figure in cell.figures
        if figure.verdict in (Verdict.NOT_ATTEMPTED, Verdict.NOT_IN_THIS_RUN)
    )
    # Seven of the paper's columns, four rows, two quantities, less the two that SG does not have.
    assert len(compared.verdicts) == 4 * 7 * 2 - 2 * 2


def test_without_a_table_all_of_the_papers_is_not_in_this_run(paper: Paper) -> None:
    reference = score_table.read_reference(REFERENCE / "table2.csv")
    compared = compare_scores("table2", [], [], reference, paper)
    assert set(compared.verdicts) == {Verdict.NOT_IN_THIS_RUN}


def test_the_distortion_is_judged_on_the_papers_database_alone(paper: Paper) -> None:
    rows = [
        {"database": database, "parametrizer": "authalic", "variance": "9e-9"}
        for database in ("tosca", "tiny")
    ]
    reference = table_distortion.read_reference(REFERENCE / "table_distortion.csv")
    methods = {"authalic": "Ours", "penalty": "Penalty", "conformal": None}
    compared = compare_distortion(rows, methods, reference, paper)
    verdicts = {key: cell.figures[0].verdict for key, cell in compared.cells.items()}
    assert verdicts == {
        ("authalic", "tosca"): Verdict.BETTER,
        ("authalic", "tiny"): Verdict.NOT_IN_THE_PAPER,
        ("penalty", "tosca"): Verdict.NOT_IN_THIS_RUN,
    }


def test_claims_look_at_the_rows_they_name(tmp_path: Path) -> None:
    lines = [("tip 1", 0.9), ("tip 2", 0.8), ("whole", 0.1), ("tip 3", "")]
    write_csv(tmp_path / "parts.csv", ("part", "ratio"), lines)
    claim = Claim("tips", "parts.csv", "ratio", {"part": "tip*"}, "min", at_least=0.8)
    checked = check(claim, tmp_path)
    assert (checked.value, checked.holds, checked.condition) == (0.8, True, "≥ 0.8")
    assert not check(Claim("all", "parts.csv", "ratio", {}, "min", at_least=0.8), tmp_path).holds
    absent = check(Claim("none", "other.csv", "ratio", at_most=1), tmp_path)
    assert absent.value is None
    assert not absent.holds
