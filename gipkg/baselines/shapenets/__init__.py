"""3DShapeNets: a convolutional deep belief network on solids made of voxels."""
