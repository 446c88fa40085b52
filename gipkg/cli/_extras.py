"""What only some installations have."""

from __future__ import annotations

from importlib.util import find_spec

import click


def require(extra: str, *modules: str) -> None:
    """Stop, before any work, where an optional part of the installation is missing.

    Raises
    ------
    click.ClickException
        Names what is missing and how to install it.
    """
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        raise click.ClickException(
            f'this needs {" and ".join(missing)}: pip install "gipkg[{extra}]"'
        )
