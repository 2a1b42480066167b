"""`ilmek reproduce`: the verification manual, computed anew."""

from collections import Counter
from collections.abc import Mapping, Sequence

import click

from ilmek.cli.options import json_option
from ilmek.cli.terminal import check_json, console, give_json, progress_bar, show_table
from ilmek.jobs.reproduce import reproduce_papers
from ilmek.verification import PAPERS, TITLES, VERDICTS, Verdict
from ilmek.verification.claim import MISPRINT, NOT_REPRODUCIBLE, REPRODUCED, ROUNDING
from ilmek.verification.wording import HEADINGS, row, summary

ORDER = (MISPRINT, NOT_REPRODUCIBLE, ROUNDING, REPRODUCED)
"""The verdicts, worst first."""

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

    Of each paper first what is not reproduced, then the rest in the order of its pages. Numbers are in the unit as
    printed, so that they can be laid beside the paper; so they are in the JSON.
    """
    check_json(json_to)
    with progress_bar() as progress:
        found = reproduce_papers(papers, progress=progress)
    if give_json(json_to, found.as_json()):
        return
    for paper, of_paper in found.verdicts.items():
        show_paper(paper, of_paper)
    show_summary(found.verdicts)
    console().print(f"computed in {found.seconds:.1f} s")


def show_paper(paper: str, verdicts: Sequence[Verdict]) -> None:
    """One paper: its claims, those that are not reproduced first, verdict by verdict."""
    console().print(f"{paper}: {TITLES[paper]}")
    groups = [[row(verdict) for verdict in verdicts if verdict.verdict == name] for name in ORDER]
    show_table(HEADINGS, *filter(None, groups), right=(2,), wide=(1, 2, 3))
    console().print(f"{paper}: {summary(verdicts)}\n")


def show_summary(verdicts: Mapping[str, Sequence[Verdict]]) -> None:
    """How many claims of each paper have which verdict."""
    counted = {paper: Counter(verdict.verdict for verdict in of_paper) for paper, of_paper in verdicts.items()}
    if len(counted) > 1:
        counted["all"] = sum(counted.values(), Counter())
    rows = [(paper, str(count.total()), *(str(count[name]) for name in VERDICTS)) for paper, count in counted.items()]
    show_table(("paper", "claims", *VERDICTS), rows[:-1], rows[-1:], right=range(1, 6))
