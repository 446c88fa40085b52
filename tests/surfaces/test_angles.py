from __future__ import annotations

import numpy as np
import pytest

from gipkg.surfaces.angles import corner_cotangents
from tests.surfaces.solids import torus


def test_cotangents_are_those_of_the_angles():
    mesh = torus()
    cotangents = corner_cotangents(mesh.vertices, mesh.faces)
    assert np.arctan2(1, cotangents) == pytest.approx(mesh.face_angles)
