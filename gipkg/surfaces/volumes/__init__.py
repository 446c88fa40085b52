"""Solids given by voxels to closed genus-0 surfaces, of genus 0 by construction."""

from gipkg.surfaces.volumes.assembly import volume_surface

__all__ = ["volume_surface"]
