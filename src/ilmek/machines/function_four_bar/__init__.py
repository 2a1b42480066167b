"""A four-bar for a function: its rocker shows y = f(x) where its crank shows x.

Exact at three to five points (interpolation), or best over the whole range by least squares or by the greatest error,
with the alternation that proves it.
"""

from functools import partial

from ilmek.machines import SUMMARIES
from ilmek.machines.component import Component, itself
from ilmek.machines.four_bar_figures import own_machine
from ilmek.machines.four_bar_tree import four_bar_tree
from ilmek.machines.function_four_bar.design import FunctionFourBar, design
from ilmek.machines.function_four_bar.params import FunctionFourBarParams
from ilmek.machines.function_four_bar.report import figures, self_tests, tables
from ilmek.synthesis.selection import FourBarSelection
from ilmek.synthesis.selection_report import checks, warnings

__all__ = ["MACHINE", "FunctionFourBar", "FunctionFourBarParams", "design"]

MACHINE = Component(
    name="function-four-bar",
    title="Four-bar for a function",
    summary=SUMMARIES["function-four-bar"],
    params=FunctionFourBarParams,
    design=design,
    analysis=itself,
    results=lambda made: (made, made.choice),
    reported=(FunctionFourBar, FourBarSelection),
    headline=("found", "left_out", "candidates"),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    tree=partial(four_bar_tree, "function-four-bar"),
    warnings=warnings,
    mechanism=own_machine,
)
