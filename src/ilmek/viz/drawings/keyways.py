"""Dimensions of keyways: width with angle, and the distance of the floor from the opposite side."""

import cmath
import math

from ilmek.elements.fits import tolerance_grade
from ilmek.part.tolerances import FeatureKind
from ilmek.plane.contours import KeyedCircle
from ilmek.report.sheet import DimensionKind
from ilmek.sentences import Sentence
from ilmek.viz.drawings.fits import Fits, limits
from ilmek.viz.drawings.picture import millimetres
from ilmek.viz.drawings.view import DrawnView

_GROOVE = 12
"""Grade of the width of a groove that is no keyway of DIN 6885; assumed by this project."""

_KEYWAYS = {FeatureKind.BORE: FeatureKind.HUB_KEYWAY, FeatureKind.JOURNAL: FeatureKind.SHAFT_KEYWAY}


def keyway(
    view: DrawnView, bore: KeyedCircle, fits: Fits, kind: FeatureKind, seat: tuple[float, float] | None = None
) -> None:
    """Width of the keyways, with their angle from +x, and the distance of their floor from the opposite side.

    seat  of a shaft: from its end on the left to the keyway, and the length of that [m]; None: all through
    """
    turn = bore.directions[0]
    corners = [bore.centre + turn * complex(bore.floor, side * bore.width / 2) for side in (-1, 1)]
    count = len(bore.directions)
    times = f"{count}× " if count > 1 else ""
    at = ", ".join(f"{round(math.degrees(cmath.phase(direction)), 3) + 0.0:.4g}°" for direction in bore.directions)
    ends = (corners[0] * view.scale, corners[1] * view.scale)
    note = fits.note(bore.width, _KEYWAYS[kind])
    words, name = (note.words, "sheet.keyway") if note.words else (_groove_limits(bore.width), "sheet.groove")
    width = Sentence(name, times=times, size=f"{millimetres(bore.width)}{words}", at=at)
    if seat is not None:
        begin, length = map(millimetres, seat)
        width = Sentence("sheet.keyway-seat", keyway=width, length=length, begin=begin)
    view.leader(
        width, ends[1], 0.0, kind=DimensionKind.ALIGNED, value=bore.width, count=count, measured=ends, note=note
    )  # fmt: skip
    across = ((bore.centre - turn * bore.radius) * view.scale, (bore.centre + turn * bore.floor) * view.scale)
    floor = Sentence("sheet.floor", size=f"{millimetres(bore.radius + bore.floor)}{fits.depth(bore.width)}")
    view.leader(
        floor, across[1], 0.0, kind=DimensionKind.ALIGNED, value=bore.radius + bore.floor, measured=across
    )  # fmt: skip


def _groove_limits(width: float) -> str:
    """Class and deviations of the width of a groove that is no keyway: H12."""
    return f" H{_GROOVE}{limits(0.0, tolerance_grade(_GROOVE, width))}"
