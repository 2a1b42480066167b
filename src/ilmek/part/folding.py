"""Sheet that is bent along parallel lines: its section, its bends, and what it is cut from.

    flat width = sum of the flanks + sum of |angle| (r + K t),   2 K = 0.65 + lg(r / t) / 2, at most 1        [DIN 6935]

with the inner radius r and the thickness t; the layer at K t from the inner side keeps its length.
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.shapes import Prism
from ilmek.plane.contours import STRAIGHT, arc_centre, counter_clockwise, polygon
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.report import Contour, Plate

_SAME = 1e-7
"""Lengths nearer than this are equal [m]."""


@record
class Bend:
    """A bend: by which angle [rad], above 0 towards the side that the flat pattern shows; inner radius, and the
    distance of its middle from the first edge of the flat pattern [m].
    """

    angle: float
    radius: float
    middle: float


@record
class FoldedSheet:
    """A bent sheet: thickness, width of the flat pattern across the bends, its length along them [m], and its bends."""

    thickness: float
    width: float
    length: float
    bends: tuple[Bend, ...]

    @property
    def plate(self) -> Plate:
        """The flat pattern, x along the bends, with their middles as lines to scribe."""
        corners = np.array([0, self.length, complex(self.length, self.width), 1j * self.width])
        lines = {
            f"bend {number}": np.array([0, self.length]) + 1j * bend.middle for number, bend in enumerate(self.bends, 1)
        }
        return Plate("", "", polygon(corners), self.thickness, "", marks=lines)


def neutral_share(radius: float, thickness: float) -> float:
    """K: share of the thickness, from the inner side, at which a bend keeps its length.

    >>> neutral_share(2e-3, 2e-3), neutral_share(20e-3, 2e-3)
    (0.325, 0.5)
    """
    return min(0.65 + 0.5 * math.log10(radius / thickness), 1.0) / 2


def folded_section(line: ComplexArray, thickness: float, radius: float) -> Contour:
    """The section of a sheet that lies to the left of an open line [m], bent at its corners with an inner radius [m].

    >>> section = folded_section(np.array([0.02j, 0, 0.03]), 0.002, 0.002)
    >>> len(section.points)
    8
    """
    along = np.diff(line) / np.abs(np.diff(line))
    normals = 1j * np.concatenate([along[:1], along, along[-1:]])
    mitres = (normals[:-1] + normals[1:]) / (1 + (normals[:-1] * normals[1:].conj()).real)
    points: list[complex] = []
    bulges: list[float] = []
    for nodes in (line, (line + thickness * mitres)[::-1]):
        ways = np.diff(nodes) / np.abs(np.diff(nodes))
        turns = np.angle(ways[1:] / ways[:-1])
        points.append(complex(nodes[0]))
        bulges.append(0.0)
        for node, before, after, turn in zip(nodes[1:-1], ways, ways[1:], turns.tolist(), strict=False):
            reach = (radius + thickness * (turn > 0)) * math.tan(abs(turn) / 2)
            points += [node - reach * before, node + reach * after]
            bulges += [math.tan(turn / 4), 0.0]
        points.append(complex(nodes[-1]))
        bulges.append(0.0)
    return Contour(np.array(points), np.array(bulges))


def folded_sheet(shape: object) -> FoldedSheet | None:
    """The bends of a prism along its length, read from the arcs of its section; None: it is no bent sheet.

    >>> from ilmek.part.profile import Profile
    >>> shape = Prism(Profile(folded_section(np.array([0.02j, 0, 0.03]), 0.002, 0.002)), 0.1)
    >>> sheet = folded_sheet(shape)
    >>> round(sheet.width, 6), [round(math.degrees(bend.angle), 6) for bend in sheet.bends]
    (0.046163, [90.0])
    """
    if not isinstance(shape, Prism) or shape.section.smooth or shape.section.holes:
        return None
    outline = counter_clockwise(shape.section.outline)
    starts, ends, bulges = outline.points, following(outline.points), outline.bulges
    half = len(starts) // 2
    arcs = np.abs(bulges) > STRAIGHT
    if len(starts) % 4 or half < 4 or 2 * int(arcs.sum()) != len(starts) - 4:
        return None
    sizes, read = np.abs(ends - starts), list[FoldedSheet]()
    for first in range(len(starts)):
        order = (first + np.arange(len(starts))) % len(starts)
        there, back = order[1:half], order[:half:-1]
        if not arcs[there].tolist() == arcs[back].tolist() == [k % 2 == 1 for k in range(half - 1)]:
            continue
        bends = [_bend(outline, int(one), int(other)) for one, other in zip(there[1::2], back[1::2], strict=True)]
        thickness = float(sizes[first])
        walls = [outer - inner for _, inner, outer in bends]
        if np.ptp([*walls, thickness, float(sizes[order[half]])]) < _SAME:
            read.append(_unfolded(thickness, shape.length, sizes[there[::2]].tolist(), [bend[:2] for bend in bends]))
    return max(read, key=lambda sheet: sum(bend.angle for bend in sheet.bends), default=None)


def _bend(outline: Contour, one: int, other: int) -> tuple[float, float, float]:
    """Angle, inner and outer radius of a bend, by the numbers of both its arcs; radii of nan: they are not about one
    centre.
    """
    after = following(outline.points)
    ends = [(complex(outline.points[k]), complex(after[k]), float(outline.bulges[k])) for k in (one, other)]
    centres = [arc_centre(*each) for each in ends]
    inner, outer = sorted(abs(start - centre) for (start, *_), centre in zip(ends, centres, strict=True))
    alike = abs(centres[0] - centres[1]) < _SAME
    return 4 * math.atan(ends[0][2]), inner if alike else math.nan, outer


def _unfolded(thickness: float, length: float, flanks: list[float], bends: list[tuple[float, float]]) -> FoldedSheet:
    middle, placed = 0.0, []
    for flank, (angle, radius) in zip(flanks, bends, strict=False):
        arc = abs(angle) * (radius + neutral_share(radius, thickness) * thickness)
        placed.append(Bend(angle, radius, middle + flank + arc / 2))
        middle += flank + arc
    return FoldedSheet(thickness, middle + flanks[-1], length, tuple(placed))
