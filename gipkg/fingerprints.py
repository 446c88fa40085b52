"""Fingerprints of code, so that an edited function reruns what it computed and nothing else.

A fingerprint hashes the syntax trees of a module and of the gipkg modules it imports, and of
those they import. Comments, docstrings and layout leave it unchanged. Nothing is imported:
imports are read from the source, wherever in the file they stand, including the strings
of lazy ones (``"gipkg.images"``). What only a type checker imports does not count, nor do the
contracts of plugins and the modules that find plugins and word errors: they compute nothing.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from gipkg.errors import BrokenPluginError

if TYPE_CHECKING:
    from gipkg.plugin_refs import PluginRef

_ROOT = Path(__file__).resolve().parent
_MODULE_NAME = re.compile(r"gipkg(\.\w+)+")
_NOT_COMPUTING = frozenset(
    f"gipkg.{name}"
    for name in ("api", "errors", "fingerprints", "parameters", "plugin_refs", "registry")
)


@dataclass(frozen=True, slots=True)
class _Source:
    """What a file holds, as far as it counts, and what it may import."""

    digest: str
    imports: frozenset[str]


def fingerprint_module(name: str) -> str:
    """Hash a module or package of gipkg with the gipkg modules it depends on.

    Parameters
    ----------
    name : str
        ``"gipkg.images"`` or ``"gipkg.images.lookup"``; a package stands for all its modules.

    Returns
    -------
    str
        64 hexadecimal digits.

    Raises
    ------
    ValueError
        There is no such module.
    """
    path = _path_of(name)
    if path is None:
        raise ValueError(f"there is no module {name!r} in {_ROOT}")
    return _hash(_closure(_modules_below(name, path)))


def of_plugin(ref: PluginRef) -> str:
    """Hash the code of a plugin.

    For a built-in: its module and the gipkg modules it depends on. For an installed plugin:
    every file of its top-level package, the gipkg modules those depend on, and the version of
    the distribution. For a local plugin: its one file and the gipkg modules it depends on.

    Raises
    ------
    BrokenPluginError
        The module is not there.
    """
    module, _, attribute = ref.target.rpartition(":")
    if ref.source == "built-in":
        if _path_of(module) is None:
            raise BrokenPluginError(f"{ref}: there is no module {module}")
        return _hash({**_closure({module}), "": attribute})
    files = (
        _local_files(ref, Path(module)) if ref.source == "local" else _package_files(ref, module)
    )
    sources = {name: _read(path) for name, path in files.items()}
    digests = {name: source.digest for name, source in sources.items()}
    imports = frozenset[str]().union(*(source.imports for source in sources.values()))
    return _hash({**_closure(imports), **digests, "": f"{attribute} {ref.version}"})


def _local_files(ref: PluginRef, path: Path) -> dict[str, Path]:
    if not path.is_file():
        raise BrokenPluginError(f"{ref}: there is no file {path}")
    return {path.name: path}


def _package_files(ref: PluginRef, module: str) -> dict[str, Path]:
    # Only the top-level package is looked up: finding a submodule would import its parents.
    top = module.partition(".")[0]
    spec = find_spec(top)
    if spec is None:
        raise BrokenPluginError(f"{ref}: there is no module {top}")
    if spec.submodule_search_locations is None:
        return {Path(spec.origin or "").name: Path(spec.origin or "")}
    return {
        path.relative_to(folder).as_posix(): path
        for folder in spec.submodule_search_locations
        for path in sorted(Path(folder).rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }


def _hash(parts: dict[str, str]) -> str:
    return sha256("\n".join(f"{name} {parts[name]}" for name in sorted(parts)).encode()).hexdigest()


def _closure(names: set[str] | frozenset[str]) -> dict[str, str]:
    """Return the digests of gipkg modules and of all they depend on, by name."""
    digests: dict[str, str] = {}
    pending = set(names)
    while pending:
        name = pending.pop()
        path = _path_of(name)
        if path is None or name in digests or not _computes(name):
            continue
        source = _read(path)
        digests[name] = source.digest
        pending |= source.imports
    return digests


def _computes(name: str) -> bool:
    # One of them, the contracts, is a package, whose modules are imported directly, too.
    return ".".join(name.split(".")[:2]) not in _NOT_COMPUTING


def _modules_below(name: str, path: Path) -> set[str]:
    if path.name != "__init__.py":
        return {name}
    files = path.parent.rglob("*.py")
    return {_name_of(file) for file in files}


def _path_of(name: str) -> Path | None:
    top, *rest = name.split(".")
    if top != "gipkg":
        return None
    stem = _ROOT.joinpath(*rest)
    candidates = (stem / "__init__.py", stem.with_suffix(".py"))
    return next((path for path in candidates if path.is_file()), None)


def _name_of(file: Path) -> str:
    parts = file.relative_to(_ROOT.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _read(path: Path) -> _Source:
    status = path.stat()
    return _parse(path, status.st_mtime_ns, status.st_size)


@cache
def _parse(path: Path, _modified: int, _size: int) -> _Source:
    content = path.read_bytes()
    tree = _syntax_tree(content) if path.suffix == ".py" else None
    if tree is None:
        return _Source(sha256(content).hexdigest(), frozenset())
    for node in ast.walk(tree):
        _strip_docstring(node)
    package = _package_of(path)
    imports = frozenset(name for node in _walk_runtime(tree) for name in _imported(node, package))
    return _Source(sha256(ast.dump(tree).encode()).hexdigest(), imports)


def _syntax_tree(content: bytes) -> ast.Module | None:
    try:
        return ast.parse(content)
    except (SyntaxError, ValueError):  # A template or a fixture inside a package is data.
        return None


def _strip_docstring(node: ast.AST) -> None:
    match node:
        case (
            ast.Module(body=body)
            | ast.ClassDef(body=body)
            | ast.FunctionDef(body=body)
            | ast.AsyncFunctionDef(body=body)
        ):
            # Strings that stand alone compute nothing, at the head of a body or inside it.
            body[:] = [child for child in body if not _is_text(child)]


def _is_text(node: ast.stmt) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    )


def _walk_runtime(tree: ast.Module) -> Iterator[ast.AST]:
    """Walk a syntax tree, leaving out the blocks under ``if TYPE_CHECKING``."""
    pending: list[ast.AST] = [tree]
    while pending:
        node = pending.pop()
        yield node
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            pending += node.orelse
        else:
            pending += ast.iter_child_nodes(node)


def _package_of(path: Path) -> str:
    return _name_of(path.parent / "__init__.py") if path.is_relative_to(_ROOT) else ""


def _imported(node: ast.AST, package: str) -> Iterator[str]:
    """Yield the names of gipkg modules that a node may import; some may not be modules."""
    match node:
        case ast.Import(names=names):
            yield from (alias.name for alias in names)
        case ast.ImportFrom(module=module, names=names, level=level):
            base = ".".join(package.split(".")[: 1 - level or None]) if level else ""
            origin = ".".join(filter(None, (base, module)))
            members = [f"{origin}.{alias.name}" for alias in names]
            # The code of a package itself counts where something else than a module is taken.
            yield from members if all(map(_path_of, members)) else (origin, *members)
        case ast.Constant(value=str(text)) if _MODULE_NAME.fullmatch(text):
            yield text
