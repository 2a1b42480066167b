"""The verdict of a command: its headline with the reasons, and the exit code."""

from collections.abc import Sequence

import click

from ilmek.cli.language import printed, worded
from ilmek.cli.terminal import note
from ilmek.report import Check, in_words, reasons
from ilmek.sentences import Sentence, joined

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
        click.echo(printed(_outcome(checks, failed, headline)))
        for reason in failed:
            click.echo(f"  {printed(line(reason))}")
        if nearest:
            click.echo(printed(Sentence("terminal.nearest", text=nearest)))


def note_verdict(checks: Sequence[Check], headline: str = CHECKS) -> None:
    """A note with the headline and the names of the reasons, where standard output has something else."""
    if failed := reasons(checks):
        names = "; ".join(worded(reason.name) for reason in failed)
        note(Sentence("at", where=_outcome(checks, failed, headline), text=names))


def line(reason: Check) -> str:
    """A reason in one line.

    >>> line(Check("sag", 0.003, 0.002, "mm", False, "rail_sag").with_cure("set a stiffer rail"))
    'sag: 3 mm, must be at most 2 mm; set a stiffer rail'
    """
    value, limit = in_words(reason)
    if limit == "yes":
        must = Sentence("terminal.must", value=value, source=reason.source)
    else:
        must = Sentence(_LIMITS.get(reason.relation, "terminal.must-be"), value=value, limit=limit)
    return joined(Sentence("at", where=reason.name, text=must), reason.cure)


_LIMITS = {"<=": "terminal.at-most", ">=": "terminal.at-least"}


def _outcome(checks: Sequence[Check], failed: Sequence[Check], headline: str) -> Sentence:
    if headline != WEAVES:
        return Sentence("terminal.checks", passed=len(checks) - len(failed), failed=len(failed))
    if not failed:
        return Sentence("terminal.weaves")
    return Sentence("terminal.weaves-not-one" if len(failed) == 1 else "terminal.weaves-not", count=len(failed))
