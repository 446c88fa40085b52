"""The command line: every module of this package that does not begin with ``_`` is a command.

The module ``plugins`` defines the click command ``command``, run as ``gipkg plugins``. A
command's module is imported when it is called or when its help is asked for.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

import click

import gipkg
from gipkg.errors import GipkgError, did_you_mean


class Commands(click.Group):
    """Finds commands as modules, and turns gipkg's own errors into one line on stderr."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of the public modules beside this one."""
        names = (module.name for module in iter_modules(__path__))
        return sorted(name.replace("_", "-") for name in names if not name.startswith("_"))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import the module of a command."""
        if cmd_name not in self.list_commands(ctx):
            return None
        module = import_module(f"{__name__}.{cmd_name.replace('-', '_')}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find a command; for one that there is not, name the nearest."""
        names = self.list_commands(ctx)
        if args[0] not in names and not ctx.resilient_parsing:
            ctx.fail(f"no command is named {args[0]!r}{did_you_mean(args[0], names)}")
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> object:
        """Run a command; exit code 1 on a GipkgError, 2 on wrong usage."""
        try:
            return super().invoke(ctx)
        except GipkgError as error:
            raise click.ClickException(str(error)) from error


@click.group(cls=Commands)
@click.version_option(gipkg.__version__, package_name="gipkg")
def main() -> None:
    """Geometry images for learning 3D shapes."""
