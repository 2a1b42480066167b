"""Pile: length of yarn per knot, and whether the pile fits its ground.

A knot is tied on two neighbouring warps of pitch p and diameter D. The pile yarn has the diameter d, so its axis turns
about a warp on the radius r = (D + d)/2. In the section across the warps, from tip to tip of the yarn:

    leg     from the height of the warps' axes up through the collar of the knot (D/2 + d), the pile height h as woven,
            and the waste c of knife and shears:   D/2 + d + h + c,   twice
    wrap    the part about the warps, by the kind of knot [`ilmek.elements.knot_kinds`]

    L = k (2 (D/2 + d + h + c) + wrap)

k is a calibration by the weaver's own carpet. Published lengths of hand-knotted carpets are 25 to 28 mm at 40 knots per
dm and 30 to 35 mm at 35, but 40 mm at 40 raj, probably with the waste of the hand cut (iran-carpet.com 1705;
Azerbaijani Wikipedia). Fine carpets have a lower pile: give their own pile height.

Fit of the pile: two legs of every knot stand in its cell, 1/a wide and 1/b long (a knots across and b along, per
length; n = a b per area). The section of a leg, fibre and air, is A = mu / (rho phi) (`elements.yarns`), so the pile
fills the share of the ground's area

    F = 2 A n = 2 mu a b / (rho phi) <= 1

Above 1 the yarn does not fit, even with the hardest beat-up [derived, by areas alone]. The limit is mu = rho phi / (2
n); a yarn of P strands then has the metric count Nm = P / (1000 mu).
"""

from dataclasses import dataclass, replace

from ilmek.carpet.cells import CellKind
from ilmek.carpet.quality import Quality
from ilmek.carpet.yarn import Yarn
from ilmek.elements.carpet_yarns import YarnProperties, usual_warp
from ilmek.elements.knot_kinds import parse_knot, wrap_of
from ilmek.elements.yarns import MATERIALS, WOOL, yarn_diameter
from ilmek.params import Params, param
from ilmek.report import Check, at_most
from ilmek.sentences import Sentence
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class PileParams(Params):
    """Parameters of the length of pile yarn per knot."""

    pile_height: float = param(
        8 * mm, unit="mm", at_least=0.0, at_most=100 * mm, doc="pile above the knots, after shearing", symbol="h"
    )
    cut_waste: float = param(
        1 * mm,
        unit="mm",
        at_least=0.0,
        at_most=100 * mm,
        doc="waste by cutting and shearing, at each of the two ends of a knot",
        symbol="c",
    )
    warp_diameter: float | None = param(
        None, unit="mm", above=0.0, at_most=10 * mm, doc="diameter of a warp; default: of the usual warp", symbol="D"
    )
    fibre_density: float = param(WOOL.density, unit="kg/m^3", above=0.0, doc="density of the pile's fibre, wool 1310")
    packing: float = param(WOOL.packing, above=0.0, at_most=1.0, doc="share of fibre in the section of the pile yarn")
    calibration: float = param(
        1.0, above=0.0, at_most=10.0, doc="length of yarn per knot over the geometric length", symbol="k"
    )


def knot_length(
    knot: str, quality: Quality, linear_density: float, pile: PileParams | None = None, form: str = "whole"
) -> float:
    """Length of pile yarn per knot [m].

    knot  its kind      linear_density  of the pile yarn [kg/m]      pile  default: `PileParams()`
    form  whole on two warps, half on one, jufti on four [`ilmek.elements.knot_kinds`]
    Raises CarpetError for an unknown knot.

    >>> round(knot_length("symmetric", Quality(250.0, 250.0), 0.8e-3) * 1e3, 1)
    34.2
    """
    pile = pile or PileParams()
    kind = parse_knot(knot)
    warp = pile.warp_diameter or usual_warp(quality.warp_pitch).diameter
    yarn = yarn_diameter(linear_density, pile.fibre_density, pile.packing)
    leg = leg_length(warp, yarn, pile)
    return pile.calibration * (2 * leg + wrap_of(kind, form, quality.warp_pitch, (warp + yarn) / 2))


def of_yarn(pile: PileParams, yarn: Yarn) -> PileParams:
    """The pile of a yarn: of its own material, where it has one."""
    if yarn.material is None:
        return pile
    fibre = MATERIALS[yarn.material]
    return replace(pile, fibre_density=fibre.density, packing=fibre.packing)


def of_kind(pile: PileParams, kind: CellKind) -> PileParams:
    """The pile of a kind of knots: its own height; a loop is not cut, and has no waste of knife and shears."""
    height = pile.pile_height if kind.height is None else kind.height
    return replace(pile, pile_height=height, cut_waste=0.0 if kind.loop else pile.cut_waste)


def leg_length(warp_diameter: float, yarn_diameter: float, pile: PileParams) -> float:
    """Length of a leg [m], from the warps' axes to the tip of the yarn as woven: D/2 + d + h + c; diameters in m."""
    return warp_diameter / 2 + yarn_diameter + pile.pile_height + pile.cut_waste


def pile_check(yarn: YarnProperties, quality: Quality) -> Check:
    """Whether the pile fits into its ground: the share of the ground that a yarn fills at a quality, at most 1."""
    fibre = MATERIALS[yarn.material]
    return fill_check(
        pile_fill(quality, yarn.linear_density, PileParams(fibre_density=fibre.density, packing=fibre.packing))
    )


def fill_check(fill: float) -> Check:
    """The check of the share of the ground that the pile fills [-]."""
    source, cure = Sentence("check.pile-source"), Sentence("check.pile-cure")
    return at_most(Sentence("check.pile"), fill, 1.0, "%", source).with_cure(cure)


def pile_fill(quality: Quality, linear_density: float, pile: PileParams | None = None) -> float:
    """Share of the ground's area that the legs of the pile fill: F = 2 mu a b / (rho phi); above 1 they do not fit.

    linear_density  mu of the pile yarn [kg/m]

    >>> round(pile_fill(Quality(250.0, 250.0), 0.8e-3), 4), round(pile_fill(Quality(1000.0, 1000.0), 0.8e-3), 2)
    (0.1696, 2.71)
    """
    pile = pile or PileParams()
    return 2 * linear_density * quality.knots_per_area / (pile.fibre_density * pile.packing)


def coarsest_count(quality: Quality, ply: int, pile: PileParams | None = None) -> float:
    """The least metric count Nm [m/g] of the strands of a yarn of `ply` strands that fits its ground: F = 1.

    >>> round(coarsest_count(Quality(1000.0, 1000.0), ply=2), 2)
    6.79
    """
    return ply * pile_fill(quality, 1e-3, pile)
