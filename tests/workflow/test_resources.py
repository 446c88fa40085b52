"""Every job says how much memory it may take, and the profile of a cluster bounds the rest."""

from __future__ import annotations

import re

import yaml

from tests.workflow.workdir import REPOSITORY, Workdir

RULES = {
    name: block
    for path in sorted((REPOSITORY / "workflow/rules").glob("*.smk"))
    for name, block in re.findall(r"(?ms)^rule (\w+):\n(.*?)(?=^\S|\Z)", path.read_text())
}


def test_every_rule_bounds_its_memory() -> None:
    assert len(RULES) > 25
    unbounded = [name for name, block in RULES.items() if "        mem_mb=memory" not in block]
    assert unbounded == []


def test_a_cluster_bounds_what_the_rules_leave_open() -> None:
    settings = yaml.safe_load((REPOSITORY / "profiles/slurm/config.yaml").read_text())
    assert set(settings["default-resources"]) == {"mem_mb", "runtime"}
    # A retry may take as much again.
    assert settings["retries"] > 0


def test_a_job_that_holds_its_input_may_take_more_the_more_there_is(smoke: Workdir) -> None:
    done = smoke.run(
        "results/table1.csv", "--dry-run", "--forcerun", "learn", "parametrize", "classify"
    )
    assert done.returncode == 0, done.stdout
    asked: dict[str, set[int]] = {}
    for rule, amount in re.findall(r"(?s)\nrule (\w+):.*?mem_mb=(\d+)", done.stdout):
        asked.setdefault(rule, set()).add(int(amount))
    assert asked["parametrize"] == {2000}
    assert min(asked["learn"]) > 1000
    assert "mem_mb=<TBD>" not in done.stdout.partition("rule evaluate")[0]
