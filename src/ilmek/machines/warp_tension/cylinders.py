"""The three cylinders: loads, bending, bearings and shaft ends.

    upper    the warps wind off it and pull down with T n / l, in the direction of its weight
    lower    the carpet winds on it and pulls up, against its weight
    spacer   the warps wrap it by an angle phi, from behind to straight down: the resultant of both strands,
             T n / l (-i + i exp(i phi)), 2 T sin(phi/2) a warp, and its weight; its slots reduce the tube's section

Loads are complex, x to the front, y upwards. A cylinder bends in the plane of its load, as a beam between its bearings.
The warps slip over the spacer: on its other side they pull with T exp(mu phi) while they move.

Bearings: the load is the reaction; life after ISO 281 in turns of the cylinder, which are few, so that the static
safety C0 / P0 decides, 1.5 and more [ISO 76: 1 to 2 for ball bearings under normal conditions]. A shaft end of the
bearing's bore carries the reaction at an overhang e and, on the driven side, the torque:

    sigma = 32 R e / (pi d³),   tau = 16 M / (pi d³),   sigma_v = sqrt(sigma² + 3 tau²)              [von Mises]
"""

import math

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
from ilmek.elements.carpet_yarns import usual_warp
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.errors import ParameterError
from ilmek.machines.warp_tension.design import WarpTensionDesign, keeps_limits, tube_weight
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.records import computed, record, result
from ilmek.units import format_quantity, hour, mm
from ilmek.weaving.tension import capstan

STATIC_SAFETY = 1.5
STUB = MATERIALS["heat-treatable steel"]
STUB_SAFETY = 1.5
THESIS_BEARING = "UCF 207"
TAUT = 0.6
"""Largest diameter of a warp over the pitch: under tension it is thinner than as yarn, and leaves room for metal."""

LEAST_WALL = 3 * mm
"""Metal under the slots of the spacer."""


@record
class Cylinder:
    """A cylinder between its bearings.

    inner, outer   radii of its section [m]: of the spacer below the slots      tube  of stock, or None
    load, bare     per length, x to the front, y upwards [N/m], with and without its own weight
    slope, deflection, stress, slope_bare, deflection_bare   by the load; without its own weight
    torque         at its driven end [N m]        mass    of the tube [kg]
    life, time     of the bearing [turns], at the take-up's mean speed [s]      static_safety  C0 / P0
    stub_stress    von Mises, in the shaft end [Pa]
    """

    name: str
    outer: float
    inner: float
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
    stub_stress: float

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
    usual = min(usual_warp(params.pitch).diameter, TAUT * params.pitch)
    warp = params.warp_diameter or usual
    depth = warp if params.slot_depth is None else params.slot_depth
    return Slots(params.pitch, params.slot_width or 1.1 * warp, depth, warp)


def cylinders(design: WarpTensionDesign) -> tuple[Cylinder, Cylinder, Cylinder]:
    """Upper and lower cylinder, and the spacer. Raises ParameterError where its slots cut through it."""
    params, tube = design.params, stock(design.inner_radius, design.outer_radius)
    sizes = design.outer_radius, design.inner_radius
    upper = _cylinder(design, "upper", sizes, tube, -1j * design.load, design.torque)
    lower = _cylinder(design, "lower", sizes, tube, 1j * design.load, design.torque_full)
    chosen = _spacer_tube(params, design.load)
    solid = (chosen.outer_radius, chosen.inner_radius) if chosen else sizes
    depth = slots_of(params).depth
    if solid[0] - solid[1] <= depth:
        wall = format_quantity(solid[0] - solid[1], "mm")
        raise ParameterError(
            f"slots of {format_quantity(depth, 'mm')} cut through a spacer with a wall of {wall}",
            allowed=f"less than {wall}",
            do="set a smaller slot_depth, or a spacer_tube with a thicker wall",
        )
    under = (solid[0] - depth, solid[1])
    spacer = _cylinder(design, "spacer", under, chosen or tube, spacer_load(params, design.load), 0.0)
    return upper, lower, spacer


def spacer_load(params: WarpTensionParams, load: float) -> complex:
    """Resultant of the warps on the spacer per length [N/m]: one strand goes down, the other back."""
    return complex(load * (-1j + 1j * np.exp(1j * params.spacer_wrap)))


def tension_beyond(params: WarpTensionParams) -> float:
    """Tension of a warp on the other side of the spacer while it slips [N]."""
    return params.tension * capstan(params.friction, params.spacer_wrap)


def stock(inner: float, outer: float) -> Tube | None:
    """The stock tube of these radii [m]; None where none is."""
    return next((t for t in TUBES.values() if abs(t.outer_radius - outer) + abs(t.inner_radius - inner) < 1e-7), None)


def _cylinder(  # noqa: PLR0917
    design: WarpTensionDesign, name: str, sizes: tuple[float, float], tube: Tube | None, bare: complex, torque: float
) -> Cylinder:
    params, (outer, inner) = design.params, sizes
    weight = tube_weight(params, inner, outer)
    load = bare - 1j * weight
    size, inertia = abs(load), float(uniform.tube_inertia(outer, inner))
    bent = (params.width, params.modulus, inertia)
    reaction = float(uniform.reaction(size, params.width))
    slope = float(uniform.slope_max(size, *bent))
    bearing = bearing_for(params, reaction, torque, slope)
    lives = life(bearing.dynamic, equivalent_load(bearing, reaction), bearing.kind)
    return Cylinder(
        name=name,
        outer=outer,
        inner=inner,
        tube=tube,
        bare=bare,
        load=load,
        slope_bare=float(uniform.slope_max(abs(bare), *bent)),
        deflection_bare=float(uniform.deflection_max(abs(bare), *bent)),
        slope=slope,
        deflection=float(uniform.deflection_max(size, *bent)),
        stress=float(uniform.bending_stress(uniform.moment_max(size, params.width), outer, inertia)),
        reaction=reaction,
        torque=torque,
        mass=weight / GRAVITY * params.width,
        bearing=bearing,
        life=lives,
        time=hours(lives, params.row_pitch / outer / params.row_time) * hour,
        static_safety=bearing.static / static_load(bearing, reaction),
        stub_stress=stub_stress(params, reaction, torque, bearing.bore),
    )


def bearing_for(params: WarpTensionParams, reaction: float, torque: float, slope: float) -> RollingBearing:
    """The bearing given; default: the thesis', or where that is not enough the smallest that is.

    Flanged inserts come first, as in the thesis, then deep-groove ball and cylindrical roller bearings, each by its
    bore. Where none is enough it is the largest ball bearing, and a check fails.
    """
    if params.bearing is not None:
        return find_bearing(params.bearing)
    offered = sorted(ROLLING_BEARINGS.values(), key=lambda one: (_KINDS.index(one.kind), one.bore, one.mass))
    kept = [one for one in offered if one.kind != INSERT or one.name.startswith("UCF")]
    usual = find_bearing(THESIS_BEARING)
    enough = (one for one in (usual, *kept) if _enough(params, one, reaction, torque, slope))
    return next(enough, max(kept, key=lambda one: one.static * (one.kind == DEEP_GROOVE)))


def stub_stress(params: WarpTensionParams, reaction: float, torque: float, diameter: float) -> float:
    """Von Mises stress in a shaft end [Pa]."""
    section = math.pi * diameter**3 / 32
    return math.hypot(reaction * params.stub / section, math.sqrt(3) * torque / (2 * section))


_KINDS = (INSERT, DEEP_GROOVE, CYLINDRICAL)


def _enough(params: WarpTensionParams, bearing: RollingBearing, reaction: float, torque: float, slope: float) -> bool:
    strong = STUB.strength >= STUB_SAFETY * stub_stress(params, reaction, torque, bearing.bore)
    bears = bearing.static >= STATIC_SAFETY * static_load(bearing, reaction)
    return strong and bears and slope <= slope_limit(bearing)


def _spacer_tube(params: WarpTensionParams, load: float) -> Tube | None:
    """The spacer's tube: as given, or the lightest that keeps the limits below its slots; None where none does."""
    depth = slots_of(params).depth
    if params.spacer_tube is not None:
        return find_tube(params.spacer_tube)
    pull, by_mass = spacer_load(params, load), sorted(TUBES.values(), key=lambda tube: tube.area)
    thick = (tube for tube in by_mass if tube.wall >= depth + LEAST_WALL)
    return next((one for one in thick if keeps_limits(params, one.inner_radius, one.outer_radius - depth, pull)), None)
