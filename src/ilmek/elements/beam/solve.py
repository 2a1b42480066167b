"""Solution of a beam: moments over its supports, then the pieces of its deflection curve.

    M₋ l + 2 M₀ (l + l') + M₊ l' = -6 (B + A'),   A = Σ P a b (l + b) / 6 l,   B = Σ P a b (l + a) / 6 l

l, l' spans left and right of a support, M₋, M₀, M₊ moments over it and its neighbours; A and B the slopes x E I at the
left and right end of a span as a simple beam, with loads P at a from the left and b from the right. A clamped end has
no span beyond it. The equations are well conditioned for any number of supports and any density of loads.
                                          [theorem of three moments, Clapeyron; Timoshenko, Strength of Materials I, 46]
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.beam.model import Beam, Couple, LineLoad, PointLoad
from ilmek.elements.beam.result import DEGREE, BeamResult, derived

_GAUSS = tuple((float(node), float(weight)) for node, weight in zip(*np.polynomial.legendre.leggauss(3), strict=True))


@dataclass(frozen=True, slots=True)
class BeamSegment:
    """The beam between two neighbours of its ends and supports, with its loads clipped to it."""

    start: float
    end: float
    points: tuple[PointLoad, ...]
    lines: tuple[LineLoad, ...]
    couples: tuple[Couple, ...]

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.end - self.start

    def forces(self) -> Iterator[tuple[float, complex]]:
        """Distance from the left end [m], and force [N]; a line load counts as three forces."""
        yield from ((load.at - self.start, load.force) for load in self.points)
        for load in self.lines:
            half, middle = (load.end - load.start) / 2, (load.end + load.start) / 2
            for node, weight in _GAUSS:
                x = middle + half * node
                yield x - self.start, weight * half * load.value(x)

    def total(self) -> complex:
        """Sum of its forces [N]."""
        return sum((force for _, force in self.forces()), 0j)

    def turning(self) -> complex:
        """Sum of its couples [N m]."""
        return sum((couple.moment for couple in self.couples), 0j)

    def moment(self) -> complex:
        """Moment of its loads at its right end, with a free left end [N m]."""
        return self.turning() - sum((force * (self.length - a) for a, force in self.forces()), 0j)

    def balancing(self) -> complex:
        """Moment at its left end that balances its loads, with a free right end [N m]."""
        return -self.turning() - sum((force * a for a, force in self.forces()), 0j)

    def slopes(self) -> tuple[complex, complex]:
        """A and B of its loads [N m²]."""
        length, left, right = self.length, 0j, 0j
        for a, force in self.forces():
            both = force * a * (length - a) / (6 * length)
            left, right = left + both * (2 * length - a), right + both * (length + a)
        for couple in self.couples:
            a = couple.at - self.start
            left += couple.moment * (2 * length**2 - 6 * length * a + 3 * a * a) / (6 * length)
            right += couple.moment * (length**2 - 3 * a * a) / (6 * length)
        return left, right


def parts_of(beam: Beam) -> list[BeamSegment]:
    """Left overhang, spans, right overhang, one segment [m] more than supports; overhangs may be empty.

    A load over a support is in the part on its right.
    """
    ends = list(pairwise((0.0, *beam.supports, beam.length)))
    return [_part(beam, start, end, last=number == len(ends) - 1) for number, (start, end) in enumerate(ends)]


def _part(beam: Beam, start: float, end: float, *, last: bool) -> BeamSegment:
    points: list[PointLoad] = []
    lines: list[LineLoad] = []
    couples: list[Couple] = []
    for load in beam.loads:
        if isinstance(load, LineLoad):
            left, right = max(start, load.start), min(end, load.end)
            lines += [LineLoad(left, right, load.value(left), load.value(right))] if left < right else []
        elif start <= load.at and (last or load.at < end):
            points += [load] if isinstance(load, PointLoad) else []
            couples += [load] if isinstance(load, Couple) else []
    return BeamSegment(start, end, tuple(points), tuple(lines), tuple(couples))


def bend(beam: Beam) -> BeamResult:
    """Reactions [N] and the exact deflection curve of a beam under its loads [theorem of three moments].

    beam  positions [m], forces [N], line loads [N/m] and couples [N m]; one plane or, complex, two

    >>> from ilmek.elements.beam.model import LineLoad
    >>> bent = bend(Beam(2.0, (0.0, 1.0, 2.0), (LineLoad(0.0, 2.0, 8.0),)))
    >>> [round(abs(reaction), 9) for reaction in bent.reactions]
    [3.0, 10.0, 3.0]
    """
    parts = parts_of(beam)
    over = _moments(beam, parts)
    starts = _starts(parts, over)
    lines = [_Line(part, moment, shear) for part, (moment, shear) in zip(parts, starts, strict=True)]
    _join(lines)
    leaving = [shear - part.total() for part, (_, shear) in zip(parts, starts, strict=True)]
    reactions = tuple(after - before for before, (_, after) in zip(leaving, starts[1:], strict=False))
    clamps = tuple(complex(-over[0] if at == 0 else over[-1] - parts[-1].balancing()) for at in beam.clamped)
    breaks = np.array([0.0, *(right for line in lines for right in line.rights)])
    return BeamResult(beam, breaks, np.array([row for line in lines for row in line.rows]), reactions, clamps)


def _moments(beam: Beam, parts: list[BeamSegment]) -> ComplexArray:
    """Moments over the supports, on the left of each and within the beam [N m]."""
    spans, count = parts[1:-1], len(beam.supports)
    matrix, known = np.eye(count), np.zeros(count, dtype=complex)
    known[-1] = parts[-1].balancing()
    if count > 1 or beam.length in beam.clamped:
        known[0] = parts[0].moment()
    slopes = [span.slopes() for span in spans]
    for row in range(0.0 not in beam.clamped, count - (beam.length not in beam.clamped)) if spans else ():
        matrix[row, row], known[row] = 0.0, 0j
        for span, far, slope in _beside(row, spans, slopes):
            matrix[row, row] += 2 * span.length
            matrix[row, far] += span.length
            known[row] -= 6 * slope
    return np.asarray(np.linalg.solve(matrix, known))


def _beside(
    row: int, spans: list[BeamSegment], slopes: list[tuple[complex, complex]]
) -> Iterator[tuple[BeamSegment, int, complex]]:
    """The spans left and right of a support, with the index of the next support and the slope at this one."""
    if row > 0:
        yield spans[row - 1], row - 1, slopes[row - 1][1]
    if row < len(spans):
        yield spans[row], row + 1, slopes[row][0]


def _starts(parts: list[BeamSegment], over: ComplexArray) -> list[tuple[complex, complex]]:
    """Moment and shear at the left end of each part, before the loads at this end."""
    spans = zip(parts[1:-1], over[:-1], over[1:], strict=True)
    within = [(complex(first), complex(last - first - span.moment()) / span.length) for span, first, last in spans]
    return [(0j, 0j), *within, (parts[-1].balancing(), parts[-1].total())]


class _Line:
    """The curve of one part: right ends and coefficients of its pieces; initially zero at its left."""

    def __init__(self, part: BeamSegment, moment: complex, shear: complex) -> None:
        ends = {part.start, part.end} | {at for load in part.lines for at in (load.start, load.end)}
        ends |= {load.at for load in part.points} | {couple.at for couple in part.couples}
        lefts = sorted(ends)
        self.length = part.length
        self.lefts, self.rights = [left - part.start for left in lefts[:-1]], lefts[1:]
        self.rows: list[ComplexArray] = []
        self.deflection, self.slope = 0j, 0j
        """At the part's right end."""
        for left, right in pairwise(lefts):
            shear -= sum((load.force for load in part.points if load.at == left), 0j)
            moment += sum((couple.moment for couple in part.couples if couple.at == left), 0j)
            over = [load for load in part.lines if load.start <= left and right <= load.end]
            load, gradient = sum((one.value(left) for one in over), 0j), sum((one.gradient for one in over), 0j)
            row = np.array([self.deflection, self.slope, -moment / 2, -shear / 6, load / 24, gradient / 120])
            self.rows.append(row)
            self.deflection, self.slope, moment, shear = _carried(row, right - left)

    def shift(self, deflection: complex, slope: complex) -> None:
        """Add a deflection and a slope at the part's left end."""
        for left, row in zip(self.lefts, self.rows, strict=True):
            row[0] += deflection + slope * left
            row[1] += slope
        self.deflection += deflection + slope * self.length
        self.slope += slope


def _carried(row: ComplexArray, width: float) -> tuple[complex, complex, complex, complex]:
    """E I times deflection and slope, moment and shear at a piece's right end."""
    powers = width ** np.arange(DEGREE + 1)
    y, slope, bend, shear = (complex(np.dot(derived(row, order), powers[: DEGREE + 1 - order])) for order in range(4))
    return y, slope, -bend, -shear


def _join(lines: list[_Line]) -> None:
    """Shift every part for zero deflection at the supports and a continuous slope; a clamped end has zero slope."""
    left, *spans, right = lines
    for span in spans:
        span.shift(0j, -span.deflection / span.length)
    start = complex(spans[0].rows[0][1]) if spans else 0j
    right.shift(0j, spans[-1].slope if spans else 0j)
    left.shift(-left.deflection - (start - left.slope) * left.length, start - left.slope)
