"""Lazy references to plugins: where each one is found, and how it is imported."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from importlib import import_module, metadata
from importlib.util import module_from_spec, spec_from_file_location
from operator import attrgetter
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal, get_args

import gipkg
from gipkg.errors import BrokenPluginError

if TYPE_CHECKING:
    from gipkg.api import Plugin

Kind = Literal["parametrizer", "descriptor", "baseline", "dataset"]
KINDS: tuple[Kind, ...] = get_args(Kind)

BUILTINS: Mapping[Kind, Mapping[str, str]] = {
    "parametrizer": {
        "authalic": "gipkg.parametrizers.authalic:Authalic",
        "authalic-flow": "gipkg.parametrizers.authalic_flow:AuthalicFlow",
        "conformal": "gipkg.parametrizers.conformal:Conformal",
        "lie-advection": "gipkg.parametrizers.lie_advection:LieAdvection",
        "optimal-transport": "gipkg.parametrizers.optimal_transport:OptimalTransport",
        "penalty": "gipkg.parametrizers.penalty:Penalty",
        "spharm": "gipkg.parametrizers.spharm:Spharm",
    },
    "descriptor": {
        "centroid-distance": "gipkg.descriptors.position:CentroidDistance",
        "curvature": "gipkg.descriptors.curvature:Curvature",
        "gms": "gipkg.descriptors.gms:GreensMeanSignature",
        "gps": "gipkg.descriptors.gps:GlobalPointSignature",
        "gravity-angle": "gipkg.descriptors.normals:GravityAngle",
        "height": "gipkg.descriptors.position:Height",
        "hks": "gipkg.descriptors.hks:HeatKernelSignature",
        "normals": "gipkg.descriptors.normals:Normals",
        "position": "gipkg.descriptors.position:Position",
        "radial-normal": "gipkg.descriptors.normals:RadialNormal",
        "si-hks": "gipkg.descriptors.si_hks:ScaleInvariantHKS",
        "thickness": "gipkg.descriptors.thickness:Thickness",
        "topological-mask": "gipkg.descriptors.topological_mask:TopologicalMask",
        "wks": "gipkg.descriptors.wks:WaveKernelSignature",
    },
    "baseline": {
        "deeppano": "gipkg.baselines.deeppano.baseline:DeepPano",
        "hks-wks": "gipkg.baselines.hks_wks:SignatureQuantiles",
        "lfd": "gipkg.baselines.light_field.baseline:LightField",
        "shape-google": "gipkg.baselines.shape_google:ShapeGoogle",
        "shapedna": "gipkg.baselines.shapedna:ShapeDNA",
        "shapenets": "gipkg.baselines.shapenets.baseline:ShapeNets",
        "spherical-harmonics": "gipkg.baselines.spherical_harmonics:SphericalHarmonics",
        "voxnet": "gipkg.baselines.voxnet.baseline:VoxNet",
        "zernike": "gipkg.baselines.zernike:Zernike",
    },
    "dataset": {
        "articulated": "gipkg.datasets.articulated:Articulated",
        "folder": "gipkg.datasets.folder:Folder",
        "furniture": "gipkg.datasets.furniture:Furniture",
        "mcgill": "gipkg.datasets.mcgill:McGill",
        "modelnet10": "gipkg.datasets.modelnet:ModelNet10",
        "modelnet10-voxels": "gipkg.datasets.modelnet_voxels:ModelNet10Voxels",
        "modelnet40": "gipkg.datasets.modelnet:ModelNet40",
        "shrec11": "gipkg.datasets.shrec11:Shrec11",
        "tosca": "gipkg.datasets.tosca:Tosca",
        "tosca-highres": "gipkg.datasets.tosca:ToscaHighResolution",
    },
}

_NAME = re.compile(r"[a-z][a-z0-9-]*")


@dataclass(frozen=True, slots=True)
class PluginRef:
    """Where a plugin is found; making one imports nothing."""

    kind: Kind
    name: str
    target: str
    """``package.module:Class``, or ``/path/file.py:Class`` for a local plugin."""
    distribution: str | None
    version: str | None
    source: Literal["built-in", "entry point", "local"]

    @property
    def origin(self) -> str:
        """Who brings it: ``built in``, a distribution with its version, or a file."""
        if self.source == "built-in":
            return "built in"
        if self.source == "local":
            return self.target
        return f"{self.distribution} {self.version}"

    def __str__(self) -> str:
        return f"{self.kind} {self.name!r} ({self.origin})"


def builtin(kind: Kind) -> list[PluginRef]:
    """Return the references of gipkg's own plugins of one kind."""
    return [
        PluginRef(kind, name, target, "gipkg", gipkg.__version__, "built-in")
        for name, target in BUILTINS[kind].items()
    ]


def installed(kind: Kind) -> list[PluginRef]:
    """Return the references that installed distributions register as entry points."""
    # Folders change their time when a distribution is added: a live session sees it.
    folders = tuple((entry, _modified(entry)) for entry in sys.path)
    return [
        PluginRef(
            kind,
            normalise(entry.name),
            f"{entry.module}:{entry.attr}",
            entry.dist.name if entry.dist else None,
            entry.dist.version if entry.dist else None,
            "entry point",
        )
        for entry in _entry_points(f"gipkg.{kind}s", folders)
    ]


def _modified(entry: str) -> int | None:
    try:
        return Path(entry).stat().st_mtime_ns
    except OSError:
        return None


@lru_cache(maxsize=8)
def _entry_points(group: str, _folders: tuple[tuple[str, int | None], ...]) -> metadata.EntryPoints:
    return metadata.entry_points(group=group)


def load(ref: PluginRef) -> type[Plugin]:
    """Import the class a reference points to and hold it against its contract.

    Raises
    ------
    BrokenPluginError
        It cannot be imported (the cause is chained) or breaks its contract.
    """
    require_valid_name(ref)
    module, _, attribute = ref.target.rpartition(":")
    try:
        owner = _import_file(Path(module)) if ref.source == "local" else import_module(module)
        plugin = attrgetter(attribute)(owner)
    except (Exception, SystemExit) as error:
        raise BrokenPluginError(
            f"{ref} cannot be loaded: {type(error).__name__}: {error}"
        ) from error
    if fault := _contract_fault(ref.kind, plugin):
        raise BrokenPluginError(f"{ref}: {ref.target} {fault}")
    return plugin


def _import_file(path: Path) -> ModuleType:
    name = f"gipkg_local_{path.stem}_{sha256(bytes(path)).hexdigest()[:8]}"
    if name in sys.modules:
        return sys.modules[name]
    spec = spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is not a Python file")
    module = module_from_spec(spec)
    # Registered before it runs, since pickle and postponed annotations look it up there.
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def normalise(name: str) -> str:
    """Return the spelling under which a plugin is listed."""
    return name.replace("_", "-")


def is_valid_name(name: str) -> bool:
    """Tell whether a name in its normal spelling can stand in a path and a config."""
    return _NAME.fullmatch(name) is not None


def require_valid_name(ref: PluginRef) -> None:
    """Raise BrokenPluginError for a name that is not valid."""
    if not is_valid_name(ref.name):
        raise BrokenPluginError(f"{ref}: a name is lower case letters, digits and '-'")


def _contract_fault(kind: Kind, plugin: Any) -> str | None:
    from gipkg import api

    base = getattr(api, kind.capitalize())
    if not (isinstance(plugin, type) and issubclass(plugin, base)):
        return f"is not a class derived from gipkg.api.{base.__name__}"
    if missing := sorted(getattr(plugin, "__abstractmethods__", ())):
        return f"does not define {', '.join(missing)}"
    required = ["summary", "citation", "tags", *(["protocols"] if kind == "dataset" else [])]
    if missing := [name for name in required if not hasattr(plugin, name)]:
        return f"does not set {', '.join(missing)}"
    return None
