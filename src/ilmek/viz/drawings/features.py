"""Features of a contour that a drawing dimensions: corners, arcs, patterns of holes."""

import math
from collections.abc import Callable, Hashable, Sequence

import numpy as np

from ilmek.plane.contours import STRAIGHT, arc_centre, as_hole, counter_clockwise
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.report import Contour, Hole

SAME = 1e-7
"""Lengths nearer than this are equal [m]."""

_SMOOTH = 1e-5
"""Angle between two pieces below which the one goes over into the other [rad]."""


@record
class ArcFeature:
    """An arc: centre, radius, its ends counter-clockwise about the centre, and whether it is a hollow [m]."""

    centre: complex
    radius: float
    ends: tuple[complex, complex]


@record
class ContourFeatures:
    """Corners that are sharp, and arcs [m]."""

    corners: tuple[complex, ...]
    arcs: tuple[ArcFeature, ...]

    @property
    def points(self) -> tuple[complex, ...]:
        """What has coordinates: corners and centres."""
        return (*self.corners, *dict.fromkeys(arc.centre for arc in self.arcs))

    @property
    def fully(self) -> bool:
        """Whether a drawing can dimension each of them."""
        return len(self.points) + len(self.arcs) <= MOST_FEATURES


MOST_FEATURES = 36
"""Corners and arcs of a contour that is dimensioned; one with more is cut by its file."""


def contour_features(contour: Contour) -> ContourFeatures:
    """The corners of a contour at which its direction changes, and its arcs.

    >>> from ilmek.plane.contours import rounded_hull
    >>> bar = contour_features(rounded_hull(np.array([0, 0.2 + 0j]), 0.02))
    >>> len(bar.corners), sorted((round(arc.centre.real, 9), arc.radius) for arc in bar.arcs)
    (0, [(0.0, 0.02), (0.2, 0.02)])
    """
    contour = counter_clockwise(contour)
    starts, ends, half = contour.points, following(contour.points), 2 * np.arctan(contour.bulges)
    chords = (ends - starts) / np.abs(ends - starts)
    leaving, arriving = chords * np.exp(-1j * half), chords * np.exp(1j * half)
    turn = np.abs(np.angle(leaving / np.roll(arriving, 1)))
    corners = tuple(complex(point) for point in starts[turn > _SMOOTH])
    arcs = []
    for start, end, bulge in zip(starts.tolist(), ends.tolist(), contour.bulges.tolist(), strict=True):
        if abs(bulge) > STRAIGHT:
            centre = arc_centre(start, end, bulge)
            arcs.append(ArcFeature(centre, abs(start - centre), (start, end) if bulge > 0 else (end, start)))
    return ContourFeatures(corners, tuple(arcs))


def square_of(contour: Contour) -> tuple[complex, complex] | None:
    """Centre of a square, and one of its sides as a vector [m]; None: it is another contour.

    >>> square_of(Contour(np.array([0j, 2 + 0j, 2 + 2j, 2j]), np.zeros(4)))
    ((1+1j), (2+0j))
    """
    sides = following(contour.points) - contour.points
    if len(sides) != 4 or contour.bulges.any() or np.abs(sides[1:] / sides[:-1] - sides[1] / sides[0]).max() > 1e-6:
        return None
    quarter = abs(abs((sides[1] / sides[0]).imag) - 1) < 1e-6
    return (complex(contour.points.mean()), complex(sides[0])) if quarter else None


@record
class HoleGroup:
    """Round holes of one size [m]; on a pitch circle about `centre` where `pitch` is above 0, evenly spread."""

    holes: tuple[Hole, ...]
    centre: complex = 0j
    pitch: float = 0.0

    @property
    def radius(self) -> float:
        """Radius of each [m]."""
        return self.holes[0].radius


def hole_groups(holes: Sequence[Hole], classes: Callable[[Hole], Hashable]) -> tuple[HoleGroup, ...]:
    """The holes by size and what they must hold, those of one pitch circle as one group."""
    sizes: dict[tuple[float, Hashable], list[Hole]] = {}
    for hole in holes:
        sizes.setdefault((round(hole.radius, 8), classes(hole)), []).append(hole)
    return tuple(_pattern(tuple(group)) for group in sizes.values())


def _pattern(holes: tuple[Hole, ...]) -> HoleGroup:
    centres = np.array([hole.at for hole in holes])
    middle = complex(centres.mean())
    if len(holes) < 3:
        return HoleGroup(holes)
    radii, angles = np.abs(centres - middle), np.sort(np.angle(centres - middle))
    gaps = np.diff(np.append(angles, angles[0] + 2 * math.pi))
    even = np.ptp(radii) < SAME and np.ptp(gaps) < 1e-6
    return HoleGroup(holes, middle, float(radii[0])) if even and len(holes) > 3 else HoleGroup(holes)


def split_holes(cuts: Sequence[Contour]) -> tuple[tuple[Hole, ...], tuple[Contour, ...]]:
    """Cuts of a section as round holes, and all others."""
    holes = [(cut, as_hole(cut)) for cut in cuts]
    return tuple(hole for _, hole in holes if hole is not None), tuple(cut for cut, hole in holes if hole is None)


def distinct(values: Sequence[float]) -> list[float]:
    """Ascending values, equal ones once."""
    kept: list[float] = []
    for value in sorted(values):
        if not kept or value - kept[-1] > SAME:
            kept.append(value)
    return kept
