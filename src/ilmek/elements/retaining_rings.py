"""Retaining rings for shafts: DIN 471, normal type.

Source: DIN 471:2011, table 1: thickness s, greatest lug a, width b, groove d2, m and n. The room about a ring while it
is put on has the diameter d1 + 2.1 a.
"""

from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.units import format_quantity, mm


@record
class RetainingRing:
    """A ring for a shaft [m].

    shaft      diameter of the shaft d1        thickness  s        lug, width   greatest a, and b
    groove     diameter of the groove d2       slot       width of the groove m      end  from groove to shaft's end n
    """

    shaft: float
    thickness: float
    lug: float
    width: float
    groove: float
    slot: float
    end: float

    @property
    def designation(self) -> str:
        """As ordered."""
        return f"DIN 471 - {self.shaft / mm:g} x {self.thickness / mm:g}"

    @property
    def room(self) -> float:
        """Diameter that must be free to put it on [m]."""
        return self.shaft + 2.1 * self.lug

    @property
    def outer(self) -> float:
        """Outer diameter in its groove [m]."""
        return self.groove + 2 * self.width

    @property
    def steps(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Its groove, and the end of the shaft behind it: diameters and lengths [m]."""
        return (self.groove, self.slot), (self.shaft, self.end)


_ROWS = """
3 0.4 1.9 0.8 2.8 0.5 0.3
4 0.4 2.2 0.9 3.8 0.5 0.3
5 0.6 2.5 1.1 4.8 0.7 0.3
6 0.7 2.7 1.3 5.7 0.8 0.5
7 0.8 3.1 1.4 6.7 0.9 0.5
8 0.8 3.2 1.5 7.6 0.9 0.6
9 1 3.3 1.7 8.6 1.1 0.6
10 1 3.3 1.8 9.6 1.1 0.6
11 1 3.3 1.8 10.5 1.1 0.8
12 1 3.3 1.8 11.5 1.1 0.8
13 1 3.4 2 12.4 1.1 0.9
14 1 3.5 2.1 13.4 1.1 0.9
15 1 3.6 2.2 14.3 1.1 1.1
16 1 3.7 2.2 15.2 1.1 1.2
17 1 3.8 2.3 16.2 1.1 1.2
18 1.2 3.9 2.4 17 1.3 1.5
19 1.2 3.9 2.5 18 1.3 1.5
20 1.2 4 2.6 19 1.3 1.5
22 1.2 4.2 2.8 21 1.3 1.5
24 1.2 4.4 3 22.9 1.3 1.7
25 1.2 4.4 3 23.9 1.3 1.7
28 1.5 4.7 3.2 26.6 1.6 2.1
30 1.5 5 3.5 28.6 1.6 2.1
32 1.5 5.2 3.6 30.3 1.6 2.6
35 1.5 5.6 3.9 33 1.6 3
40 1.75 6 4.4 37.5 1.85 3.8
45 1.75 6.5 4.7 42.5 1.85 3.8
50 2 6.9 5.1 47 2.15 4.5
55 2 7.2 5.4 52 2.15 4.5
60 2 7.4 5.8 57 2.15 4.5
63 2 7.6 6.2 60 2.15 4.5
70 2.5 8.1 6.6 67 2.65 4.5
80 2.5 8.6 7.4 76.5 2.65 5.3
100 3 9.6 9 96.5 3.15 5.3
"""

RETAINING_RINGS = tuple(
    RetainingRing(*(float(value) * mm for value in row.split())) for row in _ROWS.split("\n") if row
)
"""By the diameter of the shaft, ascending."""


_BY_DESIGNATION = {ring.designation: ring for ring in RETAINING_RINGS}


def ring_of(designation: str) -> RetainingRing | None:
    """The ring of a designation; None: it is none of the table.

    >>> ring_of("DIN 471 - 10 x 1") is retaining_ring(0.010)
    True
    """
    return _BY_DESIGNATION.get(designation)


def retaining_ring(shaft: float) -> RetainingRing:
    """The ring of a shaft of a diameter [m]. Raises ParameterError for a diameter that is not in the table.

    >>> retaining_ring(0.010).designation
    'DIN 471 - 10 x 1'
    """
    for ring in RETAINING_RINGS:
        if abs(ring.shaft - shaft) < 1e-9:
            return ring
    near = min(RETAINING_RINGS, key=lambda ring: abs(ring.shaft - shaft))
    raise ParameterError(
        f"no retaining ring for a shaft of {format_quantity(shaft, 'mm')}",
        allowed=f"the nearest of DIN 471 is {format_quantity(near.shaft, 'mm')}",
    )
