"""Any mesh to a closed, oriented genus-0 surface of one component."""

from gipkg.surfaces.preparation import Surface, prepare
from gipkg.surfaces.reading import load_mesh
from gipkg.surfaces.report import Report
from gipkg.surfaces.validation import check_genus_zero

__all__ = ["Report", "Surface", "check_genus_zero", "load_mesh", "prepare"]
