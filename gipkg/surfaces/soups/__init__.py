"""Polygon soups to closed genus-0 surfaces, through voxels."""

from gipkg.surfaces.soups.assembly import soup_surface

__all__ = ["soup_surface"]
