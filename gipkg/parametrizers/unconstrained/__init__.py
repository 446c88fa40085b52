"""Spherical energies that need no constraint, and their minimisation."""
