"""The baseline that compares and classifies shapes by their silhouettes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from gipkg.api import Baseline, BaselineTags
from gipkg.baselines.corners import about_area_centroid, in_unit_ball
from gipkg.baselines.light_field.cameras import directions
from gipkg.baselines.light_field.distance import pairwise_distances, quantise
from gipkg.baselines.light_field.features import silhouette_features
from gipkg.baselines.light_field.silhouettes import silhouette
from gipkg.baselines.svm import classify

if TYPE_CHECKING:
    from pathlib import Path

    import trimesh

    from gipkg.descriptors.operators import Operators
    from gipkg.learning.prediction import Prediction


class LightField(Baseline):
    """Silhouettes from the vertices of ten dodecahedra, 47 features each.

    Retrieval takes the least distance over 5,460 relative rotations. A linear classifier needs a
    vector instead.
    """

    summary: ClassVar[str] = "Light-field descriptor: features of silhouettes from all around"
    citation: ClassVar[str] = (
        "D.-Y. Chen, X.-P. Tian, Y.-T. Shen, M. Ouhyoung: On Visual Similarity Based 3D Model "
        "Retrieval. Computer Graphics Forum 22(3) (Eurographics), 2003"
    )
    tags: ClassVar[BaselineTags] = BaselineTags(rigid_invariant=True, scale_invariant=True)

    vector: Literal["statistics", "concatenated"] = Field(
        "statistics",
        description="What is classified: mean and deviation of each feature over the views, "
        "which a rotation hardly changes, or the features of all views one after the other",
    )

    def represent(self, mesh: trimesh.Trimesh, operators: Operators) -> NDArray[np.float32]:
        """Measure every silhouette; (10, 10, 47); `operators` are not used."""
        corners, _ = about_area_centroid(mesh)
        corners = in_unit_ball(corners)
        systems, views = directions().shape[:2]
        features = [
            silhouette_features(silhouette(corners, direction))
            for direction in directions().reshape(-1, 3)
        ]
        return np.reshape(features, (systems, views, -1)).astype(np.float32)

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
        """Classify by a linear support vector machine, compare by the least distance.

        Embeddings are the vectors classified. `device` and `checkpoint` are not used.
        """
        vectors = {i: self._vector(representations[i]) for i in (*train, *test)}
        quantised = np.stack([quantise(representations[i]) for i in test])
        prediction = classify(vectors, train, test, seed=seed)
        return replace(prediction, distances=pairwise_distances(quantised))

    def _vector(self, features: NDArray[np.float32]) -> NDArray[np.float64]:
        views = features.reshape(-1, features.shape[-1]).astype(np.float64)
        if self.vector == "concatenated":
            return views.ravel()
        return np.concatenate([views.mean(axis=0), views.std(axis=0)])
