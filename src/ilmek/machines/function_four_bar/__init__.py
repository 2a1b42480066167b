"""A four-bar for a function: its rocker shows y = f(x) where its crank shows x.

Exact at three to five points (interpolation), or best over the whole range by least squares or by the greatest error,
with the alternation that proves it.
"""

from ilmek.machines.four_bar_machine import four_bar_machine
from ilmek.machines.function_four_bar.design import FunctionFourBar, design
from ilmek.machines.function_four_bar.params import FunctionFourBarParams
from ilmek.machines.function_four_bar.report import figures, self_tests, tables

__all__ = ["MACHINE", "FunctionFourBar", "FunctionFourBarParams", "design"]

MACHINE = four_bar_machine(
    "function-four-bar",
    FunctionFourBarParams,
    FunctionFourBar,
    design,
    tables=tables,
    figures=figures,
    self_tests=self_tests,
)
