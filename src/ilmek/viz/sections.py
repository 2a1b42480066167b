"""The parts of a page that come from a machine's report: its figures as SVG, its checks, the verdict."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import msgspec
from markupsafe import Markup

from ilmek.records import json_value
from ilmek.report import Animation, Check, Figure, Gantt, Plot, Report, StackedBars, Timing
from ilmek.report.left_out import made_or_left_out
from ilmek.viz.embedded import compressed
from ilmek.viz.looks import looked
from ilmek.viz.plain import shown_figures
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
    reasons: tuple[Check, ...]
    first: int = 1000
    nearest: str = ""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A figure, its SVG, and its data, compressed, from which the client draws it; "" where that is left out."""

    figure: Figure
    svg: Markup
    data: str = ""

    @property
    def wide(self) -> bool:
        """Whether it takes the whole width."""
        return isinstance(self.figure, Timing | Gantt | StackedBars)


@dataclass(frozen=True, slots=True)
class Moving:
    """A mechanism in motion, beside the charts over the same drive."""

    stage: tuple[Drawn, ...]
    charts: tuple[Drawn, ...]


@dataclass(frozen=True, slots=True)
class PageSection:
    """A machine's part of a page: mechanisms in motion with their charts, and the other figures."""

    id: str
    report: Report
    moving: tuple[Moving, ...]
    figures: tuple[Drawn, ...]

    @property
    def drawn_contents(self) -> list[tuple[str, str]]:
        """Anchor and title of what moves and of the figures."""
        return self._contents([("motion", "In motion", bool(self.moving)), ("figures", "Figures", bool(self.figures))])

    @property
    def contents(self) -> list[tuple[str, str]]:
        """Anchor and title of each of its parts in numbers."""
        parts = [
            ("results", "Results", any(result.shown for result in self.report.results)),
            *((f"table-{index}", table.title, True) for index, table in enumerate(self.report.tables, 1)),
            ("parameters", "Parameters", bool(self.report.parameters)),
        ]
        return self._contents(parts)

    def _contents(self, parts: list[tuple[str, str, bool]]) -> list[tuple[str, str]]:
        return [(f"{self.id}-{name}", title) for name, title, there in parts if there]


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
    figures = [drawn(figure, left_out) for figure in looked(report.figures)]
    moving = []
    for name in dict.fromkeys(one.figure.drive.label for one in figures if isinstance(one.figure, Animation)):
        stage = tuple(one for one in figures if isinstance(one.figure, Animation) and one.figure.drive.label == name)
        charts = tuple(one for one in figures if isinstance(one.figure, Plot) and one.figure.x.label == name)
        if charts:
            moving.append(Moving(stage, charts))
            figures = [one for one in figures if one not in stage and one not in charts]
    return PageSection(f"m{index}", report, tuple(moving), tuple(figures))


def drawn(figure: Figure, left_out: list[str]) -> Drawn:
    """A figure, or where it cannot be drawn the reason in its place."""
    made = made_or_left_out(f"figure {figure.title!r}", lambda: svg(figure), left_out)
    if made is None:
        return Drawn(figure, Markup("<p>{}</p>").format(left_out[-1]))
    (shown,) = shown_figures((figure,))
    return Drawn(figure, Markup(made), compressed(msgspec.json.encode(shown, enc_hook=json_value)))


def judged(own: Sequence[Check], reports: Iterable[Report]) -> list[MachineCheck]:
    """The checks that belong to no machine, then those of each report."""
    of_reports = (MachineCheck(report.title, check) for report in reports for check in report.checks)
    return [*(MachineCheck("", check) for check in own), *of_reports]


def failures_first(checks: Sequence[MachineCheck]) -> list[MachineCheck]:
    """The checks that fail, then the others."""
    return sorted(checks, key=lambda one: one.check.ok)


def shown_first(checks: Sequence[MachineCheck], first: int) -> int:
    """Number of checks that are shown at once, of checks with the failed ones first: those, and up to `first`.

    A rest of two is shown as well.
    """
    failed = sum(not check.check.ok for check in checks)
    shown = max(failed, first)
    return shown if len(checks) > shown + 2 else len(checks)
