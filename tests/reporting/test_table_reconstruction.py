from __future__ import annotations

from gipkg.reporting.table_reconstruction import Entry, as_csv, as_markdown


def entry(method: str, shape_id: str, size: int, hausdorff: str, mean: str, failure: str = ""):
    row = {"id": shape_id, "size": str(size), "hausdorff": hausdorff, "mean": mean}
    return Entry.of("db", method, row | {"failure": failure})


ENTRIES = [
    entry("good", "a", 56, "0.01", "0.001"),
    entry("good", "a", 128, "0.005", "0.0005"),
    entry("good", "b", 56, "0.03", "0.003"),
    entry("good", "b", 128, "0.015", "0.0015"),
    entry("bad", "a", 56, "0.2", "0.02"),
    entry("bad", "a", 128, "0.1", "0.01"),
    entry("bad", "b", 56, "", "", "UnsupportedMesh: folded"),
    entry("bad", "b", 128, "", "", "UnsupportedMesh: folded"),
]


def test_a_line_for_each_shape_and_size_and_two_columns_for_each_method() -> None:
    header, lines = as_csv(ENTRIES, ["good", "bad"])
    figures = ["good hausdorff", "good mean", "bad hausdorff", "bad mean"]
    assert header == ["database", "shape", "size", *figures]
    assert lines == [
        ["db", "a", "56", "0.01", "0.001", "0.2", "0.02"],
        ["db", "a", "128", "0.005", "0.0005", "0.1", "0.01"],
        ["db", "b", "56", "0.03", "0.003", "", ""],
        ["db", "b", "128", "0.015", "0.0015", "", ""],
    ]


def test_readers_get_percent_over_the_shapes_of_a_size() -> None:
    text = as_markdown(ENTRIES, ["good", "bad"], ["One.", "Two."])
    lines = [line for line in text.splitlines() if line.startswith("| `db`")]
    assert lines == [
        "| `db` | 2 | 56 × 56 | 2.00 / 3.00 (0.200) | 20.00 / 20.00 (2.000) |",
        "| `db` | 2 | 128 × 128 | 1.00 / 1.50 (0.100) | 10.00 / 10.00 (1.000) |",
    ]
    assert "- One.\n- Two." in text


def test_a_method_without_any_image_has_no_figure() -> None:
    text = as_markdown(ENTRIES[-1:], ["bad"], [])
    assert "| `db` | 1 | 128 × 128 | – |" in text
