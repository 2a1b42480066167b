"""Widths of a head along the row, by the stations of its cams and of its belt."""

from ilmek.machines.weaver.params import WeaverParams

STATIONS = 6
"""Stations of cams on a cam shaft; where arms tie, three stay empty."""


def stack_width(params: WeaverParams) -> float:
    """Width of the cams on their shaft and of its pulley, with their gaps, between the side plates [m]."""
    return STATIONS * params.cam_thickness + params.cam_belt + (STATIONS + 2) * params.cam_gap


def case_width(params: WeaverParams) -> float:
    """Width of the case about the cams, over the side plates [m]."""
    return stack_width(params) + 2 * params.side_plate
