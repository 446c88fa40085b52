"""Any mesh or volume to a closed, oriented genus-0 surface of one component."""

from gipkg.surfaces.preparation import prepare
from gipkg.surfaces.report import Report
from gipkg.surfaces.surface import Surface
from gipkg.surfaces.validation import check_genus_zero
from gipkg.surfaces.volumes import volume_surface

__all__ = ["Report", "Surface", "check_genus_zero", "prepare", "volume_surface"]
