"""Every error that gipkg raises on purpose: each says what is at fault and the way out."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


class GipkgError(Exception):
    """Base of all gipkg errors; the command line prints it without a traceback."""


class MeshFormatError(GipkgError):
    """A file could not be read as a mesh.

    Parameters
    ----------
    path : Path or str
        The file at fault.
    fault : str
        What is wrong with it, and the way out.
    """

    def __init__(self, path: Path | str, fault: str) -> None:
        super().__init__(f"{path}: {fault}")
        self.path = Path(path)
        self.fault = fault


class DamagedFileError(GipkgError):
    """A file that gipkg wrote or fetched is no longer whole; the message says the way out."""


class ImageFormatError(GipkgError):
    """A file could not be read as a geometry image; the message names it and what it is."""


class UnsupportedMesh(GipkgError):
    """A mesh is well formed but outside the domain of the method asked for."""


class ParametrizationError(GipkgError):
    """A parametrizer could not keep what it guarantees; no map is returned."""


class DatasetNotFound(GipkgError):
    """A database's files are neither at hand nor to be had, or no shape has the identifier."""


class DatasetLayoutError(GipkgError):
    """A folder of one's own cannot be read as a database; the message names what is at fault."""


class TooManyFailures(GipkgError):
    """More shapes of a database failed than a run allows; the message lists them."""


class LearningError(GipkgError):
    """A network cannot be trained on what it was given, or not on this device."""


class RenderingError(GipkgError):
    """Nothing can be drawn on this machine; the message says what to install."""


class PluginError(GipkgError):
    """Base of the errors about plugins."""


class UnknownPluginError(PluginError):
    """No plugin of that kind has that name; the message lists near and known names."""


class DuplicatePluginError(PluginError):
    """Two sources register the same name within one kind; the message names both."""


class BrokenPluginError(PluginError):
    """A plugin is registered but cannot be imported or breaks its contract."""


class SplitError(GipkgError):
    """A database cannot be split as a protocol asks; the message names the class at fault."""


class InvalidParameterError(PluginError):
    """A plugin was given a parameter it does not have, or a value outside its bounds."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return ``"; did you mean 'x'?"`` for the nearest of the `known` names, or nothing."""
    from difflib import get_close_matches

    near = get_close_matches(name, list(known), n=1)
    return f"; did you mean {near[0]!r}?" if near else ""
