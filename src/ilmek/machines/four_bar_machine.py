"""A machine that synthesises four-bars for a task: what they have in common."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from ilmek.machines.component import Component, itself
from ilmek.machines.four_bar_figures import own_machine
from ilmek.machines.four_bar_tree import four_bar_tree, made_checks
from ilmek.machines.loom_task import P
from ilmek.progress import Progress
from ilmek.report import Check, Figure, Table
from ilmek.synthesis import selection_report
from ilmek.synthesis.selection import FourBarDesign, FourBarSelection

F = TypeVar("F", bound=FourBarDesign)


def four_bar_machine(
    name: str,
    params: type[P],
    kind: type[F],
    design: Callable[[P], F],
    *,
    tables: Callable[[F], tuple[Table, ...]],
    figures: Callable[[F], tuple[Figure, ...]],
    warnings: Callable[[F], tuple[str, ...]] = selection_report.warnings,
    self_tests: Callable[[F], tuple[Check, ...]] = lambda _: (),
    long_design: Callable[[P, Progress], F] | None = None,
) -> Component[P, F, F]:
    """The machine of a task: `path-four-bar` for a path. kind: class of its designs; all else as of a component."""
    return Component(
        name=name,
        title=f"Four-bar for a {name.partition('-')[0]}",
        params=params,
        design=design,
        long_design=long_design,
        analysis=itself,
        results=lambda made: (made, made.choice),
        reported=(kind, FourBarSelection),
        headline=("found", "left_out", "candidates"),
        checks=lambda made: (*selection_report.checks(made), *made_checks(name, made)),
        self_tests=self_tests,
        tables=tables,
        figures=figures,
        tree=partial(four_bar_tree, name),
        warnings=warnings,
        mechanism=own_machine,
    )
