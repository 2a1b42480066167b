"""The three cylinders: loads, bending, bearings and shaft ends.

    upper    the warps wind off it and pull down with T n / l, in the direction of its weight
    lower    the carpet winds on it and pulls up, against its weight
    spacer   the warps wrap it by an angle phi, from behind to straight down: the resultant of both strands,
             T n / l (-i + i exp(i phi)), 2 T sin(phi/2) a warp, and its weight; its slots reduce the tube's section

T n is the pull of the worst case. Loads are complex, x to the front, y upwards. A cylinder bends in the plane of its
load, as a beam between its bearings.
The warps slip over the spacer: on its other side they pull with T exp(mu phi) while they move. That bounds the torque
at its driven end, whatever its motor does: T n (exp(mu phi) - 1) R.

Bearings: the load is the reaction; life after ISO 281 in turns of the cylinder, which are few, so that the static
safety C0 / P0 decides, 1.5 and more [ISO 76: 1 to 2 for ball bearings under normal conditions]. A shaft end of the
bearing's bore carries the reaction at an overhang e and, on the driven side, the torque:

    sigma = 32 R e / (pi d³),   tau = 16 M / (pi d³),   sigma_v = sqrt(sigma² + 3 tau²)              [von Mises]

Its shoulder at the flange must bear that for any number of turns, with its notch [`elements.shoulders`]: the reaction
turns, the torque stands.
"""

import math
from dataclasses import replace
from functools import cache, lru_cache

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.bearing_table import CYLINDRICAL, DEEP_GROOVE, INSERT
from ilmek.elements.bearings import (
    ROLLING_BEARINGS,
    RollingBearing,
    equivalent_load,
    find_bearing,
    hours,
    life,
    slope_limit,
    static_load,
)
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.elements.parallel_keys import KeyedEnd, keyed_end
from ilmek.elements.shoulders import LEAST_SAFETY, Shoulder
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.machines.bearing_seats import BearingSeat, seat_of
from ilmek.machines.warp_tension.design import LARGE_TUBES, WarpTensionDesign, keeps_limits, tube_weight, worst_load
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.machines.warp_tension.slot import bored_tube
from ilmek.machines.warp_tension.spigot import (
    bored,
    flange_radius,
    spigot_length,
    weld_force,
    weld_throat,
)
from ilmek.part.profile import Profile
from ilmek.part.shapes import Shape, Turned, bored_ends
from ilmek.part.shapes import tube as hollow
from ilmek.plane.contours import polygon
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least, at_most
from ilmek.units import hour, mm
from ilmek.weaving.tension import capstan

STUB = MATERIALS["heat-treatable steel"]
THESIS_BEARING = "UCF 207"
LEAST_WALL = 3 * mm
"""Metal under the slots of the spacer; assumed by this project."""

UPPER, LOWER, SPACER = "upper", "lower", "spacer"

SLIT = 1e-3
"""Share of the wall that counts as left where slots cut through the spacer; its checks fail."""


def part_id(name: str) -> str:
    """Id of a part or body of the warp tension."""
    return f"warp-tension/{name}"


@record
class Cylinder:
    """A cylinder between its bearings.

    inner, outer   radii of its section [m]: of the spacer below the slots      tube  of stock, or None
    shell          the tube between the bearings, the spacer's with its slots
    load, bare     per length, x to the front, y upwards [N/m], with and without its own weight
    slope, deflection, stress, slope_bare, deflection_bare   by the load; without its own weight
    torque         at its driven end [N m]        mass    of the tube [kg]
    life, time     of the bearing [turns], at the take-up's mean speed [s]      static_safety  C0 / P0
    end            the shaft end at its flange
    """

    name: str
    outer: float
    inner: float
    shell: Turned
    tube: Tube | None
    bare: complex
    load: complex
    slope_bare: float
    deflection_bare: float
    slope: float
    deflection: float
    stress: float
    reaction: float
    torque: float
    mass: float
    bearing: RollingBearing
    life: float
    time: float
    static_safety: float
    end: Shoulder

    @property
    def seat(self) -> BearingSeat:
        """Its bearing on the frame's bracket."""
        return seat_of(self.bearing, self.reaction)

    @property
    def driven_end(self) -> KeyedEnd:
        """The shaft end in its reducer, with its key."""
        return keyed_end(self.bearing.bore, self.torque, STUB.strength)

    @property
    def length(self) -> float:
        """Length of the tube [m]."""
        return float(np.max(self.shell.profile.outline.points.real))

    @property
    def spigot(self) -> tuple[float, float]:
        """Diameter and length of the spigot of a shaft end in the tube [m]."""
        return 2 * bored(self), spigot_length(self.length)

    @property
    def shape(self) -> Shape:
        """The tube with its slots, bored at both ends for its spigots, about z from z = 0."""
        bore, deep = self.spigot
        if self.name == SPACER:
            return bored_ends(self.shell, bore / 2, deep)
        return bored_tube(self, self.length, bore / 2, deep)

    @property
    def weld(self) -> float:
        """Force on the length of the weld of a shaft end [N/m]."""
        return weld_force(self.shell.outer_radius, self.torque, self.end.moment)

    @property
    def throat(self) -> float:
        """Throat of that weld [m]."""
        return weld_throat(self.weld, self)

    @property
    def flange(self) -> float:
        """Radius of the flange of a shaft end [m]."""
        return flange_radius(self.shell.outer_radius, self.throat)

    @property
    def stub_stress(self) -> float:
        """Von Mises stress in the shaft end [Pa]."""
        return self.end.stress

    @property
    def stub_safety(self) -> float:
        """Yield strength of the shaft end over its stress."""
        return STUB.strength / self.stub_stress if self.stub_stress > 0 else math.inf

    @property
    def tube_name(self) -> str:
        """Outer diameter x wall [mm], marked where it is no stock size."""
        if self.tube is not None:
            return self.tube.name
        return f"{2 * self.outer / mm:.5g}x{(self.outer - self.inner) / mm:.5g}, no stock size"


@record
class Slots:
    """The spacer's slots."""

    pitch: float = result("mm", "distance of the spacer's slots", name="slot_pitch", least=0.0)
    width: float = result("mm", "width of a slot", name="slot_width", least=0.0)
    depth: float = result("mm", "depth of a slot", name="slot_depth", least=0.0)
    warp: float = result("mm", "diameter of a warp", name="warp_diameter", least=0.0)

    land = computed("mm", "metal between two slots", lambda it: it.pitch - it.width, name="slot_land")


def slots_of(params: WarpTensionParams) -> Slots:
    """The spacer's slots, one for each warp."""
    warp, pitch = params.cloth.carpet_yarns.warp.diameter, params.cloth.warp_pitch
    depth = warp if params.slot_depth is None else params.slot_depth
    width = params.slot_width or min(1.1 * warp, (warp + pitch) / 2)
    return Slots(pitch, width, depth, warp)


@lru_cache(maxsize=8)
def cylinders(design: WarpTensionDesign) -> tuple[Cylinder, Cylinder, Cylinder]:
    """Upper and lower cylinder, and the spacer, in the worst case of the warps' loads."""
    params, tube = design.params, stock(design.inner_radius, design.outer_radius)
    load, sizes = design.loads.worst / params.span, (design.outer_radius, design.inner_radius)
    plain = hollow(2 * design.outer_radius, design.outer_radius - design.inner_radius, params.span)
    upper = _cylinder(design, UPPER, sizes, (plain, tube), -1j * load, design.loads.worst * design.outer_radius)
    lower = _cylinder(design, LOWER, sizes, (plain, tube), 1j * load, design.holding_torque)
    chosen = spacer_tube(params, design.outer_radius)
    under = (chosen.inner_radius + metal_left(params, chosen), chosen.inner_radius)
    shell = spacer_shell(params, chosen), chosen
    slips = 0.0 if params.by_hand else design.loads.worst * (slipping(params) - 1) * chosen.outer_radius
    spacer = _cylinder(design, SPACER, under, shell, spacer_load(params, load), slips)
    upper, lower, spacer = (replace(one, mass=one.shape.volume * params.density) for one in (upper, lower, spacer))
    return upper, lower, spacer


def metal_left(params: WarpTensionParams, section: Tube) -> float:
    """Metal under the slots of the spacer [m]."""
    return max(section.wall - slots_of(params).depth, SLIT * section.wall)


def spacer_shell(params: WarpTensionParams, section: Tube) -> Turned:
    """The spacer's tube with a slot for each warp that has room on it, about z from z = 0."""
    slots, outer, width = slots_of(params), section.outer_radius, params.span
    number = min(params.cloth.warps, math.floor(width / slots.pitch * (1 - 1e-9)))
    if slots.depth <= 0 or number == 0:
        return hollow(section.outer, section.wall, width)
    under, half = section.inner_radius + metal_left(params, section), min(slots.width, 0.999 * slots.pitch) / 2
    middles = width / 2 + (np.arange(number)[::-1] - (number - 1) / 2) * slots.pitch
    edges = np.array([half + 1j * outer, half + 1j * under, -half + 1j * under, -half + 1j * outer])
    slotted = (middles[:, None] + edges).ravel()
    inner = np.array([1j * section.inner_radius, width + 1j * section.inner_radius])
    return Turned(Profile(polygon(np.concatenate([inner, [width + 1j * outer], slotted, [1j * outer]]))))


def spacer_load(params: WarpTensionParams, load: float) -> complex:
    """Resultant of the warps on the spacer per length [N/m]: one strand goes down, the other back."""
    return complex(load * (-1j + 1j * np.exp(1j * params.spacer_wrap)))


def tension_beyond(params: WarpTensionParams) -> float:
    """Tension of a warp on the other side of the spacer while it slips [N]."""
    return params.cloth.warp_tension * slipping(params)


def slipping(params: WarpTensionParams) -> float:
    """Ratio of the tensions on both sides of the spacer at which the warps slip over it."""
    return capstan(params.cloth.yarns.friction, params.spacer_wrap)


def stock(inner: float, outer: float) -> Tube | None:
    """The stock tube of these radii [m]; None where none is."""
    return next((t for t in TUBES.values() if abs(t.outer_radius - outer) + abs(t.inner_radius - inner) < 1e-7), None)


def _cylinder(  # noqa: PLR0917
    design: WarpTensionDesign,
    name: str,
    sizes: tuple[float, float],
    shell: tuple[Turned, Tube | None],
    bare: complex,
    torque: float,
) -> Cylinder:
    params, (outer, inner), (made, tube) = design.params, sizes, shell
    weight = made.moments.zeroth * params.density * GRAVITY / params.span
    load = bare - 1j * weight
    size, inertia = abs(load), float(uniform.tube_inertia(outer, inner))
    bent = (params.span, params.modulus, inertia)
    reaction = float(uniform.reaction(size, params.span))
    slope = float(uniform.slope_max(size, *bent))
    bearing = bearing_for(params, reaction, torque, slope)
    lives = life(bearing.dynamic, equivalent_load(bearing, reaction), bearing.kind)
    return Cylinder(
        name=name,
        outer=outer,
        inner=inner,
        shell=made,
        tube=tube,
        bare=bare,
        load=load,
        slope_bare=float(uniform.slope_max(abs(bare), *bent)),
        deflection_bare=float(uniform.deflection_max(abs(bare), *bent)),
        slope=slope,
        deflection=float(uniform.deflection_max(size, *bent)),
        stress=float(uniform.bending_stress(uniform.moment_max(size, params.span), outer, inertia)),
        reaction=reaction,
        torque=torque,
        mass=weight / GRAVITY * params.span,
        bearing=bearing,
        life=lives,
        time=hours(lives, params.cloth.row_distance / outer / params.row_time) * hour,
        static_safety=bearing.static / static_load(bearing, reaction),
        end=shaft_end(params, reaction, torque, bearing.bore),
    )


def bearing_for(params: WarpTensionParams, reaction: float, torque: float, slope: float) -> RollingBearing:
    """The bearing given; default: the first of `bearings_offered` that is enough, else the strongest ball bearing."""
    if params.bearing is not None:
        return find_bearing(params.bearing)
    offered = bearings_offered()
    enough = (
        bearing
        for bearing in offered
        if all(check.ok for check in bearing_checks(params, bearing, reaction, torque, slope))
    )
    return next(enough, max(offered, key=lambda one: one.static * (one.kind == DEEP_GROOVE)))


@cache
def bearings_offered() -> tuple[RollingBearing, ...]:
    """The thesis' bearing; then flanged inserts, deep-groove ball and cylindrical roller bearings, each by its bore."""
    by_bore = sorted(ROLLING_BEARINGS.values(), key=lambda one: (_KINDS.index(one.kind), one.bore, one.mass))
    return find_bearing(THESIS_BEARING), *(one for one in by_bore if one.kind != INSERT or one.flange)


@lru_cache(maxsize=256)
def bearing_checks(
    params: WarpTensionParams, bearing: RollingBearing, reaction: float, torque: float, slope: float
) -> tuple[Check, ...]:
    """Static safety, slope and shaft end of a bearing under a reaction [N], a torque [N m] and a slope [rad]."""
    static, end = bearing.static / static_load(bearing, reaction), shaft_end(params, reaction, torque, bearing.bore)
    safety = STUB.strength / end.stress if end.stress > 0 else math.inf
    return (
        at_least("static safety", static, params.static_safety, "1", "ISO 76: parameter static_safety"),
        at_most("slope of the bearing", slope, slope_limit(bearing), "rad", "its kind"),
        at_least("shaft end", safety, params.stub_safety, "1", f"yield of {STUB.name}: parameter stub_safety"),
        at_least("fatigue of the shaft end", end.safety, LEAST_SAFETY, "1", "Goodman, DIN 743-2"),
        keyed_end(bearing.bore, torque, STUB.strength).check("shaft end", "", ()),
    )


def shaft_end(params: WarpTensionParams, reaction: float, torque: float, diameter: float) -> Shoulder:
    """The shaft end of a diameter [m] at its flange, under a reaction [N] and a torque [N m]."""
    return Shoulder(_WIDE * diameter, diameter, STUB.tensile, reaction * params.stub, torque, alternating=False)


_WIDE = 4.0
"""Diameter of the flange over that of the shaft end: wider ones do not change the notch factor."""

_KINDS = (INSERT, DEEP_GROOVE, CYLINDRICAL)


def spacer_tubes(params: WarpTensionParams) -> tuple[Tube, ...]:
    """The tubes with metal enough under the slots, the lightest first."""
    depth = slots_of(params).depth
    thick = [tube for tube in (*TUBES.values(), *LARGE_TUBES) if tube.wall >= depth + LEAST_WALL]
    return tuple(sorted(thick or [max(TUBES.values(), key=lambda tube: tube.wall)], key=lambda tube: tube.area))


def spacer_tube(params: WarpTensionParams, radius: float = math.inf) -> Tube:
    """The spacer's tube: as given, or the lightest that keeps the limits below its slots; the stiffest if none does.

    One within the radius of the other cylinders [m] is preferred: it has their room.
    """
    if params.spacer_tube is not None:
        return find_tube(params.spacer_tube)
    depth, pull = slots_of(params).depth, spacer_load(params, abs(worst_load(params)))
    offered = sorted(spacer_tubes(params), key=lambda one: one.outer_radius > radius + 0.5 * mm)

    def keeps(tube: Tube) -> bool:
        """Its metal between the slots weighs, and counts as uncut."""
        under = tube.outer_radius - depth
        lands = tube_weight(params, under, tube.outer_radius)
        return keeps_limits(params, tube.inner_radius, under, pull - 1j * lands)

    return next(filter(keeps, offered), max(offered, key=lambda tube: tube.inertia))
