"""Files that people pass around: meshes, spherical maps, channels and geometry images.

Every format is a suffix. What is written appears whole or not at all; what is read is data,
never code, and takes no more memory than the file's size warrants.
"""

MESH_SUFFIXES = (".ply", ".off", ".obj", ".stl", ".glb")
"""The first three keep every coordinate to the last bit; STL and GLB have single precision, and
STL no vertices that triangles share."""

MAP_SUFFIXES = (".npz", ".ply")
"""A PLY shows the sphere in any viewer; the mesh is in further properties of its vertices."""

CHANNEL_SUFFIXES = (".npy", ".csv")
"""One row a vertex; the CSV has a header."""

IMAGE_SUFFIXES = (".npy", ".tiff", ".png")
"""``.npy`` is exact. ``.tiff`` has single precision and opens in image programs. ``.png`` has one
or three channels, each spread over 16 bits; the range that it was spread from is in the file."""
