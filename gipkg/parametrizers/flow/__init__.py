"""Flows that even out areas: potentials on a surface, and vertices carried along gradients."""
