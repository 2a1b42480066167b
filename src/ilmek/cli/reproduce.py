"""`ilmek reproduce`: recompute the verification manual."""

from collections import Counter
from collections.abc import Mapping, Sequence

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import say, show_table
from ilmek.jobs.reproduce import reproduce_papers
from ilmek.verification import PAPERS, TITLES, VERDICTS, Verdict
from ilmek.verification.claim import MISPRINT, NOT_REPRODUCIBLE, OFF, REPRODUCED, ROUNDED_INPUT, ROUNDING, UNSOUND
from ilmek.verification.wording import HEADINGS, ROOT_HEADINGS, root_rows, row, summary

ORDER = (UNSOUND, MISPRINT, OFF, NOT_REPRODUCIBLE, ROUNDED_INPUT, ROUNDING, REPRODUCED)
"""The verdicts, worst first."""

EXAMPLES = """\b
Examples:
  ilmek reproduce
  ilmek reproduce --paper beat-up
  ilmek reproduce --json -

\b
Verdicts, and what is fitted:
  reproduced        agrees to the last printed digit; no residual
  rounding          within one unit of the last printed digit
  rounded input     follows from a rounded number, which is named
  misprint          the computed number is right; its root is named
  off               a reading of a curve or of the machine misses
  unsound           the reasoning does not hold
  not reproducible  nothing can be computed
  fitted            constants that the paper does not state
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
    """Recompute the numbers, equations and statements of the four papers and report which are reproduced.

    Those that are not reproduced are listed first, then the rest in the order of the pages. The table has the unit as
    printed, so that it can be compared with the paper; the JSON is in SI.
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
    """Print the claims of one paper, those that are not reproduced first, misprints by their roots; then the roots."""
    say(f"{paper}: {TITLES[paper]}")
    roots = [root for root, *_ in root_rows(verdicts)]
    by_root = sorted(verdicts, key=lambda verdict: roots.index(verdict.roots[0]) if verdict.roots else 0)
    groups = [[row(verdict) for verdict in by_root if verdict.verdict == name] for name in ORDER]
    show_table(HEADINGS, *filter(None, groups), right=(2,), wide=(1, 2, 3))
    if any(verdict.roots for verdict in verdicts):
        say(f"{paper}: the slips, and the rows that follow from each")
        show_table(ROOT_HEADINGS, root_rows(verdicts), right=(1,))
    say(f"{paper}: {summary(verdicts)}\n")


def show_summary(verdicts: Mapping[str, Sequence[Verdict]]) -> None:
    """Print the number of claims by paper and verdict, and of those with fitted constants."""
    listed = {paper: tuple(of_paper) for paper, of_paper in verdicts.items()}
    if len(listed) > 1:
        listed["all"] = tuple(verdict for of_paper in verdicts.values() for verdict in of_paper)
    rows = [(paper, *map(str, counts(of_paper))) for paper, of_paper in listed.items()]
    show_table(("paper", "claims", *VERDICTS, "fitted"), rows[:-1], rows[-1:], right=range(1, len(VERDICTS) + 3))


def counts(verdicts: Sequence[Verdict]) -> tuple[int, ...]:
    """The number of claims, of each verdict, and of claims with fitted constants."""
    counted = Counter(verdict.verdict for verdict in verdicts)
    fitted = sum(bool(verdict.claim.fitted) for verdict in verdicts)
    return (len(verdicts), *(counted[name] for name in VERDICTS), fitted)
