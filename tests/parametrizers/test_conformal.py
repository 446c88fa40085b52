"""The conformal map is centred; its angles are held in test_maps.py and the conformance suite."""

import numpy as np
import pytest

from gipkg.parametrizers import parametrize
from tests.support.shapes import ellipsoid, urchin


@pytest.mark.parametrize("mesh", [urchin(12, 4.0), urchin(3, 2.0, 3), ellipsoid(1, 2, 5)])
def test_the_mass_centre_of_the_surface_lies_at_the_origin(mesh) -> None:
    sphere = parametrize(mesh, "conformal").sphere
    centre = mesh.area_faces @ sphere[mesh.faces].mean(axis=1) / mesh.area
    assert np.linalg.norm(centre) < 1e-12
