"""How the yarn's path becomes its knot, of a head whose grippers tie one [`machines.knot_pictures`]."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.knot_pictures import KnotPictures
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.knot import led_between
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION
from ilmek.report import Drawing
from ilmek.timing.track import sample
from ilmek.units import format_quantity

_SAMPLES = 1601

_APART = 1.6
"""Distance of two pictures, in widths of one."""


def yarn_to_knot(loom: LoomDesign) -> Drawing:
    """The pictures side by side, the pile upwards, of a head whose grippers tie a knot."""
    weaver = loom.weaver
    by = weaver.grippers
    assert weaver.tied.knot is not None
    pictures = KnotPictures(
        warps=by.warps,
        knot=weaver.tied.knot,
        pitch=weaver.params.quality.warp_pitch,
        warp=by.warp,
        yarn=by.yarn,
        wide=_APART * 2 * max(abs(by.warps[-1].real), by.axis + by.arm),
        low=1.6 * (by.crossing - by.front),
        instants=[(format_quantity(angle, "deg", 3), _path(weaver, angle)) for angle in _instants(weaver)],
    )
    return pictures.drawn("loom-yarn-to-knot", "cam angle")


def _instants(weaver: Weaver) -> tuple[float, ...]:
    """Cam angles: the yarn grasped, half round the warps, round them, taken by the centre gripper, released."""
    grasped, taken, released = led_between(weaver.cyclogram)
    cross = weaver.cyclogram.track(SIDE_MOTION).segment("cross")
    back = weaver.cyclogram.track(CENTRE_MOTION).segment("return")
    return grasped, 0.5 * (cross.start + cross.end), taken, 0.5 * (back.start + back.end), released


def _path(weaver: Weaver, until: float) -> ComplexArray:
    """The yarn's path at a cam angle [rad]: the left end's path backwards, then the right end's [m]."""
    by, tracks = weaver.grippers, weaver.cyclogram
    grasped, taken, _ = led_between(tracks)
    side = sample(tracks.track(SIDE_MOTION), np.linspace(grasped, min(until, taken), _SAMPLES)).position
    ends = [by.tip(side, hand) for hand in (-1, 1)]
    if until > taken:
        centre = sample(tracks.track(CENTRE_MOTION), np.linspace(taken, until, _SAMPLES)).position
        ends = [np.concatenate([end, by.centre(centre)]) for end in ends]
    return np.concatenate([ends[0][::-1], ends[1]])
