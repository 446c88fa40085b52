"""Search for shapes by their signatures: what a trained network makes of their geometry images.

An index holds the signatures of a folder of meshes together with the network that made them, so
that a query is shown to the same network, by the same surface, map, channels and cuts.
"""
