"""Widths of a head along the row, by its cams."""

from ilmek.machines.weaver.params import WeaverParams
from ilmek.units import mm

BELT = 9 * mm
"""Width of the belt that drives the cam shaft [m]."""


def stack_width(params: WeaverParams, number: int) -> float:
    """Width of a number of cams on their shaft and of its pulley, with their gaps, between the side plates [m]."""
    return number * params.cam_thickness + BELT + (number + 2) * params.cam_gap


def case_width(params: WeaverParams, number: int) -> float:
    """Width of the case about a number of cams, over the side plates [m]."""
    return stack_width(params, number) + 2 * params.side_plate
