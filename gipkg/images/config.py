"""What can be chosen about the geometry images of a shape: plain data, checked."""

from __future__ import annotations

import zlib
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field
from scipy.spatial.transform import Rotation

from gipkg.api import SphericalMap
from gipkg.images.cuts import UPRIGHT_TURNS, random_cuts, standard_cuts, upright_cuts
from gipkg.images.sampling import Sampling


class ImageConfig(BaseModel):
    """Size and cuts of the images, one image for each cut."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    size: int = Field(default=56, ge=3, description="Pixels along a side.")
    sampling: Sampling = Field(default="equal-area", description="How the square wraps the sphere.")
    cuts: Literal["standard", "random", "upright"] = Field(
        default="standard",
        description="The paper's 36 cuts; 36 random ones, others for each shape; or those of "
        "shapes whose z axis is up: turns about the pole above the centroid.",
    )
    turns: int = Field(default=UPRIGHT_TURNS, ge=1, description="Number of the upright cuts.")
    azimuth: Literal["pose", "unknown"] = Field(
        default="unknown",
        description="Where the turns of the upright cuts begin: at the azimuth in which the shape "
        "is posed, or at a random one for each shape, as if nothing were known of it.",
    )

    def choose(self, spherical_map: SphericalMap, shape_id: str) -> Rotation:
        """Return the cuts of a shape; what is random about them depends on its name alone."""
        if self.cuts == "standard":
            return standard_cuts()
        rng = np.random.default_rng(zlib.crc32(shape_id.encode()))
        if self.cuts == "random":
            return random_cuts(len(standard_cuts()), rng)
        azimuth = 0.0 if self.azimuth == "pose" else rng.uniform(0, 2 * np.pi)
        return upright_cuts(spherical_map, self.turns, azimuth)
