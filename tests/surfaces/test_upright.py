from __future__ import annotations

import numpy as np
import pytest

from gipkg.surfaces.upright import with_z_up


@pytest.mark.parametrize("up", ["x", "y", "z"])
def test_the_upright_axis_becomes_z_by_a_rotation(up: str) -> None:
    turned = with_z_up(np.eye(3), up)
    assert turned["xyz".index(up)].tolist() == [0, 0, 1]
    assert np.linalg.det(turned) == pytest.approx(1)
