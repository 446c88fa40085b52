"""The bijective start of every map: coarsen to a tetrahedron, refine that on the sphere."""
