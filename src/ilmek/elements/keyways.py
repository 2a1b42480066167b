"""Keyways for parallel keys, by the shaft's diameter.

Source: DIN 6885-1:1968, high form, Form A; its table of shaft diameters, key sections, depths of shaft and
hub, lengths.
"""

from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.units import format_quantity, mm


@dataclass(frozen=True, slots=True)
class Keyway:
    """A parallel key's section and its grooves [m].

    over, upto  range of shaft diameters         width, height  of the key's section
    in_shaft    depth of the shaft's groove      in_hub         depth of the hub's, beyond the bore
    shortest, longest  key of the section
    """

    over: float
    upto: float
    width: float
    height: float
    in_shaft: float
    in_hub: float
    shortest: float
    longest: float


_ROWS = (
    (6, 8, 2, 2, 1.2, 1.0, 6, 20),
    (8, 10, 3, 3, 1.8, 1.4, 6, 36),
    (10, 12, 4, 4, 2.5, 1.8, 8, 45),
    (12, 17, 5, 5, 3.0, 2.3, 10, 56),
    (17, 22, 6, 6, 3.5, 2.8, 14, 70),
    (22, 30, 8, 7, 4.0, 3.3, 18, 90),
    (30, 38, 10, 8, 5.0, 3.3, 22, 110),
    (38, 44, 12, 8, 5.0, 3.3, 28, 140),
    (44, 50, 14, 9, 5.5, 3.8, 36, 160),
    (50, 58, 16, 10, 6.0, 4.3, 45, 180),
    (58, 65, 18, 11, 7.0, 4.4, 50, 200),
    (65, 75, 20, 12, 7.5, 4.9, 56, 220),
    (75, 85, 22, 14, 9.0, 5.4, 63, 250),
    (85, 95, 25, 14, 9.0, 5.4, 70, 280),
    (95, 110, 28, 16, 10.0, 6.4, 80, 320),
    (110, 130, 32, 18, 11.0, 7.4, 90, 360),
)

KEYWAYS = tuple(Keyway(*(value * mm for value in row)) for row in _ROWS)
"""By shaft diameter, ascending, without gaps."""


def keyway_for(diameter: float) -> Keyway:
    """The keyway of a shaft or bore of a diameter [m]. Raises ParameterError outside the table.

    >>> keyway_for(0.025).width
    0.008
    """
    for keyway in KEYWAYS:
        if keyway.over < diameter <= keyway.upto * (1 + 1e-12):
            return keyway
    least, most = KEYWAYS[0].over, KEYWAYS[-1].upto
    raise ParameterError(
        f"no parallel key for a shaft of {format_quantity(diameter, 'mm')}",
        allowed=f"above {format_quantity(least, 'mm')}, at most {format_quantity(most, 'mm')} (DIN 6885-1)",
        do="use another diameter, or a square shaft",
    )
