"""``gipkg distort``: what spherical maps do to areas."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import click

from gipkg.cli._batch import Facts, counted, for_each, joined
from gipkg.cli._inputs import PREPARE, preparation, read_map, repairs
from gipkg.cli._options import files_argument, json_option
from gipkg.cli._plugins import assigned, build, method_option, parameter_option, resolve


@click.command()
@files_argument("MESH_OR_MAP")
@method_option
@parameter_option
@json_option
def command(
    files: tuple[Path, ...], method: str, parameters: tuple[str, ...], as_json: bool
) -> None:
    """Measure the area distortion of spherical maps.

    Of a map by gipkg parametrize, or of any mesh, which is repaired and mapped first. Both
    surfaces are scaled to the area 4 pi; deviations are of sphere area over mesh area.
    """
    name = resolve("parametrizer", method)
    chosen = assigned(parameters, [name, PREPARE])
    parametrizer = build("parametrizer", name, chosen[name])
    options = preparation(chosen[PREPARE])

    def work(path: Path) -> Facts:
        from gipkg.evaluation.distortion import distortion

        spherical_map, _, facts = read_map(path, parametrizer, options)
        measured = distortion(spherical_map)
        values = {field.name: getattr(measured, field.name) for field in fields(measured)}
        return {**facts, **{key: x for key, x in values.items() if isinstance(x, int | float)}}

    for_each("distort", files, work, say=_say, as_json=as_json)


def _say(facts: Facts) -> str:
    return joined(
        counted(facts["flips"], "flipped face"),
        f"deviation {facts['face_std']:.2e} over faces",
        f"{facts['vertex_std']:.2e} over vertices",
        f"variance of areas {facts['variance']:.2e}",
        f"degree {facts['degree']:.6g}",
        repairs(facts),
    )
