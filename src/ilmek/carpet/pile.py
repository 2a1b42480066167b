"""Pile: the length of yarn that a knot takes, and whether the pile fits its ground.

A knot stands on two neighbouring warps of pitch p and diameter D; the pile yarn has the diameter d, so that its axis
turns round a warp on the radius r = (D + d)/2. In the section across the warps, from tip to tip of the yarn:

    leg     from the height of the warps' axes up through the collar of the knot (D/2 + d), the pile height h as woven,
            and the waste c that the knife and the shears take:   D/2 + d + h + c,   twice
    wrap    the part round the warps, by the kind of the knot [`ilmek.elements.knot_kinds`]

    L = k (2 (D/2 + d + h + c) + wrap)

k is a calibration by the weaver's own carpet. By hand the figures published are 25 to 28 mm at 40 knots per dm and 30
to 35 mm at 35, but 40 mm at 40 raj, where the waste of the hand cut seems to be in it (iran-carpet.com 1705;
Azerbaijani Wikipedia). Fine carpets are shorn lower: give their own pile height.

Whether the pile fits its ground: every knot sends two legs up through its cell, 1/a wide and 1/b long (a knots across
and b along, per length; n = a b per area). A leg's section, fibre and the air between, is A = mu / (rho phi) (see
`elements.yarns`), so of the ground's area the pile takes the share

    F = 2 A n = 2 mu a b / (rho phi) <= 1

Above 1 the yarn cannot stand there, however hard the rows are beaten; own derivation, by areas alone. It fits up to
mu = rho phi / (2 n), which for a yarn of P strands is the metric count Nm = P / (1000 mu), or finer.
"""

from dataclasses import dataclass

from ilmek.carpet.quality import Quality
from ilmek.elements.knot_kinds import WRAPS, parse_knot
from ilmek.elements.yarns import WOOL, warp_diameter, yarn_diameter
from ilmek.params import Params, param
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class PileParams(Params):
    """What sets the length of pile yarn per knot."""

    pile_height: float = param(
        8 * mm, unit="mm", at_least=0.0, at_most=100 * mm, doc="pile above the knots, after shearing", symbol="h"
    )
    cut_waste: float = param(
        1 * mm,
        unit="mm",
        at_least=0.0,
        at_most=100 * mm,
        doc="cut or sheared off each of a knot's two ends",
        symbol="c",
    )
    warp_diameter: float | None = param(
        None,
        unit="mm",
        above=0.0,
        at_most=10 * mm,
        doc="diameter of a warp; left out: of the usual wool warp",
        symbol="D",
    )
    fibre_density: float = param(WOOL.density, unit="kg/m^3", above=0.0, doc="density of the pile's fibre, wool 1310")
    packing: float = param(WOOL.packing, above=0.0, at_most=1.0, doc="share of the pile yarn's section that is fibre")
    calibration: float = param(
        1.0, above=0.0, at_most=10.0, doc="yarn a knot takes, over the geometric length", symbol="k"
    )


def knot_length(knot: str, quality: Quality, linear_density: float, pile: PileParams | None = None) -> float:
    """Length of pile yarn that one knot takes [m].

    linear_density  of the pile yarn [kg/m]. Raises CarpetError for an unknown knot.

    >>> round(knot_length("symmetric", Quality(250.0, 250.0), 0.8e-3) * 1e3, 1)
    36.6
    """
    pile = pile or PileParams()
    wrap = WRAPS[parse_knot(knot)]
    warp = pile.warp_diameter or warp_diameter(quality.warp_pitch)
    yarn = yarn_diameter(linear_density, pile.fibre_density, pile.packing)
    leg = leg_length(warp, yarn, pile)
    return pile.calibration * (2 * leg + wrap(quality.warp_pitch, (warp + yarn) / 2))


def leg_length(warp_diameter: float, yarn_diameter: float, pile: PileParams) -> float:
    """From the warps' axes to the tip of the yarn as woven [m]: D/2 + d + h + c."""
    return warp_diameter / 2 + yarn_diameter + pile.pile_height + pile.cut_waste


def pile_fill(quality: Quality, linear_density: float, pile: PileParams | None = None) -> float:
    """Share of the ground's area that the legs of the pile take: F = 2 mu a b / (rho phi); above 1 they do not fit.

    linear_density  mu of the pile yarn [kg/m]

    >>> round(pile_fill(Quality(250.0, 250.0), 0.8e-3), 4), round(pile_fill(Quality(1000.0, 1000.0), 0.8e-3), 2)
    (0.1696, 2.71)
    """
    pile = pile or PileParams()
    return 2 * linear_density * quality.knots_per_area / (pile.fibre_density * pile.packing)


def coarsest_count(quality: Quality, ply: int, pile: PileParams | None = None) -> float:
    """The least metric count Nm [m/g] of the strands of a yarn of so many that fits its ground: F = 1.

    >>> round(coarsest_count(Quality(1000.0, 1000.0), ply=2), 2)
    6.79
    """
    return ply * pile_fill(quality, 1e-3, pile)
