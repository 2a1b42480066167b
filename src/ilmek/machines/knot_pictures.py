"""How the yarn's path becomes its knot: the path at some instants with its crossing word, and the knot of the last.

The word lists the warps behind which the yarn passes; a step there and back cancels. What is left when both ends are in
the pile identifies the knot.                                             [`weaving.knots.word`, `weaving.knots.proof`]
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import turn
from ilmek.weaving.knots.crossings import WarpRow, crossings
from ilmek.weaving.knots.path import KnotDimensions, knot_path, warp_positions
from ilmek.weaving.knots.word import Knot, Word, reduced

RING = np.exp(1j * turn * np.arange(36) / 36)

_COLUMNS = 3

_LOOSE = 1.4
"""Least pitch at which the tied knot is drawn, in diameters of warp and yarn together."""

_TIED_WIDE = 4
"""Width of the picture of the tied knot, in pitches of the warps."""


@record
class KnotPictures:
    """What the pictures show.

    warps   axes of a few warps in the section [m], numbered from 1      knot  on these      pitch  of the cloth [m]
    warp, yarn  diameters [m]
    wide    distance of two pictures, low  of their text under the warps [m]
    instants  text of each, and the yarn's path until then [m]
    """

    warps: ComplexArray
    knot: Knot
    pitch: float
    warp: float
    yarn: float
    wide: float
    low: float
    instants: Sequence[tuple[str, ComplexArray]]

    def drawn(self, name: str, by: str) -> Drawing:
        """The pictures side by side, the pile upwards; by: what the instants' texts state."""
        strokes: list[Stroke] = []
        dots: list[Dot] = []
        low, row = -1j * self.low, WarpRow(self.warps, self.warp / 2)
        for number, (text, points) in enumerate(self.instants):
            moved = _corner(number, self.wide)
            strokes += [Stroke(moved + warp + self.warp / 2 * RING, "outline", closed=True) for warp in self.warps]
            strokes.append(Stroke(moved + points[:: max(1, len(points) // 200)], "yarn"))
            dots.append(Dot(moved + low, f"{text}: {_text(reduced(crossings(row, points)))}", "point"))
        dots += [Dot(complex(warp), str(number), "point") for number, warp in enumerate(self.warps, 1)]
        moved = _corner(len(self.instants), self.wide)
        loose = max(self.pitch, _LOOSE * (self.warp + self.yarn))
        larger = max(1, int(self.wide / (_TIED_WIDE * loose)))
        strokes += self._tied(moved, loose, larger)
        dots.append(Dot(moved + low, f"{self.knot.kind} knot", "point"))
        note = (
            f"by {by}: the warps behind which the yarn passes, + to the right, - to the left, without what cancels; "
            f"last: the knot of that word, loose and {larger} times larger"
        )
        return Drawing(name, "From the yarn's path to its knot", tuple(strokes), tuple(dots), note=note)

    def _tied(self, moved: complex, pitch: float, larger: int) -> list[Stroke]:
        """The knot on warps at a pitch [m] at which its curve fits, so many times larger."""
        axes = warp_positions(tuple(range(1, len(self.warps) + 1)), pitch)
        middle = axes.mean()
        strokes = [Stroke(moved + larger * (at - middle + self.warp / 2 * RING), "outline", closed=True) for at in axes]
        size = KnotDimensions(pitch, self.warp, self.yarn, leg=2 * pitch)
        path = knot_path(self.knot, size)
        line = path.point(path.distances(size.radius / 10)) - middle
        return [*strokes, Stroke(moved + larger * line, "yarn")]


def _corner(number: int, wide: float) -> complex:
    """Position of a picture [m]: from left to right, the first row on top."""
    return complex((number % _COLUMNS) * wide, -(number // _COLUMNS) * wide)


def _text(word: Word) -> str:
    return " ".join(f"{letter:+d}" for letter in word) or "no crossing"
