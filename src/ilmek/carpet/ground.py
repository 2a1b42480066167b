"""Ground: the warp and the two wefts of a row.

Two wefts follow every row of knots: a straight, thick weft (Turkish alt atkı), nearly straight between the two planes
of warps, and a sinuous, thin weft (üst atkı), which passes alternately over and under the warps.
Both run from edge to edge of the cloth, selvedges included, and on by the turn into the next row.

At both ends a strip of plain weave follows, close picks of the sinuous weft, each beside the last. At both sides the
selvedge is overcast with pile yarn, turn beside turn: a helix about the selvedge's warps and wefts.

Sizes and qualities are those of the finished carpet; its yarns are laid in the carpet on the loom, which is longer and
wider [ilmek.carpet.washing].

Warp and wefts are those of `ilmek.elements.carpet_yarns`, the same as of the loom's machines.

Sources: warp counts and the rule `warps = 2 × knots across, length = carpet + up to 60 cm`, iran-carpet.com 1726, 1804;
the two wefts, haliciomer.com.tr.
"""

import math
from dataclasses import dataclass

import scipy

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.washing import WashParams
from ilmek.elements.carpet_yarns import CRIMP, CarpetYarnParams, CarpetYarns, YarnProperties, carpet_yarns
from ilmek.elements.yarns import MATERIALS
from ilmek.params import Params, nested, param
from ilmek.sentences import Sentence
from ilmek.units import mm

SELVEDGE_WARPS = 8
"""Usual warps without knots, both edges together."""

WEFT_TURN = 20 * mm
"""Weft beyond the cloth for a row [m]: the turn into the next row, or both ends tucked in; assumed by this project."""

WARP_STRAIN = 0.01114
"""Usual elastic strain of the warps on the loom: cotton, at the tension of the thesis' loom [1]."""

WEFT_SHARE = 0.5
"""Share of the sinuous weft in the amplitude of a crossing, the rest the warps'; assumed by this project."""


@dataclass(frozen=True, slots=True)
class GroundParams(Params):
    """Warp and wefts."""

    fringe: float = param(
        0.10, unit="mm", at_least=0.0, at_most=1.0, doc="warp beyond the pile at each end: flat-woven end and fringe"
    )
    end_length: float = param(
        0.02, unit="mm", at_least=0.0, at_most=1.0, doc="flat-woven end before the first row and after the last"
    )
    loom_waste: float = param(0.40, unit="mm", at_least=0.0, at_most=10.0, doc="warp lost in the loom, both ends")
    crimp: float = param(CRIMP, at_least=0.0, at_most=1.0, doc="warp in the carpet over its length, less 1")
    selvedge_warps: int = param(SELVEDGE_WARPS, at_least=0, at_most=200, doc="warps without knots, both edges together")
    weft_turn: float = param(WEFT_TURN, unit="mm", at_least=0.0, at_most=0.5, doc="weft for the turn of a pick")
    weft_share: float = param(
        WEFT_SHARE,
        at_least=0.0,
        at_most=1.0,
        doc="share of the sinuous weft in the amplitude of a crossing, the rest the warps",
    )
    warp_strain: float = param(
        WARP_STRAIN, at_least=0.0, at_most=1.0, doc="elastic strain of the warps on the loom, which goes off it"
    )
    yarns: CarpetYarnParams = nested(CarpetYarnParams, doc="materials and counts of the yarns")
    washing: WashParams = nested(WashParams, doc="washing of the carpet")

    @property
    def lengthening(self) -> float:
        """Length on the loom over that of the finished carpet [1]."""
        return self.washing.lengthening(self.warp_strain)

    def warp_pitch(self, quality: Quality) -> float:
        """Distance of two warps on the loom [m]."""
        return quality.warp_pitch * self.washing.widening

    def warp_length(self, length: float) -> float:
        """Length of a warp to be wound, at no tension, for a finished carpet of a length [m]: unwashed, with its crimp,
        both ends and the loom's waste.
        """
        return length * self.washing.lengthening() * (1 + self.crimp) + 2 * self.fringe + self.loom_waste


TAPE_MATERIAL, TAPE_MASS = "cotton", 0.35
"""Of a woven tape, and its mass over its area [kg/m²]: a twill tape some 0.7 mm thick; assumed by this project."""


@dataclass(frozen=True, slots=True)
class GroundYarn:
    """Need of a ground yarn: name, use, material, length [m], mass [kg].

    kept  share of it that stays in the carpet
    """

    name: str
    use: str
    material: str
    length: float
    mass: float
    kept: float = 1.0


def sinuous_length(width: float, pitch: float, amplitude: float) -> float:
    """Length of a sinuous weft across `width` [m].

    pitch  of the warps p [m]      amplitude  A [m]

    Its axis is y = A sin(pi x / p), so its length over one pitch is

        s = (2/pi) sqrt(p² + pi² A²) E(m),   m = pi² A² / (p² + pi² A²),   E the complete elliptic integral.

    >>> sinuous_length(1.2, 2e-3, 0.0) == 1.2
    True
    """
    bend = (math.pi * amplitude) ** 2
    over_pitch = 2 / math.pi * math.sqrt(pitch**2 + bend) * float(scipy.special.ellipe(bend / (pitch**2 + bend)))
    return width * over_pitch / pitch


@dataclass(frozen=True, slots=True)
class WeftLengths:
    """Length of each weft for a row, with its turn [m]."""

    straight: float
    sinuous: float


def weft_lengths(
    width: float, pitch: float, yarns: CarpetYarns, turn: float = WEFT_TURN, share: float = WEFT_SHARE
) -> WeftLengths:
    """Length of each weft for a row.

    width  of the cloth, selvedges included [m]      pitch  of the warps [m]
    turn   beyond the cloth for a row [m]            share  of the sinuous weft in the amplitude of a crossing

    Where the sinuous weft passes a warp, its axis is share · (D + w)/2 from the plane of the warps (D diameter of the
    warp, w of the weft); the warps bend by the rest.

    >>> weft_lengths(1.216, 2e-3, carpet_yarns(CarpetYarnParams(), 2e-3)).straight
    1.236
    """
    amplitude = share * (yarns.warp.diameter + yarns.sinuous_weft.diameter) / 2
    return WeftLengths(width + turn, sinuous_length(width, pitch, amplitude) + turn)


def warp_need(columns: int, length: float, yarn: YarnProperties, params: GroundParams) -> GroundYarn:
    """Warp for `columns` knots across: two per knot and the selvedges.

    length  of the carpet [m]
    """
    each = params.warp_length(length)
    total = (2 * columns + params.selvedge_warps) * each
    mass = total * yarn.linear_density
    return GroundYarn(Sentence("ground.warp"), "warp", yarn.material, total, mass, 1 - params.loom_waste / each)


def ground_yarns(
    size: CarpetSize, quality: Quality, rows: int, columns: int, params: GroundParams | None = None
) -> tuple[GroundYarn, GroundYarn, GroundYarn, GroundYarn]:
    """Warp, straight weft, sinuous weft and ends of a carpet of rows × columns knots.

    The wefts bind the selvedges too. The ends are of the sinuous weft; their picks lie beside each other.
    """
    params = params or GroundParams()
    pitch = params.warp_pitch(quality)
    yarns = carpet_yarns(params.yarns, pitch)
    thin = yarns.sinuous_weft
    cloth = (2 * columns + params.selvedge_warps) * pitch
    a_row = weft_lengths(cloth, pitch, yarns, params.weft_turn, params.weft_share)
    picks = 2 * math.ceil(params.end_length / thin.diameter)
    return (
        warp_need(columns, size.length, yarns.warp, params),
        _weft(Sentence("ground.straight-weft"), "weft", yarns.straight_weft, rows * a_row.straight),
        _weft(Sentence("ground.sinuous-weft"), "weft", thin, rows * a_row.sinuous),
        _weft(Sentence("ground.ends"), "end", thin, picks * a_row.sinuous),
    )


def selvedge_yarn(
    size: CarpetSize, quality: Quality, linear_density: float, params: GroundParams | None = None
) -> GroundYarn:
    """Pile yarn that overcasts both selvedges; none where no warp is without knots.

    linear_density  mu of the pile yarn [kg/m], its diameter d

    A selvedge of w warps of pitch p and diameter D is b = w p wide and t = D + s thick, s the sinuous weft's diameter.
    A turn about it is a helix of the rise d:  s = sqrt((2 (b + t) + pi d)² + d²), one for each d of the length.
    """
    params = params or GroundParams()
    pitch = params.warp_pitch(quality)
    yarns = carpet_yarns(params.yarns, pitch)
    pile = MATERIALS[params.yarns.pile].diameter(linear_density)
    if params.selvedge_warps == 0:
        return GroundYarn(Sentence("ground.selvedges"), "selvedge", params.yarns.pile, 0.0, 0.0)
    around = 2 * (params.selvedge_warps / 2 * pitch + yarns.warp.diameter + yarns.sinuous_weft.diameter)
    total = 2 * size.length * params.lengthening / pile * math.hypot(around + math.pi * pile, pile)
    return GroundYarn(Sentence("ground.selvedges"), "selvedge", params.yarns.pile, total, total * linear_density)


def binding_yarn(
    length: float, width: float, quality: Quality, linear_density: float, params: GroundParams | None = None
) -> GroundYarn:
    """Pile yarn that overcasts a cut edge, as `selvedge_yarn` a selvedge: turn beside turn over a hem.

    length  of the edge [m]      width  b of the hem [m]
    """
    params = params or GroundParams()
    yarns = carpet_yarns(params.yarns, params.warp_pitch(quality))
    pile = MATERIALS[params.yarns.pile].diameter(linear_density)
    around = 2 * (width + yarns.warp.diameter + yarns.sinuous_weft.diameter) + math.pi * pile
    total = length / pile * math.hypot(around, pile)
    return GroundYarn(Sentence("ground.binding"), "binding", params.yarns.pile, total, total * linear_density)


def binding_tape(length: float, width: float) -> GroundYarn:
    """Tape of cotton that is sewn over a cut edge: on both faces of the hem.

    length  of the edge [m]      width  of the hem [m]
    """
    return GroundYarn(Sentence("ground.tape"), "tape", TAPE_MATERIAL, length, length * 2 * width * TAPE_MASS)


def _weft(name: str, use: str, yarn: YarnProperties, length: float) -> GroundYarn:
    return GroundYarn(name, use, yarn.material, length, length * yarn.linear_density)
