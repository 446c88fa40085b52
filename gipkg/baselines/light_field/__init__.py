"""Light-field descriptor: a shape as its silhouettes from all around."""
