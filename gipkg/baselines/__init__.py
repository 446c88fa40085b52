"""Mesh to one representation a shape, and the classifier that goes with it."""
