"""Make what the page's view turns and cuts: maps and channels of a few shapes."""

from pathlib import Path

from gipkg.descriptors.operators import Operators
from gipkg.errors import GipkgError
from gipkg.files import write_json
from gipkg.progress import progress
from gipkg.reporting.page.scene import Scene, as_data

import job
from meshes import mesh_of
from subject import read_surface

job.start(snakemake)
plugins = job.plugins(snakemake.params.plugins)
scenes = []
for number, shape in progress(list(enumerate(snakemake.params.shapes)), "page/scenes"):
    surface = read_surface(snakemake, number, section="page.shapes")
    mesh = mesh_of(surface)
    operators = Operators(mesh, snakemake.params.eigenpairs, mask=surface["mask"])
    database = plugins["dataset", snakemake.params.databases[number]]
    note, upright = [database.summary], database.upright is not None
    spheres, channels = {}, {}
    for (kind, name), plugin in plugins.items():
        if kind == "parametrizer":
            try:
                spheres[name] = plugin.parametrize(mesh)
            except GipkgError as error:
                note.append(f"{name} gives no map: {error}")
        elif kind == "descriptor":
            values = plugin.describe(mesh, operators)
            columns = zip(plugin.channels(), values.T, strict=True)
            channels |= {f"{name}: {channel}": column for channel, column in columns}
    channels["topological mask"] = surface["mask"]
    scenes.append(as_data(Scene(shape, "; ".join(note), mesh, spheres, channels, upright)))
write_json(Path(snakemake.output[0]), scenes, sealed=True)
