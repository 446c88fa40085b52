"""Geometry of maps to the unit sphere: areas and their residuals, orientation, tangent planes."""
