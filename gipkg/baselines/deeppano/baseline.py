"""DeepPano as a baseline."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PositiveInt

from gipkg.api import Baseline, BaselineTags
from gipkg.baselines.corners import about_area_centroid, in_unit_ball
from gipkg.baselines.upright import Upright, stand

if TYPE_CHECKING:
    from pathlib import Path

    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction

ROWS = 64
COLUMNS = 160
MINIMUM_STEPS = 100
"""Least number of steps, for training parts of a few shapes."""


class DeepPano(Baseline):
    """A network on the panorama of a shape, seen from its upright axis.

    The axis goes through the area-weighted centroid. A pixel is the distance from it to the
    farthest point of the surface at one height in one direction, 0 where there is none. Heights
    and distances are in units of the distance of the farthest vertex from the centroid, so that a
    panorama keeps the proportions of its shape; the size of the original's cylinder is not
    published with its code.

    Turning the shape about the axis shifts the columns. Every convolution goes on across the
    border, which the original has an extended map for, and after the last the greatest value of
    every row is kept. Pooling leaves open shifts by less than 16 columns: while the network
    learns, shifts are random, and in the end all 16 are averaged. So no turn by whole columns
    changes a prediction or a signature.

    Of the original's network the outline is public: four convolutions with pooling, the row-wise
    maxima, fully connected layers, a softmax. Numbers of maps, kernels, dropout, size of the
    panorama and training are ours, small enough for a processor, and so is that half of the
    panoramas are learned from mirrored.

    The original knows which way is up. Databases of non-rigid shapes do not, so by default the
    longest principal axis of the solid stands upright, its heavier tail above.
    """

    summary: ClassVar[str] = "DeepPano: panorama around the upright axis, row-wise maximum pooling"
    citation: ClassVar[str] = (
        "B. Shi, S. Bai, Z. Zhou, X. Bai: DeepPano: Deep Panoramic Representation for 3-D Shape "
        "Recognition. IEEE Signal Processing Letters 22(12), 2015"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(scale_invariant=True)

    upright: Upright = "principal"
    maps: tuple[PositiveInt, PositiveInt, PositiveInt, PositiveInt] = Field(
        (32, 64, 128, 256), description="Feature maps of the four convolutions"
    )
    features: int = Field(256, ge=2, description="Width of the fully connected layer")
    epochs: int = Field(60, ge=1, le=1000, description="Passes over all training shapes")
    learning_rate: float = Field(1e-3, gt=0, le=1, description="Highest learning rate")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.uint8]:
        """Draw the panorama; (64, 160), 255 for the unit of length; `operators` are not used.

        Raises
        ------
        UnsupportedMesh
            A principal axis is to stand upright, but the mesh encloses no positive volume.
        """
        from gipkg.baselines.deeppano.panorama import farthest_intersections

        corners, _ = about_area_centroid(stand(mesh, self.upright))
        depth = farthest_intersections(in_unit_ball(corners), ROWS, COLUMNS)
        return np.rint(255 * depth).astype(np.uint8)

    def predict(
        self,
        representations: Mapping[str, NDArray[Any]],
        train: Mapping[str, str],
        test: Sequence[str],
        *,
        seed: int = 0,
        device: str = "auto",
        checkpoint: Path | None = None,
    ) -> Prediction:
        """Train the network; embeddings are the activations of its fully connected layer.

        Raises
        ------
        LearningError
            The device is absent, or the training diverged.
        DamagedFileError
            The checkpoint cannot be read.
        """
        import torch

        from gipkg.baselines.deeppano.network import PanoramaNetwork, every_shift
        from gipkg.learning.classifier import train_classifier
        from gipkg.learning.config import TrainingConfig

        classifier = train_classifier(
            lambda classes: PanoramaNetwork(ROWS, COLUMNS, self.maps, self.features, classes),
            torch.from_numpy(np.stack([representations[i] for i in train])[:, None, :, :, None]),
            tuple(train.values()),
            training=TrainingConfig(
                epochs=self.epochs,
                minimum_steps=MINIMUM_STEPS,
                batch_size=32,
                learning_rate=self.learning_rate,
            ),
            seed=seed,
            device=device,
            checkpoint=checkpoint,
        )
        return classifier.predict(
            lambda i: every_shift(torch.tensor(representations[i])[None, :, :, None]), test
        )
