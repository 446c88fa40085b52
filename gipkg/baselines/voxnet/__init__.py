"""VoxNet: a three-dimensional convolutional network on solids made of voxels."""
