"""Round nuts with grooves and their tab washers: DIN 981 and DIN 5406, for fine threads of shafts.

    F = M / (0.16 P + mu (0.58 d2 + Dk / 2)),    d2 = d - 0.6495 P,    Dk = (d + D) / 2           [VDI 2230-1, 5.4.3]
    M = hand x 3 D

F is the force of a nut that is tightened with a hook spanner: DIN 1810, about three times as long as the nut is wide;
mu is the friction of an oiled thread. The washer's tab lies in a groove of the shaft and is as wide as that; another
one is bent into a groove of the nut.

Source: DIN 981, KM 0 to KM 30, threads of DIN 13-5 to 13-8; DIN 5406: thickness, width of the tab and its distance from
the opposite side of the shaft.
"""

from ilmek.elements.machine_screws import OILED
from ilmek.records import record
from ilmek.units import mm

HAND = 250.0
"""Force of a hand on a spanner [N]; assumed by this project."""

_LEVER = 3.0
"""Length of a hook spanner over the nut's diameter."""

_WIDER = 1.15
"""Least diameter of a nut over the side of the bar, so that it presses what is about this; assumed by this project."""

_UNDER = 0.5 * mm
"""Room under the washer's tab [m]; assumed by this project."""


@record
class Locknut:
    """A nut with its washer [m].

    thread, pitch, outer, width   d, P, D and B of the nut
    washer, tab, across           thickness of the washer, width of its tab, from that to the other side of the shaft
    """

    number: int
    thread: float
    pitch: float
    outer: float
    width: float
    washer: float
    tab: float
    across: float

    @property
    def designation(self) -> str:
        """Of the nut, as ordered."""
        return f"DIN 981 - KM {self.number}"

    @property
    def washer_designation(self) -> str:
        """Of the washer, as ordered."""
        return f"DIN 5406 - MB {self.number}"

    @property
    def thread_class(self) -> str:
        """Class of the shaft's thread behind its diameter."""
        return f"× {self.pitch / mm:g} - 6g"

    @property
    def core(self) -> float:
        """Diameter that passes through its thread [m]: D1 = d - 1.0825 P."""
        return self.thread - 1.0825 * self.pitch

    @property
    def groove(self) -> float:
        """From the shaft's axis to the floor of the groove for the tab [m]."""
        return self.across - self.thread / 2 - _UNDER

    @property
    def torque(self) -> float:
        """Tightening torque M by hand [N m]."""
        return HAND * _LEVER * self.outer

    @property
    def tightened(self) -> float:
        """Force by that [N].

        >>> round(locknut_for(0.065, 1.0).tightened, -2)
        7000.0
        """
        flank, ring = self.thread - 0.6495 * self.pitch, (self.thread + self.outer) / 2
        return self.torque / (0.16 * self.pitch + OILED * (0.58 * flank + ring / 2))


_ROWS = """
0 10 0.75 18 4 1 3 8.5
1 12 1 22 4 1 3 10.5
2 15 1 25 5 1 4 13.5
3 17 1 28 5 1 4 15.5
4 20 1 32 6 1 4 18.5
5 25 1.5 38 7 1.25 5 23
6 30 1.5 45 7 1.25 5 27.5
7 35 1.5 52 8 1.25 6 32.5
8 40 1.5 58 9 1.25 6 37.5
9 45 1.5 65 10 1.25 6 42.5
10 50 1.5 70 11 1.25 6 47.5
11 55 2 75 11 1.5 8 52.5
12 60 2 80 11 1.5 8 57.5
13 65 2 85 12 1.5 8 62.5
14 70 2 92 12 1.5 8 66.5
15 75 2 98 13 1.5 8 71.5
16 80 2 105 15 1.75 10 76.5
17 85 2 110 16 1.75 10 81.5
18 90 2 120 16 1.75 10 86.5
19 95 2 125 17 1.75 10 91.5
20 100 2 130 18 1.75 12 96.5
22 110 2 145 19 1.75 12 105.5
24 120 2 155 20 2 14 115
26 130 2 165 21 2 14 125
28 140 2 180 22 2 16 135
30 150 2 195 24 2 16 145
"""

LOCKNUTS = tuple(
    Locknut(int(number), *(float(size) * mm for size in sizes))
    for number, *sizes in (row.split() for row in _ROWS.split("\n") if row)
)
"""By thread, ascending."""

_BY_DESIGNATION = {nut.designation: nut for nut in LOCKNUTS}


def locknut_of(designation: str) -> Locknut | None:
    """The nut of a designation; None: it is none.

    >>> locknut_of("DIN 981 - KM 12") is locknut_for(0.065, 1.0), locknut_of("DIN 5406 - MB 12")
    (True, None)
    """
    return _BY_DESIGNATION.get(designation)


def locknut_for(bar: float, room: float) -> Locknut:
    """The nut with the largest thread below a bar [m] that has room, a diameter [m]; without room by its thread alone.

    The smallest nut where the bar is thinner than all threads.

    >>> locknut_for(0.065, 0.081).designation, locknut_for(0.065, 0.07).designation
    ('DIN 981 - KM 12', 'DIN 981 - KM 12')
    """
    thin = [nut for nut in LOCKNUTS if nut.thread < bar * (1 - 1e-9)] or [LOCKNUTS[0]]
    return next((nut for nut in reversed(thin) if _WIDER * bar < nut.outer <= room), thin[-1])
