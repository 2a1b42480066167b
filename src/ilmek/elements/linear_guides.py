"""Profiled rails with ball carriages: sizes and load ratings of usual series.

Sizes are those that makers have in common (miniature series 9 and 12, standard series 15 to 25); load ratings and
masses differ between makers by some per cent, those here are typical catalogue values.
"""

from dataclasses import dataclass

from ilmek.units import kN, mm


@dataclass(frozen=True, slots=True)
class LinearGuide:
    """A rail with its carriages.

    rail, rail_height       width and height of the rail [m]          line_mass   of the rail [kg/m]
    block, block_length     width and length of a carriage [m]        block_mass  of a carriage [kg]
    height                  from the rail's base to the top of its carriage [m]
    dynamic, static         load ratings of a carriage [N]
    pitch, rail_screw       of the holes of the rail [m], and their screws, by name
    holes                   distances of the four threads of a carriage, across and along [m]; block_screw  their name
    """

    name: str
    rail: float
    rail_height: float
    line_mass: float
    block: float
    block_length: float
    block_mass: float
    height: float
    dynamic: float
    static: float
    pitch: float
    rail_screw: str
    holes: tuple[float, float]
    block_screw: str


_ROWS = """
size-9 9 6.5 0.38 20 39.9 0.026 10 2.55 4.02 20 M3 15 10 M3
size-12 12 8 0.65 27 45.4 0.054 13 3.72 5.88 25 M3 20 15 M3
size-15 15 15 1.45 34 61.4 0.18 28 11.4 17.0 60 M4 26 26 M4
size-20 20 17.5 2.21 44 77.5 0.30 30 17.8 27.8 60 M5 32 36 M5
size-25 23 22 3.21 48 84.0 0.51 40 26.5 36.5 60 M6 35 35 M6
"""


def _row(line: str) -> LinearGuide:
    name, *values = line.split()
    *values, pitch, rail_screw, across, along, block_screw = values
    rail, tall, line_mass, block, long, mass, height, dynamic, static = map(float, values)
    sizes = (rail * mm, tall * mm, line_mass, block * mm, long * mm, mass, height * mm, dynamic * kN, static * kN)
    holes = float(across) * mm, float(along) * mm
    return LinearGuide(name, *sizes, float(pitch) * mm, rail_screw, holes, block_screw)


LINEAR_GUIDES = tuple(_row(line) for line in _ROWS.split("\n") if line)
"""In ascending order of their height."""


def guide_of_height(least: float) -> LinearGuide:
    """The lowest guide of at least a height [m]; the highest where none is."""
    return next((row for row in LINEAR_GUIDES if row.height >= least * (1 - 1e-9)), LINEAR_GUIDES[-1])
