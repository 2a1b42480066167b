"""Matches: the colours of a drawing and the yarns that they take, one by one."""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, UInt8
from ilmek.carpet.colour_groups import ColourGroups
from ilmek.carpet.palette import Colours
from ilmek.carpet.picture_points import hex_colour

MOST_MATCHES = 255
"""Largest number of colours of a design that are reported one by one."""


class ColourMatch(NamedTuple):
    """A colour of a design: sRGB, its knots, the index of its yarn, and the CIEDE2000 difference of the two.

    group  number of its group of colours, which look like one
    """

    srgb: tuple[int, int, int]
    knots: int
    yarn: int
    delta_e: float
    group: int = 0

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


def colour_matches(
    distinct: Colours,
    yarn_of: UInt8[np.ndarray, " colours"],
    difference: Float[np.ndarray, " colours"],
    groups: ColourGroups,
) -> tuple[ColourMatch, ...]:
    """The match of each distinct colour, most knots first; none where there are more than MOST_MATCHES."""
    if len(distinct.counts) > MOST_MATCHES:
        return ()
    found = [
        ColourMatch(
            (code >> 16, code >> 8 & 255, code & 255),
            int(distinct.counts[number]),
            int(yarn_of[number]),
            float(difference[number]),
            int(groups.of[number]),
        )
        for number, code in enumerate(distinct.codes.tolist())
    ]
    return tuple(sorted(found, key=lambda match: (-match.knots, match.srgb)))
