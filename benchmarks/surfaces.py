"""What becomes of every mesh of a folder or a database: one row a mesh, whatever it holds.

    python -m benchmarks.surfaces [--map] [--set NAME=VALUE ...] [--database NAME] [PATH ...]

PATH is a mesh, or a folder of which all files are taken; NAME a database under --data. Each mesh is
prepared in a process of its own, which is ended after --seconds and may not take more than
--gigabytes, and what came out is checked by trimesh. Without --map the columns are:

outcome      ``none`` (left as it was), ``repair``, ``volume``, or the name of the error
V            vertices of the surface
genus        of what was given; empty where it has none, being no oriented manifold
mask         share of the vertices that lie on what closes the surface
lost, added  largest distance, in % of the diagonal, from what was given to the surface and back
missing      share, in %, of the area of what was given that is farther than 2 % away
CPU, MB      seconds, and peak memory of the process, libraries included

--map goes on to the sphere and to the geometry image: flipped faces, std of the face areas' ratio,
CPU seconds, and the distance from the image's surface to the prepared one, in % of the diagonal.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import trimesh

import gipkg
from gipkg import registry
from gipkg.errors import GipkgError
from gipkg.evaluation.surface_distance import surface_distance
from gipkg.formats.mesh_reading import read_mesh

COLUMNS = ["outcome", "V", "genus", "mask", "lost", "added", "missing", "CPU", "MB"]
MAP_COLUMNS = ["flips", "face std", "map CPU", "image"]


def sources(arguments: argparse.Namespace) -> Iterator[tuple[str, Callable[[], Any]]]:
    """Yield the name of every mesh and how to load it."""
    for path in arguments.paths:
        files = [path] if path.is_file() else sorted(f for f in path.rglob("*") if f.is_file())
        yield from ((file.name, partial(read_mesh, file)) for file in files)
    if arguments.database:
        database = registry.create("dataset", arguments.database, {})
        for shape in database.shapes(arguments.data):
            yield shape.id, partial(database.load, arguments.data, shape.id)


def row(load: Callable[[], Any], options: dict[str, Any], to_image: bool) -> dict[str, str]:
    """Prepare one mesh and say what came of it."""
    start = time.process_time()
    surface = gipkg.prepare(load(), **options)
    seconds = time.process_time() - start
    report, mesh = surface.report, surface.mesh
    found = {
        "outcome": report.method if is_closed(mesh) else "WRONG",
        "V": f"{len(mesh.vertices)}",
        "genus": f"{getattr(report.before, 'genus', '')}".replace("None", ""),
        "mask": f"{1 - surface.mask.mean():.3f}",
        "CPU": f"{seconds:.1f}",
        "MB": f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f}",
    }
    if apart := report.deviation:
        shown = {"lost": apart.lost, "added": apart.added, "missing": apart.missing}
        found |= {name: f"{100 * value:.2f}" for name, value in shown.items()}
    return found | (through_the_map(mesh) if to_image else {})


def is_closed(mesh: trimesh.Trimesh) -> bool:
    """Check by another library what prepare promises."""
    sphere = mesh.euler_number == 2 and mesh.body_count == 1
    return bool(mesh.is_watertight and mesh.is_winding_consistent and sphere and mesh.volume > 0)


def through_the_map(mesh: trimesh.Trimesh) -> dict[str, str]:
    """Map a surface to the sphere and to an image, and take it back."""
    start = time.process_time()
    spherical_map = gipkg.parametrize(mesh)
    seconds = time.process_time() - start
    distortion = gipkg.distortion(spherical_map)
    image = gipkg.geometry_image(spherical_map, mesh.vertices, size=128)
    again = surface_distance(mesh, gipkg.reconstruct(image), samples=10_000)
    return {
        "flips": f"{distortion.flips}",
        "face std": f"{distortion.face_std:.4f}",
        "map CPU": f"{seconds:.1f}",
        "image": f"{100 * again.hausdorff:.2f}",
    }


def child(
    pipe: Connection,
    load: Callable[[], Any],
    arguments: argparse.Namespace,
    options: dict[str, Any],
) -> None:
    """Send a row, or the error in its place."""
    limit = int(arguments.gigabytes * 2**30)
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    try:
        pipe.send(row(load, options, arguments.map))
    except GipkgError as error:
        pipe.send({"outcome": type(error).__name__, "reason": str(error)})
    except MemoryError:
        pipe.send({"outcome": "OUT OF MEMORY"})


def warm_up(to_image: bool) -> None:
    """Load the compiled functions, that the processes need not."""
    mesh = gipkg.prepare(trimesh.creation.icosphere(2), method="volume", resolution=10).mesh
    if to_image:
        through_the_map(mesh)


def isolated(
    load: Callable[[], Any], arguments: argparse.Namespace, options: dict[str, Any]
) -> dict[str, str]:
    """Run one mesh in a process of its own; a crash, or too long a time, is a row, too."""
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=child, args=(sender, load, arguments, options))
    process.start()
    sender.close()
    try:
        if receiver.poll(arguments.seconds):
            return receiver.recv()
        return {"outcome": f"LONGER THAN {arguments.seconds} s"}
    except EOFError:
        process.join()
        return {"outcome": f"CRASHED ({process.exitcode})"}
    finally:
        process.kill()
        process.join()


def option(text: str) -> tuple[str, Any]:
    """Read ``NAME=VALUE``; the value is checked by `gipkg.prepare`."""
    name, value = text.split("=")
    return name, value


def main() -> None:
    """Print a row for every mesh, then how many there are of each outcome."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="*", type=Path)
    parser.add_argument("--database")
    parser.add_argument("--data", type=Path, default=Path("data"))
    parser.add_argument("--set", type=option, action="append", default=[], dest="options")
    parser.add_argument("--map", action="store_true")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--gigabytes", type=float, default=8)
    arguments = parser.parse_args()
    columns = COLUMNS + MAP_COLUMNS * arguments.map
    print("  ".join([f"{'mesh':32}", f"{'outcome':16}", *(f"{one:>8}" for one in columns[1:])]))
    warm_up(arguments.map)
    outcomes: dict[str, int] = {}
    for name, load in sources(arguments):
        found = isolated(load, arguments, dict(arguments.options))
        outcome = found["outcome"]
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        cells = [
            f"{name:32}",
            f"{outcome:16}",
            *(f"{found.get(one, ''):>8}" for one in columns[1:]),
        ]
        print("  ".join(cells), found.get("reason", ""), flush=True)
    print("; ".join(f"{outcome}: {number}" for outcome, number in sorted(outcomes.items())))
    if any(outcome[:2].isupper() for outcome in outcomes):
        sys.exit("some meshes are neither a surface nor a named error")


if __name__ == "__main__":
    main()
