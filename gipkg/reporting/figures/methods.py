"""How methods that share a panel are told apart: colour, dashes and marker."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import cycle
from typing import Any

from gipkg.reporting.colours import CATEGORIES, INK

DASHES = ("-", "--", ":", "-.")
MARKERS = "osD^vPX"


def styles(methods: Sequence[str], emphasised: Collection[str] = ()) -> dict[str, dict[str, Any]]:
    """Give each method what matplotlib draws its line with, no two alike.

    Those to be emphasised are thick and in ink. The others take colours that are told apart with
    colour vision deficiencies, but for yellow, which is too light for a line.

    Parameters
    ----------
    methods : sequence of str
        Up to 24, and 4 emphasised.
    emphasised : collection of str
    """
    thin = ({"color": hue, "linestyle": dashes} for dashes in DASHES for hue in CATEGORIES[:-1])
    thick = ({"color": INK, "linestyle": dashes, "linewidth": 2.5} for dashes in DASHES)
    markers = cycle(MARKERS)
    return {
        method: {
            "linewidth": 1.2,
            "marker": next(markers),
            "markersize": 3.5,
            **next(thick if method in emphasised else thin),
        }
        for method in methods
    }
