"""Maps of least distortion: an energy, its descent, and exact areas at the end."""
