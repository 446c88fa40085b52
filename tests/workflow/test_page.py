"""The page of a run, read as a file and in a browser."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from tests.workflow.workdir import Workdir

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# WebGL without a graphics card, and no sandbox, which root in a container does not get.
OPTIONS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


@pytest.fixture(scope="module")
def page_file(smoke: Workdir) -> Path:
    return smoke.path / "results" / "index.html"


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip("no browser (Debian and Ubuntu: apt-get install chromium)")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=found, args=OPTIONS)
        yield started
        started.close()


def test_every_claim_is_decided_and_every_figure_is_there(page_file: Path) -> None:
    text = page_file.read_text(encoding="utf-8")
    for number in range(1, 9):
        section = text.partition(f'<h2 id="figure{number}">')[2].partition("</section>")[0]
        assert 'src="data:image/webp;base64,' in section
        assert f"snakemake --cores 2 results/figure{number}.png" in section
        assert "not in this run" not in section
        assert "Provenance" in section
    # The run is on tiny shapes: what is there of the paper alone says so.
    table = text.partition('<h2 id="table1">')[2].partition("</section>")[0]
    assert "Tiny1" in table
    assert "SHREC2" in table
    assert "its database was not at hand" in table
    assert re.search(r"<p id=\"summary\">\s*\d+ <span", text)


def test_the_view_holds_what_the_configuration_names(page_file: Path) -> None:
    text = page_file.read_text(encoding="utf-8")
    packed = text.partition('id="scenes">')[2].partition("</script>")[0]
    scenes = json.loads(packed)["scenes"]
    assert [scene["name"] for scene in scenes] == ["hands-000", "spectacles-000"]
    for scene in scenes:
        assert [one["name"] for one in scene["maps"]] == ["authalic", "conformal"]
        channels = [channel["name"] for channel in scene["channels"]]
        assert {"x", "y", "z", "topological mask"} < set(channels)


def opened(browser: Browser, file: Path, width: int, faults: list[str]) -> Page:
    """Open the page in a window of some width, and note all that should not happen."""
    page = browser.new_page(viewport={"width": width, "height": 844})
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on(
        "console",
        lambda message: faults.append(message.text) if message.type == "error" else None,
    )
    page.on(
        "request",
        lambda request: (
            faults.append(request.url)
            if not request.url.startswith(("data:", "blob:", file.as_uri()))
            else None
        ),
    )
    page.goto(file.as_uri())
    page.wait_for_selector("body[data-view=ready]", timeout=120_000)
    return page


def image_of(page: Page) -> str:
    return page.evaluate("document.getElementById('image').toDataURL()")


def change(page: Page, control: str, value: str) -> str:
    """Set a control as a reader does, and return the image when it has been drawn anew."""
    page.evaluate(
        """([id, value]) => new Promise((drawn) => {
            const control = document.getElementById(id);
            control.value = value;
            control.dispatchEvent(new Event("input"));
            requestAnimationFrame(() => requestAnimationFrame(drawn));
        })""",
        [control, value],
    )
    return image_of(page)


def test_in_a_browser_the_cut_moves_the_image(browser: Browser, page_file: Path) -> None:
    faults: list[str] = []
    page = opened(browser, page_file, 1280, faults)
    steps = {
        "turn": "60",
        "latitude": "10",
        "longitude": "45",
        "map": "conformal",
        "channel": "x",
        "shape": "spectacles-000",
    }
    before = {control: page.input_value(f"#{control}") for control in steps}
    images = [image_of(page), *(change(page, *step) for step in steps.items())]
    assert len(set(images)) == len(images)
    assert page.locator("#mesh canvas").count() > 0
    assert page.locator("#sphere canvas").count() > 0
    assert page.locator(".verdict").count() > 50
    # Back again, the shape first, since the others are choices of its own.
    for step in reversed(before.items()):
        last = change(page, *step)
    assert last == images[0]
    page.close()
    assert faults == []


def test_on_a_phone_nothing_is_wider_than_the_screen(browser: Browser, page_file: Path) -> None:
    faults: list[str] = []
    page = opened(browser, page_file, 390, faults)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.close()
    assert faults == []
