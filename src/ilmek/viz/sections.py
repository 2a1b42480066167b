"""The parts of a page that come from a machine's report: its figures as SVG, its checks, the verdict."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from ilmek.report import Animation, Check, Figure, Reason, Report, Timing
from ilmek.report.left_out import made_or_left_out
from ilmek.viz.svg import svg


@dataclass(frozen=True, slots=True)
class PageVerdict:
    """The verdict at the top of a page: its sentences, the number of checks, the reasons where it is no.

    first    number of reasons that are shown at once; the others are folded
    nearest  carpets that the loom could weave, in words
    """

    good: str
    bad: str
    checks: int
    reasons: tuple[Reason, ...]
    first: int = 1000
    nearest: str = ""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A figure and its SVG. Kinds: "", "wide" (whole width), "moves" (animated), "wide timed" (with a cursor)."""

    figure: Figure
    svg: Markup
    kind: str


@dataclass(frozen=True, slots=True)
class PageSection:
    """A machine's part of a page."""

    id: str
    report: Report
    figures: tuple[Drawn, ...]

    def holds(self, kind: str) -> bool:
        """Whether it has a figure of a kind."""
        return any(drawn.kind == kind for drawn in self.figures)


@dataclass(frozen=True, slots=True)
class MachineCheck:
    """A check and the machine it belongs to."""

    machine: str
    check: Check

    @property
    def named(self) -> Check:
        """The check with its machine's title before its name."""
        return replace(self.check, name=f"{self.machine}: {self.check.name}") if self.machine else self.check


def section(index: int, report: Report, left_out: list[str]) -> PageSection:
    """The part of a report; a warning is added to `left_out` for each figure that cannot be drawn."""
    return PageSection(f"m{index}", report, tuple(drawn(figure, left_out) for figure in report.figures))


def drawn(figure: Figure, left_out: list[str]) -> Drawn:
    """A figure, or where it cannot be drawn the reason in its place."""
    made = made_or_left_out(f"figure {figure.title!r}", lambda: svg(figure), left_out)
    if made is None:
        return Drawn(figure, Markup("<p>{}</p>").format(left_out[-1]), "")
    return Drawn(figure, Markup(made), _kind(figure))


def _kind(figure: Figure) -> str:
    if isinstance(figure, Timing):
        return "wide timed" if figure.laws else "wide"
    return "moves" if isinstance(figure, Animation) else ""


def judged(own: Sequence[Check], reports: Iterable[Report]) -> list[MachineCheck]:
    """The checks that belong to no machine, then those of each report."""
    of_reports = (MachineCheck(report.title, check) for report in reports for check in report.checks)
    return [*(MachineCheck("", check) for check in own), *of_reports]


def failures_first(checks: Sequence[MachineCheck]) -> list[MachineCheck]:
    """The checks that fail, then the others."""
    return sorted(checks, key=lambda one: one.check.ok)
