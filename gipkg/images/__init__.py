"""Spherical map and channels to geometry images, and images back to meshes."""

from gipkg.images.cuts import random_cuts, standard_cuts, upright_cuts
from gipkg.images.lookup import PixelLookup, geometry_image, lookup
from gipkg.images.octahedron import Sampling
from gipkg.images.padding import pad
from gipkg.images.reconstruct import reconstruct

__all__ = [
    "PixelLookup",
    "Sampling",
    "geometry_image",
    "lookup",
    "pad",
    "random_cuts",
    "reconstruct",
    "standard_cuts",
    "upright_cuts",
]
