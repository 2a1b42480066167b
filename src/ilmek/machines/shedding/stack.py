"""The stack of cams, guides and spacers on a cam shaft: how a pitch of the shaft is shared, its mass, the free noses.

The warps are dealt to k shafts in turn, so that a shaft has the pitch k p, and the other k - 1 warps of this pitch run
past it. Between two of its cams they need (k - 1) d + k c, d their diameter and c their clearance:

    guide cams   k = 1:  t + g = p                         the guide cam between two cams stands at both of them
                 k > 1:  t + 2 g + (k - 1) d + k c = k p   guide cams on both sides of a cam, others between
    reed         k = 1:  t + u <= p,  t <= 2 p - d - 2 c   a warp at rest lies between the noses of its neighbours
                 k > 1:  t + (k - 1) d + k c = k p         dents of p - d - 2 c stand between all warps

A warp lies in the groove between two guide cams, so that t is d + 2 c at least, and little more, or it plays. The sheet
has a tolerance, T, so that 2 c is T at least. u is the least shim.                                         [derived]
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN
from ilmek.elements.sheet_tolerances import sheet_tolerance
from ilmek.machines.shedding.params import REED, SheddingParams
from ilmek.plane.contours import polygon_moments
from ilmek.records import record, result
from ilmek.units import mm

POINTS = 1440
"""Points of the polygon that stands for a cam."""

LEAST_SHIM = 0.1 * mm
"""The thinnest shim ring of DIN 988 [m]."""

DENT_TAB = 20 * mm, 10 * mm
"""Length before its ring and height of the tab by which a dent is clamped [m]; assumed by this project."""

LEAST_SHARE = 0.1
"""Share of the pitch that counts as cam and guides where the warps alone fill it; their checks then fail."""


def part_id(name: str, shaft: int = 0) -> str:
    """Id of a part or body; of the second shaft and further ones with its number."""
    return f"shedding/{name}-shaft-{shaft + 1}" if shaft else f"shedding/{name}"


@record
class PitchShares:
    """How the pitch of a cam shaft is shared: along the shaft, all in metres.

    pitch      of the shaft: k times that of the warps       guides   guide cams for each cam; 0: a reed
    thickness  of a cam     guide  thickness of a guide cam, or of a dent
    gap        for the warps of the other shafts             spacer   ring beside a cam that is no guide cam
    play       of a warp to both sides together
    """

    pitch: float
    thickness: float
    guide: float
    guides: int
    gap: float
    spacer: float
    play: float

    @property
    def used(self) -> float:
        """What cam, guide cams and passing warps need of the pitch [m]."""
        return self.thickness + self.guides * self.guide + self.gap


@record
class CamStack:
    """The cams on the shafts; cams and guide cams are weighed bored, the stack with the shaft in its bores.

    spacer_mass  of the spacer beside a cam, bored [kg]; 0 without one
    """

    thickness: float = result("mm", "thickness of a cam", name="cam_thickness", least=0.0)
    guide_thickness: float = result("mm", "thickness of a guide cam, or of a dent of the reed", least=0.0)
    guide_radius: float = result("mm", "radius of a guide cam, or of the reed's outer edge", least=0.0)
    cam_mass: float = result("kg", "mass of a cam, bored")
    guide_mass: float = result("kg", "mass of a guide cam, bored, or of a dent")
    mass: float = result("kg", "mass of all cams, guide cams, spacers and the shafts between them")
    inertia: float = result("kg*m^2", "moment of inertia of all these about their shafts")
    shares: PitchShares
    spacer_mass: float


def shared(params: SheddingParams, shafts: int, guides: str) -> PitchShares:
    """How the pitch of each of so many shafts is shared between cam, guides and passing warps."""
    return _with_reed(params, shafts) if guides == REED else _with_guide_cams(params, shafts)


def _with_guide_cams(params: SheddingParams, shafts: int) -> PitchShares:
    d, c, pitch = params.diameter, params.warp_clearance, params.cloth.warp_pitch
    whole, number = shafts * pitch, 1 if shafts == 1 else 2
    gap = passing_gap(shafts, d, c)
    rest = max(whole - gap, LEAST_SHARE * pitch)
    groove = d + _both_sides(params)
    if params.cam_thickness is not None:
        thickness = params.cam_thickness
    elif groove < rest:
        thickness = min(max(rest / (number + 1), groove), max(groove, d + params.play_limit * pitch))
    else:
        thickness = rest / (number + 1)
    guide = max((rest - thickness) / number, LEAST_SHARE * LEAST_SHARE * pitch)
    return PitchShares(whole, thickness, guide, number, gap, gap, max(thickness - d, 0.0))


def _with_reed(params: SheddingParams, shafts: int) -> PitchShares:
    d, c, pitch = params.diameter, params.warp_clearance, params.cloth.warp_pitch
    whole, gap = shafts * pitch, passing_gap(shafts, d, c)
    room = min(pitch - LEAST_SHIM, 2 * pitch - d - _both_sides(params)) if shafts == 1 else whole - gap
    thickness = params.cam_thickness or max(room, LEAST_SHARE * pitch)
    dent = max(pitch - d - 2 * c, LEAST_SHARE * LEAST_SHARE * pitch)
    return PitchShares(whole, thickness, dent, 0, gap, max(whole - thickness, 0.0), 2 * c)


def _both_sides(params: SheddingParams) -> float:
    """Room of a warp to both sides [m]: its clearance, at least the tolerance of a sheet that is so much thicker."""
    room = 2 * params.warp_clearance
    for _ in range(2):
        room = max(room, sheet_tolerance(params.diameter + room, params.sheet_tolerance))
    return room


def passing_gap(shafts: int, diameter: float, clearance: float) -> float:
    """Room that the warps of the other shafts need between two cams of a shaft [m]: (k - 1) d + k c, 0 for one.

    >>> passing_gap(1, 1.0, 0.1), passing_gap(3, 1.0, 0.1)
    (0.0, 2.3)
    """
    return (shafts - 1) * diameter + shafts * clearance if shafts > 1 else 0.0


def guide_radius(params: SheddingParams, cam: PlateCam, lift: float) -> float:
    """Radius of guide cams or reed about a cam [m]: the nose, and the guides' height above it."""
    return cam.prime_radius + lift - cam.roller_radius + params.guide_height


def cam_outline(cam: PlateCam) -> ComplexArray:
    """Points of the outline of a cam [m], counter-clockwise: as it is cut, drawn and weighed."""
    return cam.surface(-np.arange(POINTS) * (TURN / POINTS))


def moments(cam: PlateCam) -> tuple[float, float]:
    """Area [m^2] of a cam and polar moment about its axis [m^4], bore included."""
    return polygon_moments(cam_outline(cam))


def guides_of(shares: PitchShares, cams: int) -> int:
    """Guide cams of a shaft: one between two cams and at both ends, or on both sides of each cam.

    >>> guides_of(PitchShares(2e-3, 1e-3, 1e-3, 1, 0.0, 0.0, 0.0), 608)
    609
    """
    return cams + 1 if shares.guides == 1 else cams * shares.guides


def filled(params: SheddingParams, cam: PlateCam, shares: PitchShares, cams: int, bar: float) -> tuple[float, float]:
    """Mass [kg] and moment of inertia [kg m^2] of a stack with so many cams, the bar in its bores.

    Between the ends of the stack the bar is as long as the pitches: the bore of the guide cam beyond them is empty.
    """
    area, polar = moments(cam)
    outer, base = guide_radius(params, cam, params.lift), cam.prime_radius - cam.roller_radius
    guides = guides_of(shares, cams)
    rings = (outer, guides * shares.guide), (base, cams * shares.spacer)
    empty = bar**2 * (guides - cams * shares.guides) * shares.guide
    volume = cams * area * shares.thickness + sum(math.pi * radius**2 * width for radius, width in rings) - empty
    second = cams * polar * shares.thickness + sum(math.pi / 2 * radius**4 * width for radius, width in rings)
    return params.density * volume, params.density * (second - empty * bar**2 / 6)


def stack_of(params: SheddingParams, cam: PlateCam, shares: PitchShares, cams: int, bar: float) -> CamStack:
    """The stack of a shaft with so many cams on a bar [m]."""
    outer = guide_radius(params, cam, params.lift)
    mass, inertia = filled(params, cam, shares, cams, bar)
    cam_mass = max(moments(cam)[0] - bar**2, 0.0) * shares.thickness * params.density
    guide_area = max(math.pi * outer**2 - bar**2, 0.0) if shares.guides else dent_area(params, cam)
    guide_mass = guide_area * shares.guide * params.density
    base = cam.prime_radius - cam.roller_radius
    spacer_mass = max(math.pi * base**2 - bar**2, 0.0) * shares.spacer * params.density
    return CamStack(shares.thickness, shares.guide, outer, cam_mass, guide_mass, mass, inertia, shares, spacer_mass)


def dent_room(params: SheddingParams) -> float:
    """Room between the noses and the inner edge of the dents [m]: a share of the warp, which cannot slip through."""
    return min(params.diameter / 3, params.guide_height / 2)


def dent_area(params: SheddingParams, cam: PlateCam) -> float:
    """Area of a dent [m^2]: the ring round the noses, from the warps' line over the tip and back to it, and its tab."""
    outer, base = guide_radius(params, cam, params.lift), cam.prime_radius - cam.roller_radius
    inner, (long, high) = outer - params.guide_height + dent_room(params), DENT_TAB
    root = math.asin(high / 2 / outer)
    tab = high * (outer + long) - outer**2 * (root + math.sin(root) * math.cos(root))
    return math.acos(min(base / outer, 1.0)) * (outer**2 - inner**2) + tab
