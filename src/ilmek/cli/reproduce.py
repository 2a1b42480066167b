"""`ilmek reproduce`: recompute the verification manual."""

from collections import Counter
from collections.abc import Mapping, Sequence

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import say, show_table
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
rounding          within 1.5 units of the last printed digit, or follows from the paper's rounded numbers
misprint          the computed number is right; the note gives the correct equation
not reproducible  the note gives the reason
"""


@click.command(epilog=EXAMPLES)
@click.option(
    "--paper",
    "papers",
    multiple=True,
    type=click.Choice(tuple(PAPERS)),
    help="Only this paper; may be given several times.",
)
@force_option
@json_option
def command(papers: tuple[str, ...], force: bool, json_to: str | None) -> None:
    """Compute every number that the four papers print and report which are reproduced.

    Numbers that are not reproduced are listed first, then the rest in the order of the pages. Numbers are in the unit
    as printed, in the JSON too, so that they can be compared with the paper.
    """
    with call_outputs({"--json": json_to}, force=force) as call:
        result = reproduce_papers(papers, progress=call.progress)
        call.give_json(result.as_json)
    if call.quiet:
        return
    for paper, of_paper in result.verdicts.items():
        show_paper(paper, of_paper)
    show_summary(result.verdicts)
    say(f"computed in {result.seconds:.1f} s")


def show_paper(paper: str, verdicts: Sequence[Verdict]) -> None:
    """Print the claims of one paper, those that are not reproduced first."""
    say(f"{paper}: {TITLES[paper]}")
    groups = [[row(verdict) for verdict in verdicts if verdict.verdict == name] for name in ORDER]
    show_table(HEADINGS, *filter(None, groups), right=(2,), wide=(1, 2, 3))
    say(f"{paper}: {summary(verdicts)}\n")


def show_summary(verdicts: Mapping[str, Sequence[Verdict]]) -> None:
    """Print the number of claims by paper and verdict."""
    counted = {paper: Counter(verdict.verdict for verdict in of_paper) for paper, of_paper in verdicts.items()}
    if len(counted) > 1:
        counted["all"] = sum(counted.values(), Counter())
    rows = [(paper, str(count.total()), *(str(count[name]) for name in VERDICTS)) for paper, count in counted.items()]
    show_table(("paper", "claims", *VERDICTS), rows[:-1], rows[-1:], right=range(1, 6))
