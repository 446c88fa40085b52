"""DeepPano: a panorama from the upright axis, and a network that no turn about it changes."""
