"""What can be chosen about a network and its training: plain data, checked, without torch.

The supplement that fixed the architecture was never published. Section 5 of the paper gives
three convolutions, a fully connected layer of 48, a softmax, no padding inside and 30 epochs;
the rest is our choice and stands here as defaults, chosen on splits of training parts of SHREC'11
and McGill (``docs/choices.md``).

As in the paper, with the raw HKS, is ``pooling="local"``, ``batch_normalisation=False`` and 30
``epochs`` of ``sgd`` at 0.01 in ``steps`` with a ``weight_decay`` of 1e-4, and ``scaling="joint"``.
What the paper leaves open there follows the same authors' SurfNet (Sinha, Unmesh, Huang & Ramani,
CVPR 2017).
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, PositiveInt

Block = Annotated[tuple[PositiveInt, ...], Field(min_length=1)]
Precision = Literal["auto", "float32", "bfloat16"]


class NetworkConfig(BaseModel):
    """Convolutions in blocks, one fully connected layer, softmax."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    blocks: tuple[Block, ...] = Field(
        default=((24,), (48,), (96,)),
        min_length=1,
        description="Output channels of the convolutions; between blocks, pixels are pooled two by "
        "two. The first convolution is of 5 x 5 pixels, two apart, the others of 3 x 3.",
    )
    pooling: Literal["local", "average", "average+maximum"] = Field(
        default="average+maximum",
        description="What follows the last block: the maximum of two by two pixels, as between "
        "blocks; or the average of all pixels, or their average and their maximum, which keep "
        "nothing of where on the sphere something is.",
    )
    features: int = Field(
        default=48, ge=2, description="Width of the fully connected layer, the retrieval signature."
    )
    together: int = Field(
        default=1,
        ge=1,
        description="1: every view of a shape is judged by itself, and their judgements are "
        "averaged. More: the network pools so many views of a shape while it learns, and all of "
        "them when it predicts.",
    )
    unit_signatures: bool = Field(
        default=False,
        description="Scale the signature of a shape to length 1, so that retrieval goes by its "
        "direction alone.",
    )
    margin: int = Field(
        default=4,
        ge=0,
        description="Pixels by which an image is continued on each side through its own "
        "symmetry before it enters the network: 56 becomes 64.",
    )
    batch_normalisation: bool = Field(
        default=True, description="Normalise the activations of every layer over the batch."
    )
    dropout: float = Field(
        default=0.0,
        ge=0.0,
        lt=1.0,
        description="Share of the input of the fully connected layer dropped.",
    )


class TrainingConfig(BaseModel):
    """How the network is trained; no run chooses anything in it by a test part."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    epochs: int = Field(
        default=4,
        ge=1,
        description="Passes over all views of all training shapes, in random order.",
    )
    minimum_steps: int = Field(
        default=500, ge=1, description="Least number of steps, for training parts of a few shapes."
    )
    batch_size: int = Field(default=64, ge=2, description="Images a step.")
    optimiser: Literal["adamw", "sgd"] = Field(
        default="adamw", description="AdamW, or stochastic gradient descent with momentum 0.9."
    )
    learning_rate: float = Field(default=3e-3, gt=0, le=1, description="Highest learning rate.")
    schedule: Literal["one-cycle", "steps"] = Field(
        default="one-cycle",
        description="A linear rise over the first tenth and a cosine to zero, or four equal "
        "parts each at a tenth of the rate before.",
    )
    weight_decay: float = Field(default=1e-2, ge=0, description="Weight decay of the optimiser.")
    label_smoothing: float = Field(
        default=0.0,
        ge=0.0,
        lt=1.0,
        description="Share of the target spread evenly over all classes.",
    )
    mirror: bool = Field(
        default=False,
        description="Show every other sample mirrored, all of its images: those of the mirrored "
        "shape. Only for channels that a mirror leaves unchanged, such as the HKS.",
    )
    scaling: Literal["channel", "joint"] = Field(
        default="channel",
        description="Give every channel mean 0 and deviation 1 over the training part, or all "
        "channels together, which keeps their proportions.",
    )
    shuffle_pixels: bool = Field(
        default=False,
        description="A control: one random permutation of the pixels, the same for all images, "
        "leaves the values of an image and destroys its layout.",
    )
    precision: Precision = Field(
        default="auto",
        description="Arithmetic of the training; auto is bfloat16 where the processor has "
        "instructions for it, else float32. Prediction is always in float32.",
    )
    threads: int = Field(default=1, ge=1, description="Processor threads of the training.")
