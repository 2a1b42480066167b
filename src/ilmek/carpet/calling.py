"""Calling of a row to the weaver: one step for each run, or for each colour, in the order of reading."""

from typing import NamedTuple

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI
from ilmek.carpet.rows import Run, directions, row_runs, span_text, spans_by_yarn


class CallStep(NamedTuple):
    """What is called at once.

    knots   their number         mark    HALF, JUFTI or 0
    yarn    of the knots, of half knots that of the warp that is met first
    second  of half knots that of the warp that is met second
    cells   their numbers from the edge where the row begins, like 12-20 or 7
    """

    knots: int
    mark: int
    yarn: int
    second: int
    cells: tuple[str, ...]


def row_steps(chart: Chart, number: int, by: str, direction: str) -> tuple[CallStep, ...]:
    """The steps of a row, counted from 1 at the carpet's lower edge.

    by  runs or colours      direction  right, left or alternate
    """
    rightward, runs = rightward_in(number, direction), row_runs(chart, number)
    if by == "colours":
        return tuple(
            CallStep(
                sum(span.knots for span in spans),
                0,
                yarn,
                0,
                tuple(span_text(span, chart.columns, rightward) for span in (spans if rightward else spans[::-1])),
            )
            for yarn, spans in spans_by_yarn(runs).items()
        )
    return tuple(_step(run, chart.columns, rightward) for run in (runs if rightward else runs[::-1]))


def rightward_in(number: int, direction: str) -> bool:
    """Whether a row is read from left to right; `direction` is not both."""
    return next(directions(number, direction))


def _step(run: Run, columns: int, rightward: bool) -> CallStep:
    yarns = (run.yarn, run.second) if rightward or run.mark != HALF else (run.second, run.yarn)
    first = run.first + 1 if rightward else columns - run.first - run.cells + 1
    cells = f"{first}-{first + run.cells - 1}" if run.cells > 1 else f"{first}"
    return CallStep(run.knots, run.mark, *yarns, (cells,))


def count_text(step: CallStep) -> str:
    """The number of knots as it is called: 12, of half knots 2½, of jufti knots 3j."""
    return f"{step.knots}{'½' if step.mark == HALF else 'j' if step.mark == JUFTI else ''}"
