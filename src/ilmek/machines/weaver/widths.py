"""Widths of a head along the row, by the stations of its cams and of its belt."""

from ilmek.machines.weaver.params import WeaverParams
from ilmek.units import mm

STATIONS = 6
"""Stations of cams on a cam shaft; where arms tie, three stay empty."""

BELT = 10 * mm
"""Width of the belt that drives the cam shaft [m]."""


def stack_width(params: WeaverParams) -> float:
    """Width of the cams on their shaft and of its pulley, with their gaps, between the side plates [m]."""
    return STATIONS * params.cam_thickness + BELT + (STATIONS + 2) * params.cam_gap


def case_width(params: WeaverParams) -> float:
    """Width of the case about the cams, over the side plates [m]."""
    return stack_width(params) + 2 * params.side_plate
