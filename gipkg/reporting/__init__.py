"""Figures to the paper's tables, their notes and their provenance."""
