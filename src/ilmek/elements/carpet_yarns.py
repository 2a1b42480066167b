"""The yarns of a carpet, warp, two wefts and pile: described once, for the bill and every machine that touches them."""

from dataclasses import dataclass, replace
from functools import lru_cache

from ilmek.elements.yarns import (
    COTTON,
    FLATTENING,
    MATERIALS,
    PRESSED_PACKING,
    WOOL,
    pressed_thickness,
    usual_warp_density,
)
from ilmek.params import Params, kind
from ilmek.records import record, result
from ilmek.units import g, m, mm

FRICTION = 0.25
"""Usual friction coefficient of yarn on steel; assumed by this project."""

PILE_DENSITY = 0.8 * g / m
"""Linear density of the pile yarn of a machine without a loom [kg/m]."""

CRIMP = 0.03
"""Warp in the carpet over the carpet's length, less 1: its waves about the wefts; assumed by this project."""


@dataclass(frozen=True, slots=True)
class CarpetYarnParams(Params):
    """Materials and counts of the yarns; what is left open is usual for the pitch of the warps."""

    warp: str = kind.choice(COTTON.name, tuple(MATERIALS), doc="material of the warps")
    warp_density: float | None = kind.line_density(
        None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of a warp; default: usual for the pitch"
    )
    warp_diameter: float | None = kind.length(
        None, above=0.0, at_most=10 * mm, doc="diameter of a warp; default: by count and packing"
    )
    warp_stiffness: float | None = kind.force(
        None, at_least=1.0, at_most=1e7, doc="force over strain of a warp, EA; default: by material and count"
    )
    warp_strength: float | None = kind.force(
        None, at_least=1e-6, at_most=1e6, doc="breaking force of a warp; default: by material and count"
    )
    weft: str = kind.choice(COTTON.name, tuple(MATERIALS), doc="material of both wefts")
    straight_weft_density: float | None = kind.line_density(
        None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the straight weft; default: as of a warp"
    )
    sinuous_weft_density: float | None = kind.line_density(
        None, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the sinuous weft; default: half of a warp"
    )
    pile: str = kind.choice(WOOL.name, tuple(MATERIALS), doc="material of the pile")
    pile_density: float | None = kind.line_density(
        None,
        unit="g/m",
        above=0.0,
        at_most=0.1,
        doc="mass per length of the heaviest pile yarn; default: by quality and knot in a loom, else 0.8 g/m",
    )
    pressed_packing: float = kind.ratio(
        PRESSED_PACKING, at_least=0.3, at_most=0.9, doc="packing of pile yarn pressed between warps or jaws; assumed"
    )
    flattening: float = kind.ratio(
        FLATTENING, at_least=1.0, at_most=10.0, doc="width over thickness of pile yarn pressed there; assumed"
    )
    friction: float = kind.ratio(FRICTION, at_least=0.0, at_most=2.0, doc="friction coefficient of yarn on steel")


@record
class YarnProperties:
    """A yarn as the machines see it.

    stiffness  force over strain EA [N]      breaking_force  [N]      friction  on steel
    """

    material: str
    linear_density: float = result("g/m", "mass per length")
    diameter: float = result("mm", "diameter")
    stiffness: float = result("N", "force over strain, EA")
    breaking_force: float = result("N", "breaking force")
    friction: float = result("1", "friction coefficient on steel")


@record
class CarpetYarns:
    """The four yarns of a carpet.

    pressed  thickness of the pile between warps or jaws [m]: one value for gaps, needles and grippers
    """

    warp: YarnProperties
    straight_weft: YarnProperties
    sinuous_weft: YarnProperties
    pile: YarnProperties
    pressed: float


@lru_cache(maxsize=64)
def carpet_yarns(params: CarpetYarnParams, pitch: float) -> CarpetYarns:
    """The yarns of a carpet with warps at a pitch [m]; whether they fit beside each other, their machines check."""
    warp, friction = params.warp_density or usual_warp_density(pitch, params.warp), params.friction
    pile = params.pile_density or PILE_DENSITY
    usual = yarn(params.warp, warp, friction)
    return CarpetYarns(
        warp=replace(
            usual,
            diameter=params.warp_diameter or usual.diameter,
            stiffness=params.warp_stiffness or usual.stiffness,
            breaking_force=params.warp_strength or usual.breaking_force,
        ),
        straight_weft=yarn(params.weft, params.straight_weft_density or warp, friction),
        sinuous_weft=yarn(params.weft, params.sinuous_weft_density or warp / 2, friction),
        pile=yarn(params.pile, pile, friction),
        pressed=pressed_thickness(pile, MATERIALS[params.pile], params.pressed_packing, params.flattening),
    )


def yarn(material: str, linear_density: float, friction: float = FRICTION) -> YarnProperties:
    """A yarn of a material of `elements.yarns.MATERIALS` and a linear density [kg/m].

    >>> found = yarn("cotton", 0.65e-3)
    >>> round(found.diameter * 1e3, 3), round(found.stiffness), round(found.breaking_force, 1)
    (0.953, 1365, 110.5)
    """
    kind = MATERIALS[material]
    return YarnProperties(
        material,
        linear_density,
        kind.diameter(linear_density),
        kind.stiffness(linear_density),
        kind.breaking_force(linear_density),
        friction,
    )


def usual_warp(pitch: float) -> YarnProperties:
    """The usual warp, of cotton, at a pitch of the warps [m].

    >>> round(usual_warp(2e-3).diameter * 1e3, 3)
    0.946
    """
    return yarn(COTTON.name, usual_warp_density(pitch))
