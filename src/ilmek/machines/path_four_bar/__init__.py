"""A four-bar for a path: its tracer passes given points, as near as possible, or exactly at given crank angles.

Any 4 to 200 points are searched for the nearest four-bars within limits; 3 to 5 points at given crank angles, nine
points, and poses and points together are also met exactly, by all four-bars that do.
"""

from functools import partial

from ilmek.machines import SUMMARIES
from ilmek.machines.component import Component, itself
from ilmek.machines.four_bar_figures import own_machine
from ilmek.machines.four_bar_tree import four_bar_tree
from ilmek.machines.path_four_bar.design import PathFourBar, design
from ilmek.machines.path_four_bar.params import PathFourBarParams
from ilmek.machines.path_four_bar.report import figures, tables, warnings
from ilmek.synthesis.selection import FourBarSelection
from ilmek.synthesis.selection_report import checks

__all__ = ["MACHINE", "PathFourBar", "PathFourBarParams", "design"]

MACHINE = Component(
    name="path-four-bar",
    title="Four-bar for a path",
    summary=SUMMARIES["path-four-bar"],
    params=PathFourBarParams,
    design=design,
    long_design=design,
    analysis=itself,
    results=lambda made: (made, made.choice),
    reported=(PathFourBar, FourBarSelection),
    headline=("found", "left_out", "candidates"),
    checks=checks,
    tables=tables,
    figures=figures,
    tree=partial(four_bar_tree, "path-four-bar"),
    warnings=warnings,
    mechanism=own_machine,
)
