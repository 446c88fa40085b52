"""3DShapeNets as a baseline: solids in many rotations, pre-trained without labels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PositiveInt

from gipkg.api import Baseline, BaselineTags
from gipkg.baselines.shapenets.bits import pack
from gipkg.baselines.upright import Upright, stand
from gipkg.baselines.voxels import turned_solids

if TYPE_CHECKING:
    from pathlib import Path

    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction

SIZE = 30
EXTENT = 24
"""Voxels along the longest side of a shape, in a grid of 30."""
KERNELS = (6, 5, 4)
STRIDES = (2, 2, 1)
MINIMUM_STEPS = (60, 200)
"""Least number of steps of each layer's pre-training, and of the training after it."""


class ShapeNets(Baseline):
    """A convolutional deep belief network on the voxels of the solid, in rotations.

    Three convolutional and two fully connected restricted Boltzmann machines are trained one
    after the other, without labels, by contrastive divergence. A softmax on top of the last then
    learns the classes, and with it all layers. In the end the rotations of a shape vote: their
    class probabilities are averaged, and so are the activations of the top layer, its signature,
    compared by the L2 distance.

    Grids, layers, kernels, strides, biases shared by a feature map, contrastive divergence of one
    step with mean-field reconstructions, momentum, weight decay, sparsity, batches, and that a
    filter learns only where there is something under it, are those of the paper or of its
    authors' program. What is not:

    - Layers are a quarter as wide. Those published are ``maps: [48, 160, 512]`` and
      ``widths: [1200, 4000]``. On one core a step of them takes five times as long as one of a
      quarter, and as many steps as fit into minutes teach them less: after 60 at a rate of 20
      their reconstructions were not yet better than the mean of the data, those of a quarter
      have half its error.
    - The original takes 15 to 150 passes over tens of thousands of grids for every layer. Here it
      is one, or 60 steps. So the visible biases start at the log odds of the first batch, and the
      rate is in proportion to what a step can bear. Without this pre-training the training after
      it stayed at chance (inside a training part of McGill, where all this was chosen).
    - The labels are no visible units of the top layer, and nothing is fine-tuned by wake-sleep,
      which the authors call dispensable.
    - The last training is AdamW with one rise and fall of the rate, not 100 passes of gradient
      descent at 0.1; every other grid is mirrored.
    - The paper speaks of 4000 top features. In its authors' program the softmax replaces that
      layer and stands on the 1200 below: leave the last of `widths` out for that.

    The original knows which way is up. Databases of non-rigid shapes do not, so by default the
    longest principal axis of the solid stands upright, its heavier tail above.
    """

    summary: ClassVar[str] = "3DShapeNets: a convolutional deep belief network on voxels"
    citation: ClassVar[str] = (
        "Z. Wu, S. Song, A. Khosla, F. Yu, L. Zhang, X. Tang, J. Xiao: 3D ShapeNets: A Deep "
        "Representation for Volumetric Shapes. CVPR 2015"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(scale_invariant=True)

    upright: Upright = "principal"
    rotations: int = Field(
        12, ge=2, le=72, multiple_of=2, description="Number of rotations about the upright axis"
    )
    maps: tuple[PositiveInt, PositiveInt, PositiveInt] = Field(
        (12, 40, 128), description="Feature maps of the three convolutional layers"
    )
    widths: tuple[PositiveInt, ...] = Field(
        (300, 1000), min_length=1, description="Units of the fully connected layers"
    )
    gibbs_steps: int = Field(
        1, ge=1, le=100, description="Steps of Gibbs sampling in contrastive divergence (k of CD-k)"
    )
    pretraining_epochs: float = Field(
        1, ge=0, le=1000, description="Passes over all rotations of all training shapes, each layer"
    )
    pretraining_rate: float = Field(
        30,
        gt=0,
        le=1000,
        description="Its learning rate, divided in each layer by the mean squared norm of what a "
        "unit sees and is seen by",
    )
    epochs: int = Field(
        4, ge=1, le=1000, description="Passes over the same, with labels, all layers together"
    )
    learning_rate: float = Field(2e-3, gt=0, le=1, description="Its highest learning rate")

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.uint8]:
        """Voxelise every rotation; (rotations, 30, 30, 4), packed; `operators` are not used.

        Raises
        ------
        UnsupportedMesh
            The mesh encloses no positive volume.
        """
        return pack(turned_solids(stand(mesh, self.upright), self.rotations, SIZE, EXTENT))

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
        """Pre-train and train on all rotations; embeddings are the activations of the top layer.

        Raises
        ------
        LearningError
            The device is absent, or a training diverged.
        DamagedFileError
            A checkpoint cannot be read.
        """
        import torch

        from gipkg.baselines.shapenets.belief import BeliefNetwork
        from gipkg.baselines.shapenets.network import ShapeNetsNetwork
        from gipkg.baselines.shapenets.pretraining import Pretraining, pretrain
        from gipkg.learning.classifier import train_classifier
        from gipkg.learning.config import TrainingConfig
        from gipkg.learning.device import choose_device, reproducible

        views = torch.from_numpy(np.stack([representations[i] for i in train]))
        before = checkpoint.with_suffix(f".before{checkpoint.suffix}") if checkpoint else None
        chosen = choose_device(device)
        with reproducible(chosen, threads=1):
            torch.manual_seed(seed)
            maps = tuple(zip(self.maps, KERNELS, STRIDES, strict=True))
            belief = BeliefNetwork(SIZE, maps, self.widths).to(chosen)
            pretraining = Pretraining(
                self.pretraining_epochs, MINIMUM_STEPS[0], self.pretraining_rate, self.gibbs_steps
            )
            pretrain(belief, views, SIZE, pretraining, seed, before)
        classifier = train_classifier(
            lambda classes: ShapeNetsNetwork(belief, SIZE, classes),
            views,
            tuple(train.values()),
            training=TrainingConfig(
                epochs=self.epochs,
                minimum_steps=MINIMUM_STEPS[1],
                batch_size=32,
                learning_rate=self.learning_rate,
                mirror=True,
            ),
            seed=seed,
            device=device,
            checkpoint=checkpoint,
        )
        if before is not None:
            before.unlink(missing_ok=True)
        return classifier.predict(lambda shape_id: torch.tensor(representations[shape_id]), test)
