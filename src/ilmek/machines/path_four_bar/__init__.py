"""A four-bar for a path: its tracer passes given points, as near as possible, or exactly at given crank angles.

Any 4 to 200 points are searched for the nearest four-bars within limits; 3 to 5 points at given crank angles, nine
points, and poses and points together are also met exactly, by all four-bars that do.
"""

from ilmek.machines.four_bar_machine import four_bar_machine
from ilmek.machines.path_four_bar.design import PathFourBar, design
from ilmek.machines.path_four_bar.params import PathFourBarParams
from ilmek.machines.path_four_bar.report import figures, tables, warnings

__all__ = ["MACHINE", "PathFourBar", "PathFourBarParams", "design"]

MACHINE = four_bar_machine(
    "path-four-bar",
    PathFourBarParams,
    PathFourBar,
    design,
    long_design=design,
    tables=tables,
    figures=figures,
    warnings=warnings,
)
