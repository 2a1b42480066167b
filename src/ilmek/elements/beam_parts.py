"""A beam cut at its supports: overhang, spans, overhang, each with the loads that stand on it.

A line load is taken to its moments and slopes by Gauss' three places, which is exact: the load is linear, the kernel
cubic.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ilmek.elements.beam import Beam, Couple, LineLoad, PointLoad

_GAUSS = tuple((float(place), float(weight)) for place, weight in zip(*np.polynomial.legendre.leggauss(3), strict=True))


@dataclass(frozen=True, slots=True)
class Part:
    """The beam between two neighbours of its ends and supports, with its loads clipped to it."""

    start: float
    end: float
    points: tuple[PointLoad, ...]
    lines: tuple[LineLoad, ...]
    couples: tuple[Couple, ...]

    @property
    def length(self) -> float:
        """[m]."""
        return self.end - self.start

    def forces(self) -> Iterator[tuple[float, complex]]:
        """Distance from the left end, and force; a line load stands as three."""
        yield from ((load.at - self.start, load.force) for load in self.points)
        for load in self.lines:
            half, middle = (load.end - load.start) / 2, (load.end + load.start) / 2
            for place, weight in _GAUSS:
                x = middle + half * place
                yield x - self.start, weight * half * load.value(x)

    def total(self) -> complex:
        """Sum of its forces [N]."""
        return sum((force for _, force in self.forces()), 0j)

    def turning(self) -> complex:
        """Sum of its couples [N m]."""
        return sum((couple.moment for couple in self.couples), 0j)

    def moment(self) -> complex:
        """Moment at its right end of its loads, its left end being free [N m]."""
        return self.turning() - sum((force * (self.length - a) for a, force in self.forces()), 0j)

    def balancing(self) -> complex:
        """Moment at its left end that balances its loads, its right end being free [N m]."""
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


def parts_of(beam: Beam) -> list[Part]:
    """Left overhang, spans, right overhang; overhangs may be of no length. A load over a support is right of it."""
    ends = list(pairwise((0.0, *beam.supports, beam.length)))
    return [_part(beam, start, end, last=number == len(ends) - 1) for number, (start, end) in enumerate(ends)]


def _part(beam: Beam, start: float, end: float, *, last: bool) -> Part:
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
    return Part(start, end, tuple(points), tuple(lines), tuple(couples))
