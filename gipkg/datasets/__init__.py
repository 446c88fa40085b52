"""Databases by name: their shapes, classes and meshes, and the splits of the protocols."""

from gipkg.datasets.splits import random_split

__all__ = ["random_split"]
