from __future__ import annotations

import numpy as np
import pytest
import trimesh

from gipkg import describe
from gipkg.descriptors.modes import modes_at_unit_area
from gipkg.descriptors.operators import Operators
from gipkg.errors import UnsupportedMesh


@pytest.mark.parametrize("factor", [1.0, 7.0])
def test_modes_are_those_of_the_surface_at_unit_area(
    pebble: trimesh.Trimesh, factor: float
) -> None:
    mesh = pebble.copy().apply_scale(factor)
    operators = Operators(mesh, 12)
    eigenvalues, squares = modes_at_unit_area(operators.spectrum)
    np.testing.assert_allclose(operators.spectrum.mass @ squares, operators.spectrum.mass.sum())
    of_unit_area = pebble.copy().apply_scale(pebble.area**-0.5)
    expected, same = modes_at_unit_area(Operators(of_unit_area, 12).spectrum)
    np.testing.assert_allclose(eigenvalues, expected, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(squares, same, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("descriptor", ["hks", "si-hks", "wks", "gms"])
def test_one_eigenpair_alone_may_be_a_part_of_an_eigenspace(
    pebble: trimesh.Trimesh, descriptor: str
) -> None:
    with pytest.raises(UnsupportedMesh, match="compute more eigenpairs"):
        describe(pebble, descriptor, Operators(pebble, 1))
