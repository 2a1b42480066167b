"""Widths of a head along the row, by the stations of its cams and of its belt."""

import math

from ilmek.elements.pin_joints import side_play
from ilmek.machines.weaver.params import WeaverParams
from ilmek.units import mm

STATIONS = 6
"""Stations of cams on a cam shaft; where arms tie, three stay empty."""


def stack_width(params: WeaverParams) -> float:
    """Width of the cams on their shaft and of its pulley, with their gaps, between the side plates [m]."""
    return STATIONS * params.cam_thickness + params.cam_belt + (STATIONS + 2) * params.cam_gap


CHEEK_SHARE, LEAST_CHEEK = 0.4, 0.1 * mm
"""By how much a follower's fork stands out beside its cam, over the gap of the cams, and where these have none [m]."""

ROLLER_INSET, INSET_SHARE = 1 * mm, 1 / 8
"""By how much a roller is narrower than its cam on each side [m], at most this share of it; assumed by this project."""


def fork_beside(params: WeaverParams) -> float:
    """By how much a fork stands out beside its cam [m]."""
    return max(CHEEK_SHARE * params.cam_gap, LEAST_CHEEK)


def roller_width(params: WeaverParams) -> float:
    """Width of a cam's roller [m], in tenths of a millimetre: the cheeks of its fork take the rest, and the play."""
    thick = params.cam_thickness
    gap = thick - 2 * min(ROLLER_INSET, INSET_SHARE * thick)
    free = gap - side_play(gap)
    return max(math.floor(free / (0.1 * mm) + 1e-9), 1) * 0.1 * mm


def case_width(params: WeaverParams) -> float:
    """Width of the case about the cams, over the side plates [m]."""
    return stack_width(params) + 2 * params.side_plate
