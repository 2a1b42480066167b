"""Usual pile: the height and the yarn count that follow from the quality, and the published mass of such carpets.

Pile height, with p the mean distance of two knots (p² = 1/n, n knots per area):

    h = 2 mm + 0.5 p² / mm,   at most 15 mm

10 mm at 25 x 25 per dm, 6.1 at 35 x 35 and 5.1 at 40 x 40. With the usual count the last two take knots of 29 and 26
mm; published are 30 to 35 and 25 to 28 mm (Azerbaijani Wikipedia). The 2 mm, which the finest carpets keep, and the
greatest height are assumed by this project.

Yarn count: the pile fills the same share of the ground at every quality (`pile.pile_fill`), 32 %, or 34 % with the
asymmetric knot, whose collar takes less yarn; a cut pile then weighs 0.19 or 0.20 g/cm³. The share is assumed by this
project; it is the one number that was chosen by the published masses of Nepalese carpets, which the rules meet at all
three densities. A yarn has two plies, more being advised against (blog.iran-carpet.com); none is heavier than 1/2.

Published mass: hand-knotted carpets of Nepal have 56,000, 80,000 and 125,000 knots/m² and 4.5 to 5.0, 3.5 to 4.25 and
2.5 to 3.5 kg/m² (nepalcarpet.org). Between them both limits are interpolated by knots per area; beyond, none is
published.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from decimal import Context

import numpy as np

from ilmek.carpet.pile import PileParams, coarsest_count, of_yarn
from ilmek.carpet.quality import Quality
from ilmek.carpet.yarn import Yarn
from ilmek.elements.knot_kinds import parse_knot
from ilmek.units import mm

LEAST_PILE, GREATEST_PILE = 2 * mm, 15 * mm
_GROWTH = 0.5 / mm
"""Growth of the pile height with the area of a knot's cell [1/m]."""

USUAL_FILL = {"symmetric": 0.32, "asymmetric": 0.34}
"""Share of the ground that the usual pile fills, by the kind of knot."""

USUAL_PLY = 2

_COARSEST = 1.0
"""Least metric count of a strand: no pile yarn is heavier than 1/2, 2 g/m."""

BAND_SOURCE = "hand-knotted carpets of Nepal, nepalcarpet.org"
_BAND = np.array([(56e3, 4.5, 5.0), (80e3, 3.5, 4.25), (125e3, 2.5, 3.5)]).T
"""Knots per m², least and greatest mass of such a carpet [kg/m²]."""


@dataclass(frozen=True, slots=True)
class MassBand:
    """The published mass of carpets of a density [kg/m²]."""

    least: float
    most: float

    def __contains__(self, mass_per_area: float) -> bool:
        return self.least <= mass_per_area <= self.most


def usual_pile_height(quality: Quality) -> float:
    """The usual height of the pile above the knots [m].

    >>> [round(usual_pile_height(Quality(a, a)) / mm, 2) for a in (100.0, 250.0, 400.0, 1000.0)]
    [15.0, 10.0, 5.12, 2.5]
    """
    return min(LEAST_PILE + _GROWTH / quality.knots_per_area, GREATEST_PILE)


def usual_count(quality: Quality, knot: str, pile: PileParams | None = None) -> float:
    """Metric count Nm of each of the two strands of the usual pile yarn, to two digits, at least 1.

    pile  whose fibre and packing the yarn has; default: wool

    >>> usual_count(Quality(250.0, 250.0), "symmetric"), usual_count(Quality(1000.0, 1000.0), "symmetric")
    (1.3, 21.0)
    """
    fills = coarsest_count(quality, USUAL_PLY, pile) / USUAL_FILL[parse_knot(knot)]
    return float(Context(prec=2).create_decimal_from_float(max(fills, _COARSEST)))


def usual_linear_density(quality: Quality, knot: str) -> float:
    """Mass per length of the usual pile yarn [kg/m].

    >>> round(usual_linear_density(Quality(250.0, 250.0), "symmetric") * 1e3, 3)
    1.538
    """
    return USUAL_PLY / (1000.0 * usual_count(quality, knot))


def with_counts(
    yarns: Iterable[Yarn], quality: Quality, knot: str, given: tuple[float, int] | None = None
) -> tuple[Yarn, ...]:
    """The yarns with a count each: their own, or the usual one of the quality where the list leaves it open.

    given  metric count and ply of all yarns, in place of their own
    """

    def counted(yarn: Yarn) -> Yarn:
        count, ply = given or (usual_count(quality, knot, of_yarn(PileParams(), yarn)), USUAL_PLY)
        return replace(yarn, metric_count=count, ply=ply)

    return tuple(counted(yarn) if given or yarn.metric_count is None else yarn for yarn in yarns)


def published_band(quality: Quality) -> MassBand | None:
    """The published mass of carpets of a quality; None outside 56,000 to 125,000 knots/m².

    >>> published_band(Quality(250.0, 320.0))
    MassBand(least=3.5, most=4.25)
    """
    density, least, most = _BAND
    at = quality.knots_per_area
    if not density[0] * (1 - _SAME) <= at <= density[-1] * (1 + _SAME):
        return None
    return MassBand(float(np.interp(at, density, least)), float(np.interp(at, density, most)))


_SAME = 0.01
"""Relative difference of a density from the first or last published one that is still that class."""
