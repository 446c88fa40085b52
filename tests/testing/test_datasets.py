"""The suite of datasets accepts a right one and has a wrong one for every check."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from gipkg.api import Dataset, DatasetTags, Protocol, Shape
from gipkg.errors import DatasetNotFound
from gipkg.testing import datasets as suite
from gipkg.testing import meshes, parametrize_with_checks, run_checks


class Balls(Dataset):
    summary: ClassVar[str] = "balls and eggs"
    citation: ClassVar[str] = "none"
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=8, classes=2, licence="CC0-1.0", source="generated"
    )
    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol(2)}

    def available(self, root):
        return True

    def fetch(self, root):
        pass

    def shapes(self, root):
        return tuple(Shape(f"{name}{i}", name) for name in ("ball", "egg") for i in range(4))

    def load(self, root, shape_id):
        if shape_id not in {shape.id for shape in self.shapes(root)}:
            raise DatasetNotFound(f"there is no {shape_id}")
        size = 1.0 + int(shape_id[-1])
        return meshes.ellipsoid((size, size, size if "ball" in shape_id else 2 * size))


@parametrize_with_checks([Balls()])
def test_a_right_plugin_passes(check) -> None:
    check()


class Pair(Balls):
    tags: ClassVar[DatasetTags] = replace(Balls.tags, shapes=2)
    protocols: ClassVar[dict[str, Protocol]] = {}

    def shapes(self, root):
        return super().shapes(root)[3:5]


@pytest.mark.parametrize("name", ["holds_different_shapes", "loads_the_same_shape_twice"])
def test_a_database_may_have_few_shapes(name: str, tmp_path: Path) -> None:
    getattr(suite, name)(Pair(), tmp_path)


class Unsorted(Balls):
    def shapes(self, root):
        return super().shapes(root)[::-1]


class Miscounted(Balls):
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=9, classes=2, licence="CC0-1.0", source="generated"
    )


class Excluding(Balls):
    """Lists a shape that it says it leaves out."""

    tags: ClassVar[DatasetTags] = replace(Balls.tags, excluded={"ball1": "flat"})


class Unlicensed(Balls):
    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=True, shapes=8, classes=2, licence="", source="generated"
    )


class Unfiled(Balls):
    """Claims to be real, yet names no files and is there without any."""

    tags: ClassVar[DatasetTags] = DatasetTags(
        generated=False, shapes=8, classes=2, licence="CC0-1.0", source="somewhere"
    )


class Unsplittable(Balls):
    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol(4)}


class Partless(Balls):
    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol("official")}


class Classless(Balls):
    """Has a protocol of a class that it has not."""

    protocols: ClassVar[dict[str, Protocol]] = {"Balls": Protocol(2, classes=("cube",))}


class Absent(Balls):
    def available(self, root):
        return False


class Littering(Balls):
    def fetch(self, root):
        (root / "litter").touch()


class DicingBalls(Balls):
    def load(self, root, shape_id):
        return meshes.scaled(super().load(root, shape_id), np.random.default_rng().uniform())


class Repeating(Balls):
    def load(self, root, shape_id):
        return super().load(root, "ball0" if shape_id.startswith("ball") else shape_id)


class Inventing(Balls):
    def load(self, root, shape_id):
        return meshes.sphere(1)


WRONG = {
    Unsorted: {"lists-shapes-in-one-order"},
    Miscounted: {"counts-what-its-tags-say"},
    Excluding: {"counts-what-its-tags-say"},
    Unlicensed: {"tags-are-complete"},
    Unfiled: {"tags-are-complete", "is-absent-from-an-empty-folder"},
    Unsplittable: {"names-its-protocols", "splits-by-its-protocols"},
    Partless: {"splits-by-its-protocols"},
    Classless: {"splits-by-its-protocols"},
    Absent: {"is-available-anywhere"},
    Littering: {"is-available-anywhere"},
    DicingBalls: {"loads-the-same-shape-twice"},
    Repeating: {"holds-different-shapes"},
    Inventing: {"refuses-an-unknown-shape"},
}


@pytest.mark.parametrize("plugin", WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_wrong_plugin_fails_the_checks_of_what_is_wrong(plugin: type, failed_checks) -> None:
    assert WRONG[plugin] <= failed_checks(plugin())


def test_every_check_of_this_kind_has_a_wrong_plugin(common_checks: set[str]) -> None:
    assert set().union(*WRONG.values()) == set(suite.SUITE.checks) - common_checks


def test_skipped_checks_do_not_count_as_run(tmp_path: Path) -> None:
    report = run_checks(Absent(), data_root=tmp_path)
    assert report.count("skipped") == sum(check.needs_data for check in suite.SUITE.checks.values())
    assert report.run == len(report.outcomes) - report.count("skipped")
