"""The contracts of a plugin: what to read before writing one, a module a kind.

A plugin is a small frozen pydantic model. Its fields are its parameters: typed, each with
a default and a ``description`` (and bounds where they exist). It has one method to call and
is pure: arrays in, arrays out; files, configuration and clocks belong to the workflow.
Only a :class:`Dataset` reads files, and only under the data root it is given.
"""

from gipkg.api.baseline import Baseline, BaselineTags
from gipkg.api.dataset import Dataset, DatasetTags, Protocol, Shape, Volume
from gipkg.api.descriptor import Descriptor, DescriptorTags
from gipkg.api.parametrizer import (
    Callback,
    Iteration,
    Parametrizer,
    ParametrizerTags,
    SphericalMap,
)
from gipkg.api.plugin import Plugin

API_VERSION = 1
"""Version of these contracts; it changes when an existing plugin would have to change."""

__all__ = [
    "API_VERSION",
    "Baseline",
    "BaselineTags",
    "Callback",
    "Dataset",
    "DatasetTags",
    "Descriptor",
    "DescriptorTags",
    "Iteration",
    "Parametrizer",
    "ParametrizerTags",
    "Plugin",
    "Protocol",
    "Shape",
    "SphericalMap",
    "Volume",
]
