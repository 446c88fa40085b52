"""Semi-discrete optimal transport of the sphere's area to weighted points on it."""
