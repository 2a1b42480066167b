"""The verdict of a command: its headline with the reasons, and the exit code."""

from collections.abc import Sequence

import click

from ilmek.cli.terminal import note
from ilmek.errors import printable
from ilmek.report import Check, in_words, reasons

CHECK_FAILS = 3
"""Exit code of a command that is done and has a check that fails."""

WEAVES = "weaves"
"""The headline of a loom; every other one is CHECKS."""

CHECKS = "checks"


def exit_code(checks: Sequence[Check]) -> int:
    """0 where every check holds, else CHECK_FAILS."""
    return 0 if all(check.ok for check in checks) else CHECK_FAILS


def show_verdict(checks: Sequence[Check], headline: str = CHECKS, nearest: str = "") -> None:
    """Print the headline, and each reason with value, limit and cure; nothing without checks.

    nearest  carpets that the loom could weave, in words
    """
    if checks:
        failed = reasons(checks)
        click.echo(f"{headline}: {_words(checks, failed, headline)}")
        for reason in failed:
            click.echo(printable(f"  {line(reason)}"))
        if nearest:
            click.echo(f"nearest that weaves: {nearest}")


def note_verdict(checks: Sequence[Check], headline: str = CHECKS) -> None:
    """A note with the headline and the names of the reasons, where standard output has something else."""
    if failed := reasons(checks):
        names = "; ".join(reason.name for reason in failed)
        note(f"{headline}: {_words(checks, failed, headline)}: {names}")


def line(reason: Check) -> str:
    """A reason in one line.

    >>> line(Check("sag", 0.003, 0.002, "mm", False, "rail_sag").with_cure("set a stiffer rail"))
    'sag: 3 mm, must be at most 2 mm; set a stiffer rail'
    """
    value, limit = in_words(reason)
    relation = {"<=": "at most ", ">=": "at least "}.get(reason.relation, f"{reason.relation} ")
    must = f"{value}, must be {relation}{limit}" if limit != "yes" else f"{value}, {reason.source}"
    return f"{reason.name}: {must}{'; ' if reason.cure else ''}{reason.cure}"


def _words(checks: Sequence[Check], failed: Sequence[Check], headline: str) -> str:
    if headline == WEAVES:
        return f"NO, {len(failed)} {'reason' if len(failed) == 1 else 'reasons'}" if failed else "yes"
    return f"{len(checks) - len(failed)} passed, {len(failed)} failed"
