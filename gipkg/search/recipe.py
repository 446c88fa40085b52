"""From a mesh to the geometry images that a network learned from, as the workflow makes them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import trimesh
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from threadpoolctl import threadpool_limits

from gipkg import registry
from gipkg.api import Descriptor, Parametrizer, SphericalMap
from gipkg.descriptors.operators import Operators
from gipkg.errors import DamagedFileError, PluginError
from gipkg.images.config import ImageConfig
from gipkg.images.lookup import lookup
from gipkg.registry import Kind
from gipkg.surfaces import prepare
from gipkg.surfaces.upright import with_z_up


class PluginSpec(BaseModel):
    """A plugin by name, with its parameters."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    plugin: str
    target: str | None = None
    """``path/file.py:Class`` of a plugin in one file."""
    parameters: Mapping[str, Any] = Field(default_factory=dict)


class Recipe(ImageConfig):
    """How the workflow made the images; what is not known here is an error, not left out."""

    surface: Mapping[str, Any] = Field(default_factory=dict)
    """Keyword arguments of :func:`gipkg.prepare`."""
    up: Literal["x", "y", "z"] | None = None
    """Axis that is upward in the files; None where shapes stand in any way."""
    parametrizer: PluginSpec
    descriptors: tuple[PluginSpec, ...] = Field(min_length=1)
    eigenpairs: int = Field(ge=1)

    @classmethod
    def of(cls, about: Mapping[str, Any], path: Path) -> Recipe:
        """Read the recipe that the file of a network carries.

        Raises
        ------
        DamagedFileError
            It carries none, or that of another version of gipkg.
        """
        try:
            return cls.model_validate(about.get("images"))
        except ValidationError as error:
            faults = "; ".join(
                f"{'.'.join(map(str, fault['loc'])) or 'images'}: {fault['msg']}"
                for fault in error.errors()
            )
            raise DamagedFileError(
                f"{path}: does not say how its images are made as this version of gipkg reads it "
                f"({faults}); train the network again: snakemake --cores 2 {path}"
            ) from error

    def specs(self) -> tuple[tuple[Kind, PluginSpec], ...]:
        """Return all plugins that take part, with their kinds."""
        return (
            ("parametrizer", self.parametrizer),
            *(("descriptor", descriptor) for descriptor in self.descriptors),
        )


@dataclass(frozen=True)
class ImageMaker:
    """A recipe with its plugins at hand."""

    recipe: Recipe
    parametrizer: Parametrizer
    descriptors: tuple[Descriptor, ...]

    @classmethod
    def of(cls, recipe: Recipe, allowed: Collection[str] = ()) -> ImageMaker:
        """Build the plugins of a recipe.

        Parameters
        ----------
        recipe : Recipe
        allowed : collection of str
            The ``path/file.py:Class`` that may be loaded: a file that names code must not have it
            run unless someone says so.

        Raises
        ------
        PluginError
            A plugin is in a file that is not allowed, cannot be loaded, or does not take its
            parameters.
        """
        for kind, spec in recipe.specs():
            if spec.target is None:
                continue
            if spec.target not in allowed:
                raise PluginError(
                    f"the network learned from images of the {kind} in {spec.target}, whose code "
                    f"is not run unasked; --allow {spec.target} says that you trust it"
                )
            registry.register_local(kind, spec.plugin, spec.target)
        return cls(
            recipe,
            registry.create(
                "parametrizer", recipe.parametrizer.plugin, recipe.parametrizer.parameters
            ),
            tuple(
                registry.create("descriptor", spec.plugin, spec.parameters)
                for spec in recipe.descriptors
            ),
        )

    def code(self) -> tuple[str, ...]:
        """Return the fingerprints of the code that the images depend on, but this module's."""
        return tuple(registry.fingerprint(kind, spec.plugin) for kind, spec in self.recipe.specs())

    def images(self, source: trimesh.Trimesh | Path, name: str = "") -> NDArray[np.float32]:
        """Make the images of a mesh, one for each cut.

        Parameters
        ----------
        source : trimesh.Trimesh or Path
        name : str
            Seed of what is random about the cuts: in the workflow the shape's identifier, here
            the same for all, since a file may have any name.

        Returns
        -------
        (K, C, n, n) float32 array

        Raises
        ------
        MeshFormatError, UnsupportedMesh, ParametrizationError
            As the stages do.
        """
        # As a job of the workflow has one thread: more add up products in another order.
        with threadpool_limits(limits=1):
            return self._images(source, name)

    def _images(self, source: trimesh.Trimesh | Path, name: str) -> NDArray[np.float32]:
        surface = prepare(source, **self.recipe.surface)
        mesh = surface.mesh
        if self.recipe.up is not None:
            turned = with_z_up(np.asarray(mesh.vertices), self.recipe.up)
            mesh = trimesh.Trimesh(turned, mesh.faces, process=False, metadata=mesh.metadata)
        operators = Operators(mesh, self.recipe.eigenpairs, mask=surface.mask)
        channels = np.hstack([one.describe(mesh, operators) for one in self.descriptors])
        spherical_map = SphericalMap(mesh, self.parametrizer.parametrize(mesh))
        cuts = self.recipe.choose(spherical_map, name)
        located = lookup(spherical_map, self.recipe.size, cuts, self.recipe.sampling)
        return located.render(channels)
