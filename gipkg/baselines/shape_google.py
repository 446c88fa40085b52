"""ShapeGoogle: a surface as a bag of the words that its points say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Baseline, BaselineTags
from gipkg.baselines.svm import classify
from gipkg.baselines.vocabulary import learn_vocabulary
from gipkg.descriptors.hks import HeatKernelSignature
from gipkg.descriptors.si_hks import ScaleInvariantHKS

if TYPE_CHECKING:
    from pathlib import Path

    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction

SCALES = 6
"""Numbers that describe a point, as in the original."""


class ShapeGoogle(Baseline):
    """Bag of words over a vocabulary of point signatures, learned from the training part.

    Every point is assigned to all words, softly: θ(x) ∝ exp(-|p(x) - p_i|² / 2σ²). The bag is
    the mean of θ over the surface. The spatially sensitive bag counts pairs of words by how near
    they are said, (∫∫ θ(x) θ(y)ᵀ K_t(x, y) dx dy), with the heat kernel K_t. The latter is what
    the paper compares with: its features are "1/50th the size", which is 48 to 48 x 48.

    The original takes the heat kernel signature as it is, at times in units of the database's
    coordinates. Here it is logarithmic, at times in units of the area, and every number of it is
    standardised by the training points, so that all of them count alike.
    """

    summary: ClassVar[str] = "ShapeGoogle: bags of heat kernel words, spatially sensitive"
    citation: ClassVar[str] = (
        "A. Bronstein, M. Bronstein, L. Guibas, M. Ovsjanikov: Shape Google: Geometric Words and "
        "Expressions for Invariant Shape Retrieval. ACM Transactions on Graphics 30(1), 2011"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    signature: Literal["hks", "si-hks"] = Field(
        "hks",
        description="What describes a point: the heat kernel signature, logarithmic, or "
        "its scale-invariant form",
    )
    words: int = Field(48, ge=2, le=200, description="Size of the vocabulary")
    spatially_sensitive: bool = Field(
        True, description="Count pairs of words that are said near each other, not single words"
    )
    time: float = Field(
        0.01, gt=0, le=1, description="What is near: time of the heat kernel, in units of the area"
    )
    modes: int = Field(60, ge=1, le=1000, description="Number of modes of that heat kernel")
    softness: float = Field(
        2.0, gt=0, le=100, description="σ of the assignment, in radii of the median word"
    )

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float32]:
        """Describe every point; (V, 1 + 6) or (V, 1 + 6 + modes).

        The columns are the share of the area, the signature, and the heat kernel's factors f
        with K_t(x, y) = f(x) · f(y).
        """
        spectrum = operators.spectrum
        area = spectrum.mass.sum()
        columns = [spectrum.mass[:, None] / area, self._descriptor().describe(mesh, operators)]
        if self.spatially_sensitive:
            decay = np.exp(-area * spectrum.eigenvalues[: self.modes] * self.time / 2)
            factors = np.zeros((len(spectrum.mass), self.modes))
            factors[:, : len(decay)] = spectrum.eigenvectors[:, : self.modes] * decay
            columns.append(factors * np.sqrt(area))
        return np.hstack(columns).astype(np.float32)

    def _descriptor(self) -> HeatKernelSignature | ScaleInvariantHKS:
        if self.signature == "hks":
            return HeatKernelSignature(times=SCALES)
        return ScaleInvariantHKS(frequencies=SCALES)

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
        """Learn the vocabulary, then classify the bags by a linear support vector machine.

        Embeddings are the bags. `device` and `checkpoint` are not used.
        """
        points = {i: representations[i][:, : 1 + SCALES].astype(np.float64) for i in train}
        vocabulary = learn_vocabulary(points, self.words, self.softness, seed)
        bags = {}
        for shape_id in (*train, *test):
            share, signatures, factors = np.split(
                representations[shape_id].astype(np.float64), [1, 1 + SCALES], axis=1
            )
            said = share * vocabulary.assign(signatures)
            if self.spatially_sensitive:
                near = said.T @ factors
                bags[shape_id] = (near @ near.T).ravel()
            else:
                bags[shape_id] = said.sum(axis=0)
        return classify(bags, train, test, seed=seed)
