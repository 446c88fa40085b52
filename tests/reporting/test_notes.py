from __future__ import annotations

from gipkg import registry
from gipkg.api import Protocol, Shape
from gipkg.reporting import notes
from gipkg.reporting.score_table import Cell, Row
from gipkg.reporting.survey import Survey


def test_a_generated_database_is_never_taken_for_a_real_one() -> None:
    found = Survey(200, (1000, 2000, 3000), {"pliers-001": ["cut handles"]}, {})
    made = notes.database_note(
        "made", ["M1", "M2"], registry.create("dataset", "articulated"), found
    )
    assert made.startswith("**M1, M2**: `made`, ")
    assert "200 surfaces of 1000 to 3000 vertices (median 2000), 1 of them repaired." in made
    assert "the paper has no figures for it" in made
    real = notes.database_note("shrec11", ["S1"], registry.create("dataset", "shrec11"), found)
    assert "Generated" not in real


def test_what_is_left_out_of_a_database_is_named() -> None:
    found = Survey(4891, (700, 790, 800), {}, {})
    voxels = registry.create("dataset", "modelnet10-voxels")
    note = notes.database_note("grids", ["G"], voxels, found)
    assert "voxel-derived" in note
    assert "Left out: `bathtub-train-0006`, " in note
    left_out = note.partition("Left out: ")[2]
    assert left_out.count("`, `") == 7
    assert left_out.endswith(" (`an empty grid`).")


def test_a_column_names_its_methods() -> None:
    plugins = {
        ("descriptor", "hks-raw"): registry.create("descriptor", "hks", {"logarithm": False}),
        ("parametrizer", "map"): registry.create("parametrizer", "conformal"),
        ("baseline", "dna"): registry.create("baseline", "shapedna"),
    }
    learned = {"column": "X", "parametrizer": "map", "descriptors": ["hks-raw"], "network": "n"}
    note = notes.column_note(learned, plugins)
    for word in ("**X**: ", "parametrizer `map` (", "descriptor `hks-raw` (", "network `n`."):
        assert word in note
    assert "images `standard`; network" in note
    assert "images `upright`" in notes.column_note({**learned, "images": "upright"}, plugins)
    note = notes.column_note({"column": "Y", "baseline": "dna"}, plugins)
    assert note.startswith("**Y**: baseline `dna` (")
    assert "network" not in note


def test_failures_are_named_with_nothing_of_them_taken_as_markup() -> None:
    note = notes.failure_note("Ours", "db", {"b": "open", "a`|<b>": "two\nlines"})
    assert note.endswith("`a'¦<b>` (`two lines`); `b` (`open`).")
    assert "lost 2 of the shapes of `db`" in note


def test_shapes_with_one_fault_are_named_together() -> None:
    note = notes.missing_note("Surfaces", "db", {"c": "open", "b": "torus", "a": "open"})
    assert note.endswith(": `a`, `c` (`open`); `b` (`torus`).")


def test_the_seeds_of_every_database_are_said() -> None:
    note = notes.seeds_note({"real": [0, 1, 2], "made": [0]})
    assert note.startswith("Random splits from the seeds 0, 1, 2 (`real`); 0 (`made`). Dev")
    note = notes.seeds_note({"real": [0, 1], "given": [0]}, official={"given"})
    assert note.startswith("Random splits from the seeds 0, 1 (`real`). Official split, trained ")
    alone = notes.seeds_note({"given": [0]}, official={"given"})
    assert alone.startswith("Official split, trained from the seeds 0 (`given`). Dev")


def test_what_takes_part_is_named_class_by_class_where_not_all_does() -> None:
    shapes = [Shape("ants-7", "ants"), Shape("ants-b1", "ants"), Shape("T3", "man|woman")]
    alike = {"M1": Protocol(1, classes=("ants",)), "M2": Protocol(0.5, classes=("ants",))}
    protocols = {**alike, "One": Protocol(1, shapes_per_class=1), "All": Protocol(1)}
    both, one = notes.selection_notes("some", protocols, shapes)
    assert both == "**M1, M2**: 2 of the 3 shapes of `some` take part: `ants` `7, b1`."
    assert one.startswith("**One**: 2 of the 3 shapes of `some` take part: `ants` `")
    assert one.endswith("; `man¦woman` `T3`.")


def test_who_is_ahead_is_computed() -> None:
    def row(split: str, **figures: tuple[float, float]) -> Row:
        return Row(
            "db", split, {name: Cell((a - 1, a + 1), (m, m)) for name, (a, m) in figures.items()}
        )

    rows = [row("A", Ours=(95, 0.9), Other=(95, 0.91)), row("B", Ours=(90, 0.8), Other=(91.5, 0.7))]
    note = notes.ahead_note(rows, "Ours")
    assert note == (
        "Other columns are ahead of **Ours**: A mAP, Other 0.9100 against 0.9000; "
        "B accuracy, Other 91.50 against 90.00."
    )
    note = notes.ahead_note([row("A", Ours=(95, 0.99991), Other=(95, 0.99993))], "Ours")
    assert note.endswith("A mAP, Other 0.99993 against 0.99991.")
    note = notes.ahead_note([row("A", Ours=(95, 0.9), Other=(95, 0.9))], "Ours")
    assert note == "On no row does another column have a higher mean than **Ours**."
