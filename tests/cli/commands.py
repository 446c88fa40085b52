"""Commands as a shell would run them, in this process."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from gipkg import cli


def run(*arguments: str | Path) -> Result:
    """Run ``gipkg`` with those arguments."""
    return CliRunner().invoke(cli.main, [str(argument) for argument in arguments])


def run_well(*arguments: str | Path) -> Result:
    """Run a command that has to end well."""
    result = run(*arguments)
    assert result.exit_code == 0, result.output
    return result


def records(result: Result) -> list[dict[str, Any]]:
    """Return what was printed, one JSON object a line."""
    return [json.loads(line) for line in result.stdout.splitlines()]
