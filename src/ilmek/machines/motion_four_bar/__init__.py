"""A four-bar for a motion: its coupler takes three, four or five poses exactly.

Three poses leave both pivots (or both pins) free, four leave a curve of them: the family of all pairs is searched
within the limits, and the best that differ are reported. Five leave a few links: all their pairs are judged.
"""

from functools import partial

from ilmek.machines import SUMMARIES
from ilmek.machines.component import Component, itself
from ilmek.machines.four_bar_figures import own_machine
from ilmek.machines.four_bar_tree import four_bar_tree
from ilmek.machines.motion_four_bar.design import MotionFourBar, design
from ilmek.machines.motion_four_bar.params import MotionFourBarParams
from ilmek.machines.motion_four_bar.report import figures, self_tests, tables, warnings
from ilmek.synthesis.selection import FourBarSelection
from ilmek.synthesis.selection_report import checks

__all__ = ["MACHINE", "MotionFourBar", "MotionFourBarParams", "design"]

MACHINE = Component(
    name="motion-four-bar",
    title="Four-bar for a motion",
    summary=SUMMARIES["motion-four-bar"],
    params=MotionFourBarParams,
    design=design,
    long_design=design,
    analysis=itself,
    results=lambda made: (made, made.choice),
    reported=(MotionFourBar, FourBarSelection),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    tree=partial(four_bar_tree, "motion-four-bar"),
    warnings=warnings,
    mechanism=own_machine,
    headline=("found", "left_out", "candidates"),
)
