"""`ilmek reproduce`: the verification manual, computed anew."""

import click

from ilmek.cli.options import json_option
from ilmek.cli.terminal import check_json, console, give_json, show_table
from ilmek.verification import PAPERS, TITLES, Verdict, reproduce
from ilmek.verification.wording import HEADINGS, row, summary

EXAMPLES = """\b
Examples:
  ilmek reproduce
  ilmek reproduce --paper beat-up
  ilmek reproduce --json -

reproduced        agrees to the last printed digit; an equation leaves no residual
rounding          within 1.5 units of the last printed digit, or from the paper's own rounded numbers
misprint          the computed number is right; the note has the right equation
not reproducible  the note says why
"""


@click.command(epilog=EXAMPLES)
@click.option(
    "--paper", "papers", multiple=True, type=click.Choice(tuple(PAPERS)), help="Only this paper; may be repeated."
)
@json_option
def command(papers: tuple[str, ...], json_to: str | None) -> None:
    """Compute every number that the four papers print, and say which are reproduced.

    Numbers are in the unit as printed, so that they can be laid beside the paper; so they are in the JSON.
    """
    check_json(json_to)
    wanted = tuple(paper for paper in PAPERS if paper in papers or not papers)
    verdicts = reproduce(wanted)
    if not give_json(json_to, [verdict.as_json() for verdict in verdicts]):
        for paper in wanted:
            show_paper(paper, [verdict for verdict in verdicts if verdict.claim.paper == paper])
        if len(wanted) > 1:
            console().print(f"all: {summary(verdicts)}")


def show_paper(paper: str, verdicts: list[Verdict]) -> None:
    """One paper: its claims, and how many have which verdict."""
    console().print(f"{paper}: {TITLES[paper]}")
    show_table(HEADINGS, [row(verdict) for verdict in verdicts], right=(2,))
    console().print(f"{paper}: {summary(verdicts)}\n")
