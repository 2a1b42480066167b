"""The stations of a head's cams along their shaft, and how a plate of a station is shared by a lever and its cheeks.

From the weaver's left to right: gap and cam in turn, and a gap. The order keeps the tools' ways apart: the sley passes
beside the opener at the left, the pile handler turns at the right, the grippers' levers are next to the middle.
"""

from ilmek.elements.pin_joints import side_play
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import CASE
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.widths import stack_width

ORDER = ((SLEY,), (SIDE_GRASP,), (SIDE_MOTION, OPENER), (CENTRE_MOTION,), (CENTRE_GRASP,), (HANDLER,))
"""Tracks whose cams may be in each station."""

HALF_SHARE = 0.75
"""Half the depth of a follower over its roller's radius; assumed by this project."""


def station(weaver: Weaver, track: str) -> float:
    """The middle of a track's cam along the row [m], 0 in the middle of the head."""
    params, rank = weaver.params, next(rank for rank, tracks in enumerate(ORDER) if track in tracks)
    return -stack_width(params) / 2 + (rank + 1) * params.cam_gap + (rank + 0.5) * params.cam_thickness


def belt_station(weaver: Weaver) -> float:
    """Where the belt begins along the row [m], at the right of the last cam."""
    return stack_width(weaver.params) / 2 - weaver.params.cam_gap - weaver.belt.width


def lever_thickness(weaver: Weaver) -> float:
    """Thickness of a lever, in the middle of its cam's plane [m]."""
    return weaver.params.cam_thickness / 2


def cheek(weaver: Weaver) -> float:
    """Thickness of each of the two cheeks beside a lever [m]."""
    quarter, free = weaver.params.cam_thickness / 4, side_play(lever_thickness(weaver)) / 2
    return max(quarter - free, quarter / 2)


def follower_half(weaver: Weaver) -> float:
    """Half the depth of a follower's bar [m]."""
    return HALF_SHARE * weaver.params.roller_radius


def sheet(weaver: Weaver) -> float:
    """Thickness of face and plates across [m]: that of the side plates, where the cams leave so much room; 0: none."""
    return min(weaver.params.side_plate, 0.8 * CASE)
