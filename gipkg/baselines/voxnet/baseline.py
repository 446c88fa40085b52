"""VoxNet as a baseline: solids in many rotations, which vote."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Baseline, BaselineTags
from gipkg.baselines.upright import Upright, stand
from gipkg.baselines.voxels import turned_solids

if TYPE_CHECKING:
    from pathlib import Path

    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction

SIZE = 32
EXTENT = 24
"""Voxels along the longest side of a shape, in a grid of 32: the margin is for shifts."""


class VoxNet(Baseline):
    """A network on the voxels of the solid, in rotations about the upright axis.

    While it learns, every rotation is a sample of its own, shifted by up to two voxels and, every
    other time, mirrored. In the end the rotations of a shape vote: their class probabilities are
    averaged, and so are the activations of the layer of 128, its signature.

    The original knows which way is up. Databases of non-rigid shapes do not, so by default the
    longest principal axis of the solid stands upright, its heavier tail above.

    The network, its dropout, momentum, weight decay and batches are the original's. Its rate of
    0.001, lowered in stages, takes 80 epochs of tens of thousands of grids. Here one rise and fall
    of a higher rate does in a few epochs of a few hundred shapes, on a processor. Steps and rate
    were tried inside a training part of McGill; twice the rate was a little better there, but is
    not taken, since a training with it stayed at chance.
    """

    summary: ClassVar[str] = "VoxNet: a 3D convolutional network on voxels, with votes of rotations"
    citation: ClassVar[str] = (
        "D. Maturana, S. Scherer: VoxNet: A 3D Convolutional Neural Network for Real-Time Object "
        "Recognition. IROS 2015"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(scale_invariant=True)

    upright: Upright = "principal"
    rotations: int = Field(
        12, ge=2, le=72, multiple_of=2, description="Number of rotations about the upright axis"
    )
    epochs: int = Field(
        4, ge=1, le=1000, description="Passes over all rotations of all training shapes"
    )
    minimum_steps: int = Field(
        400, ge=1, description="Least number of steps, for training parts of a few hundred shapes"
    )
    learning_rate: float = Field(0.01, gt=0, le=1, description="Highest learning rate")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.bool_]:
        """Voxelise every rotation; (rotations, 32, 32, 32). `operators` are not used.

        Raises
        ------
        UnsupportedMesh
            The mesh encloses no positive volume.
        """
        return turned_solids(stand(mesh, self.upright), self.rotations, SIZE, EXTENT)

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
        """Train the network on all rotations; embeddings are the activations of its layer of 128.

        Raises
        ------
        LearningError
            The device is absent, or the training diverged.
        DamagedFileError
            The checkpoint cannot be read.
        """
        import torch

        from gipkg.baselines.voxnet.network import VoxelNetwork
        from gipkg.learning.classifier import train_classifier
        from gipkg.learning.config import TrainingConfig

        # The layers of a grid take the place of the channels of an image.
        classifier = train_classifier(
            lambda classes: VoxelNetwork(SIZE, classes),
            torch.from_numpy(np.stack([representations[i] for i in train])),
            tuple(train.values()),
            training=TrainingConfig(
                epochs=self.epochs,
                minimum_steps=self.minimum_steps,
                batch_size=32,
                optimiser="sgd",
                learning_rate=self.learning_rate,
                weight_decay=1e-3,
                mirror=True,
            ),
            seed=seed,
            device=device,
            checkpoint=checkpoint,
        )
        return classifier.predict(lambda shape_id: torch.tensor(representations[shape_id]), test)
