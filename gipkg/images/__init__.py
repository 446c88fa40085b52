"""Spherical map and channels to geometry images, and images back to meshes.

:mod:`.cuts` says where the octahedron is opened, :mod:`.lookup` makes images and
:mod:`.reconstruct` surfaces, :mod:`.padding` continues an image beyond its border.
"""
