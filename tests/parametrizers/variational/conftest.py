import numpy as np
import pytest
import trimesh

from gipkg.parametrizers.hierarchy.embedding import embed
from gipkg.parametrizers.variational.energy import MapEnergy
from gipkg.surfaces.angles import corner_cotangents
from gipkg.surfaces.areas import face_areas
from tests.support.shapes import urchin


@pytest.fixture(scope="package")
def problem() -> tuple[MapEnergy, np.ndarray]:
    """Energy of a limbed mesh's maps, all faces weighed alike, and a bijective start."""
    return _problem(urchin(12, 6.0))


@pytest.fixture(scope="package")
def small_problem() -> tuple[MapEnergy, np.ndarray]:
    """The same on a fourth of the vertices."""
    return _problem(urchin(12, 6.0, subdivisions=3))


def _problem(mesh: trimesh.Trimesh) -> tuple[MapEnergy, np.ndarray]:
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int64)
    areas, cotangents = face_areas(vertices, faces), corner_cotangents(vertices, faces)
    targets = areas * 4 * np.pi / areas.sum()
    weights = np.full(len(faces), targets.mean())
    energy = MapEnergy(faces, targets, weights, cotangents, 1e-2, np.zeros(len(faces)))
    return energy, embed(vertices, faces, targets)
