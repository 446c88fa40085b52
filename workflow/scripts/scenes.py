"""Make what the page's view turns and cuts: maps and channels of a few shapes."""

from pathlib import Path

from gipkg.descriptors.operators import Operators
from gipkg.files import write_json
from gipkg.progress import progress
from gipkg.reporting.page.scene import Scene, as_data
from gipkg.shards import Shard

import job
from meshes import mesh_of

job.start(snakemake)
plugins = job.plugins(snakemake.params.plugins)
scenes = []
subjects = list(zip(snakemake.params.shapes, snakemake.input, strict=True))
for subject, path in progress(subjects, "page/scenes"):
    surface = Shard.open(Path(path))[subject["shape"]]
    mesh = mesh_of(surface)
    operators = Operators(mesh, snakemake.params.eigenpairs, mask=surface["mask"])
    spheres, channels = {}, {}
    for (kind, name), plugin in plugins.items():
        if kind == "parametrizer":
            spheres[name] = plugin.parametrize(mesh)
        elif kind == "descriptor":
            values = plugin.describe(mesh, operators)
            columns = zip(plugin.channels(), values.T, strict=True)
            channels |= {f"{name}: {channel}": column for channel, column in columns}
    channels["topological mask"] = surface["mask"]
    note = plugins["dataset", subject["database"]].summary
    scenes.append(as_data(Scene(subject["shape"], note, mesh, spheres, channels)))
write_json(Path(snakemake.output[0]), scenes)
