"""Databases by name: their shapes, classes and meshes, and the splits of the protocols."""

from gipkg.datasets.splits import choose, official_split, random_split, split

__all__ = ["choose", "official_split", "random_split", "split"]
