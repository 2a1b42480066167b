"""Fuses and wires of a machine by current.

    I_b <= I_n <= k I_z        current of the load, rating of its fuse, what the wire bears, grouped with others
    I²t >= 2 I²t of the inrush its fuse melts at, so that no supply blows it when it is switched on  [IEC 60269-1]
    S_p = S up to 16 mm², 16 mm² up to 35 mm², else S / 2              protective conductor [IEC 60204-1, table 1]

Copper, insulated with PVC, cables in conduits or ducts at 40 °C: method B2.      [IEC 60204-1, 12.4, table 6, annex D]
"""

import math

FUSES = (2.0, 4.0, 6.0, 10.0, 16.0, 20.0, 25.0, 32.0, 40.0, 50.0, 63.0, 80.0, 100.0, 125.0, 160.0)
"""Ratings of fuses [A]: IEC 60269-1."""

MELTING = {2.0: 1.0, 4.0: 6.25, 6.0: 24.0, 10.0: 100.0, 16.0: 300.0}
"""Least I²t at which a fuse gG melts, by its rating [A²s]: IEC 60269-1, table 7; larger ones bear more."""

WIRES = {
    0.75: 8.5, 1.0: 10.1, 1.5: 13.1, 2.5: 17.4, 4.0: 23.0, 6.0: 30.0, 10.0: 40.0, 16.0: 54.0, 25.0: 70.0, 35.0: 86.0,
    50.0: 103.0, 70.0: 130.0, 95.0: 156.0, 120.0: 179.0,
}  # fmt: skip
"""Current I_z [A] that a section of copper bears [mm²], from the least of cables outside of enclosures on."""

GROUPED = ((1, 1.0), (2, 0.80), (4, 0.65), (6, 0.57), (9, 0.50))
"""Factor k by the number of loaded cables that lie together, method B2; more: the last."""


def fuse_for(current: float, margin: float = 1.25, inrush: float = 0.0) -> float:
    """The least fuse [A] that carries a current [A] with a margin, and an inrush [A²s] twice; nan above the table.

    >>> fuse_for(4.0), fuse_for(13.0), fuse_for(1.5, inrush=4.0)
    (6.0, 20.0, 6.0)
    """
    least = margin * current * (1 - 1e-9)
    return next((own for own in FUSES if own >= least and MELTING.get(own, math.inf) >= 2 * inrush), math.nan)


def section_for(fuse: float, cables: int = 1) -> float:
    """The least section [mm²] that a fuse [A] protects, in a number of cables that lie together; nan above the table.

    >>> section_for(6.0), section_for(10.0), section_for(10.0, cables=4)
    (0.75, 1.0, 2.5)
    """
    factor = next((share for number, share in GROUPED if cables <= number), GROUPED[-1][1])
    return next((section for section, current in WIRES.items() if factor * current >= fuse * (1 - 1e-9)), math.nan)


def protective_section(section: float) -> float:
    """Section of the protective conductor [mm²].

    >>> [protective_section(section) for section in (2.5, 25.0, 70.0)]
    [2.5, 16.0, 35.0]
    """
    return section if section <= 16 else 16.0 if section <= 35 else section / 2
