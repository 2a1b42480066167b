"""A four-bar for a motion: its coupler takes three, four or five poses exactly.

Three poses leave both pivots (or both pins) free, four leave a curve of them: the family of all pairs is searched
within the limits, and the best that differ are reported. Five leave a few links: all their pairs are judged.
"""

from ilmek.machines.four_bar_machine import four_bar_machine
from ilmek.machines.motion_four_bar.design import MotionFourBar, design
from ilmek.machines.motion_four_bar.params import MotionFourBarParams
from ilmek.machines.motion_four_bar.report import figures, self_tests, tables, warnings

__all__ = ["MACHINE", "MotionFourBar", "MotionFourBarParams", "design"]

MACHINE = four_bar_machine(
    "motion-four-bar",
    MotionFourBarParams,
    MotionFourBar,
    design,
    long_design=design,
    tables=tables,
    figures=figures,
    warnings=warnings,
    self_tests=self_tests,
)
