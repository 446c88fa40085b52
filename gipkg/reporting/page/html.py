"""The page as one file: template, styles, scripts and data, and nothing from elsewhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any

import numpy as np

from gipkg.reporting.colours import DIVERGING, SEQUENTIAL
from gipkg.reporting.page.clocks import Clock
from gipkg.reporting.page.entries import Entry, verdicts
from gipkg.reporting.page.scene import RATIO
from gipkg.reporting.page.verdicts import count

_SIGNED = ("x", "y", "z", RATIO)
"""Channels that are coloured about 0."""


def render(
    entries: Sequence[Entry],
    clocks: Sequence[Clock],
    scenes: Sequence[Mapping[str, Any]],
    environment: Mapping[str, Any],
) -> str:
    """Set the page.

    Parameters
    ----------
    entries : sequence of Entry
        The tables and figures, in order.
    clocks : sequence of Clock
    scenes : sequence of mappings
        From :func:`gipkg.reporting.page.scene.as_data`.
    environment : mapping
        From :func:`gipkg.reporting.provenance.environment`.

    Returns
    -------
    str
        HTML that asks for nothing from anywhere.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup
    from plotly.offline import get_plotlyjs

    loader = PackageLoader("gipkg.reporting.page", "assets")
    jinja = Environment(
        loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=False
    )
    jinja.filters["duration"] = _duration
    view = {
        "scenes": list(scenes),
        "ratio": RATIO,
        "signed": list(_SIGNED),
        "sequential": _colours(SEQUENTIAL),
        "diverging": _colours(DIVERGING),
    }
    checks = [check for entry in entries for check in entry.checks if check.value is not None]
    return jinja.get_template("page.html.j2").render(
        entries=entries,
        clocks=clocks,
        counts=count(verdicts(entries)),
        checks=checks,
        environment=environment,
        scenes=view,
        # Our own files and a library of a fixed version: script and style, not text.
        css=Markup(_asset("page.css")),
        geometry=Markup(_asset("geometry.js")),
        viewer=Markup(_asset("viewer.js")),
        plotly=Markup(get_plotlyjs()),
    )


def _asset(name: str) -> str:
    return resources.files("gipkg.reporting.page").joinpath("assets", name).read_text("utf-8")


def _colours(name: str) -> list[list[int]]:
    """Return 64 colours of one of Matplotlib's scales as bytes."""
    from matplotlib import colormaps

    colours = colormaps[name](np.linspace(0, 1, 64))[:, :3]
    return np.rint(255 * colours).astype(int).tolist()


def _duration(seconds: float) -> str:
    """Say a time as readers do."""
    if seconds < 60:
        return f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
