"""Geometry of maps to the unit sphere: areas, orientation, tangent planes."""
