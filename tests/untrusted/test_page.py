"""Names from data are text on the page, whatever they hold."""

from __future__ import annotations

import json
from html.parser import HTMLParser

from gipkg.reporting.page.clocks import Clock
from gipkg.reporting.page.html import render

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'`\n&amp;{{ 7*7 }}"


class Elements(HTMLParser):
    """The elements of a page, their attributes' names, and its text."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, tuple[str, ...]]] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, tuple(name for name, _ in attrs)))

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def page(name: str) -> str:
    scene = {"name": name, "note": name, "vertices": "", "faces": "", "maps": [], "channels": []}
    environment = {
        "gipkg": {"version": name, "commit": name, "modified": False},
        "python": name,
        "machine": {"processor": name, "cores": 2},
    }
    return render([], [Clock(name, 1, 2.0)], [scene], environment)


def elements(text: str) -> Elements:
    parser = Elements()
    parser.feed(text)
    return parser


def test_a_name_adds_no_element_and_no_attribute() -> None:
    harmless, hostile = elements(page("name")), elements(page(HOSTILE))
    assert hostile.elements == harmless.elements
    assert any(HOSTILE in text for text in hostile.text)


def test_a_name_stays_whole_in_the_data_of_the_view() -> None:
    text = page(HOSTILE)
    data = json.loads(text.partition('id="scenes">')[2].partition("</script>")[0])
    assert data["scenes"][0]["name"] == HOSTILE


def test_the_page_asks_for_nothing_from_elsewhere() -> None:
    text = page("name")
    assert "Content-Security-Policy" in text
    assert "default-src 'none'" in text
    tags = elements(text).elements
    assert not [tag for tag, names in tags if tag in {"link", "iframe", "object", "embed", "base"}]
    assert not [names for tag, names in tags if tag == "script" and "src" in names]
