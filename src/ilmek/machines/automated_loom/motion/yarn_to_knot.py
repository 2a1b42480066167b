"""How the yarn's path becomes its knot: the path at five instants with its crossing word, and the knot of the last.

The word lists the warps behind which the yarn passes; a step there and back cancels. What is left when both ends are in
the pile identifies the knot.                                             [`weaving.knots.word`, `weaving.knots.proof`]
"""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.knot import led_between
from ilmek.machines.weaver.motions import CENTRE_MOTION, SIDE_MOTION
from ilmek.report import Dot, Drawing, Stroke
from ilmek.timing.track import sample
from ilmek.units import format_quantity, turn
from ilmek.weaving.knots.crossings import WarpRow, crossings
from ilmek.weaving.knots.path import KnotDimensions, knot_path, warp_positions
from ilmek.weaving.knots.word import reduced

_SAMPLES = 1601
_RING = np.exp(1j * turn * np.arange(36) / 36)

_APART = 1.6
"""Distance of two pictures, in widths of one."""

_COLUMNS = 3

_LOOSE = 1.4
"""Least pitch at which the tied knot is drawn, in diameters of warp and yarn together."""

_TIED_WIDE = 4
"""Width of the picture of the tied knot, in pitches of the warps."""


def yarn_to_knot(loom: LoomDesign) -> Drawing:
    """The pictures side by side, the pile upwards, of a head whose grippers tie a knot."""
    weaver = loom.weaver
    by = weaver.grippers
    assert weaver.tied.knot is not None
    wide = _APART * 2 * max(abs(by.warps[-1].real), by.axis + by.arm)
    low = -1j * 1.6 * (by.crossing - by.front)
    strokes: list[Stroke] = []
    dots: list[Dot] = []
    for number, angle in enumerate(_instants(weaver)):
        moved = _corner(number, wide)
        points = _path(weaver, angle)
        strokes += [Stroke(moved + warp + by.warp / 2 * _RING, "outline", closed=True) for warp in by.warps]
        strokes.append(Stroke(moved + points[:: max(1, len(points) // 200)], "yarn"))
        word = reduced(crossings(WarpRow(by.warps, by.warp / 2), points))
        dots.append(Dot(moved + low, f"{format_quantity(angle, 'deg', 3)}: {_text(word)}", "point"))
    dots += [Dot(complex(warp), str(number), "point") for number, warp in enumerate(by.warps, 1)]
    moved = _corner(len(_instants(weaver)), wide)
    loose = max(weaver.params.quality.warp_pitch, _LOOSE * (by.warp + by.yarn))
    larger = max(1, int(wide / (_TIED_WIDE * loose)))
    strokes += _tied(weaver, moved, loose, larger)
    dots.append(Dot(moved + low, f"{weaver.tied.knot.kind} knot", "point"))
    note = (
        "by cam angle: the warps behind which the yarn passes, + to the right, - to the left, without what cancels; "
        f"last: the knot of that word, loose and {larger} times larger"
    )
    return Drawing("loom-yarn-to-knot", "From the yarn's path to its knot", tuple(strokes), tuple(dots), note=note)


def _corner(number: int, wide: float) -> complex:
    """Position of a picture [m]: from left to right, the first row on top."""
    return complex((number % _COLUMNS) * wide, -(number // _COLUMNS) * wide)


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
    side = by.tip(sample(tracks.track(SIDE_MOTION), np.linspace(grasped, min(until, taken), _SAMPLES)).position)
    left = side
    if until > taken:
        centre = sample(tracks.track(CENTRE_MOTION), np.linspace(taken, until, _SAMPLES)).position
        left = np.concatenate([side, by.centre(centre)])
    return np.concatenate([left[::-1], -np.conj(left)])


def _text(word: tuple[int, ...]) -> str:
    return " ".join(f"{letter:+d}" for letter in word) or "no crossing"


def _tied(weaver: Weaver, moved: complex, pitch: float, larger: int) -> list[Stroke]:
    """The knot on warps at a pitch [m] at which its curve fits, so many times larger."""
    by, knot = weaver.grippers, weaver.tied.knot
    assert knot is not None
    axes = warp_positions(tuple(range(1, len(by.warps) + 1)), pitch)
    strokes = [Stroke(moved + larger * (at - axes.mean() + by.warp / 2 * _RING), "outline", closed=True) for at in axes]
    size = KnotDimensions(pitch, by.warp, by.yarn, leg=2 * pitch)
    path = knot_path(knot, size)
    line = path.point(path.distances(size.radius / 10)) - axes.mean()
    return [*strokes, Stroke(moved + larger * line, "yarn")]
