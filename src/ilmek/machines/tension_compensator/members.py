"""Bars, levers, pins and beams of the compensator: each the lightest of its table that keeps its checks.

A bar rests on m levers in the middle of m equal parts p of its width: its ends overhang by p/2. Under a load w

    M = w p^2 / 8,      deflection of an end = 7 w p^4 / (384 E I)   [derived; exact for two levers, more bend less]
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from ilmek.elements.beam import uniform
from ilmek.elements.bearing_table import DEEP_GROOVE, RollingBearing
from ilmek.elements.bearings import ROLLING_BEARINGS, life
from ilmek.elements.columns import SECTIONS, HollowSquare
from ilmek.elements.fillet_welds import STRENGTH, TwoSeams, throat_for
from ilmek.elements.materials import MATERIALS
from ilmek.elements.pin_joints import mean_pressure, pin_bending, pin_shear
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.machines.tension_compensator.params import STEEL, TensionCompensatorParams
from ilmek.records import record
from ilmek.report import Alternative, Check, Choice, at_most, choose
from ilmek.units import MPa, deg, format_quantity, mm

T = TypeVar("T")

HEIGHTS = tuple(size * mm for size in (30, 40, 50, 60, 80, 100, 120, 150, 200, 250, 300))
"""Heights of flat bars for the levers [m]: a choice from EN 10058."""

PINS = tuple(size * mm for size in (12, 16, 20, 25, 30, 40, 50, 60, 80))
"""Diameters of pivot pins [m]."""

BUSH_WALL = 3 * mm
"""Wall of a pin's bush [m]; assumed by this project."""

WIDEST_BORE = 0.6
"""Largest bore of a lever for its bush, over its height; assumed by this project."""

SADDLE = 45 * deg
"""Angle of each roller to the middle of the two that carry a bar; assumed by this project."""

ROLLER_TURNS, ROLLER_STATIC = 1e7, 1.25
"""Turns that a roller lives, and least C0 / P0 of one whose ring no housing holds; assumed by this project."""

TOUGH = MATERIALS["alloy heat-treatable steel"]
"""Of the pins that springs bend."""

STRIP, CORNER = 0.8, 1.25
"""Half of a saddle's width over its roller's bore, and from its bar to its corner over the roller; assumed."""

ROLLER_PLAY = 1 * mm
"""Play of a roller beside its saddle [m]; assumed by this project."""

PRESSURE = 20 * MPa
"""Allowed pressure of a pin in its bush, twice its diameter long; bronze, assumed by this project."""

SHEAR = 0.577
"""Yield strength in shear over that in tension [von Mises]."""


def part_id(name: str) -> str:
    """Id of a part or body of the compensator."""
    return f"tension-compensator/{name}"


CURE = "set a lower tension or lift, or a shorter support_span"


@dataclass(frozen=True, slots=True)
class Loads:
    """Loads in the open shed: of a bar [N/m], torque of the warps on a lever [N m], force on its pivot [N].

    spread  distance of the two rods that bear the bar's load too [m]
    overhung  moment of the springs on one side of a lever about its face [N m]
    """

    line: float
    torque: float
    pivot: float
    spread: float
    overhung: float


@record
class Members:
    """What was chosen: tube of bars and rods, height of a lever [m], its pin and that of its springs [m], beam, roller,
    height of a cross-piece [m], throat of a saddle's weld [m]; and the choices.
    """

    tube: Tube
    lever: float
    pin: float
    spring_pin: float
    beam: HollowSquare
    roller: RollingBearing
    cross: float
    throat: float
    choices: tuple[Choice, ...]


def bar_tubes(params: TensionCompensatorParams) -> tuple[Tube, ...]:
    """The tubes offered for bars and rods, the lightest first."""
    if params.bar_tube is not None:
        return (find_tube(params.bar_tube),)
    return tuple(sorted(TUBES.values(), key=lambda tube: tube.area))


def members_for(params: TensionCompensatorParams, tube: tuple[Tube, Choice], loads: Loads) -> Members:
    """Levers, pins and beam for the loads, with the tube of the bars that was chosen before."""
    sections = sorted((HollowSquare(*size) for size in SECTIONS), key=lambda section: section.area)
    pin, of_pin = pick("pin", PINS, lambda one: format_quantity(one, "mm"), lambda one: pin_checks(params, one, loads))
    lever, of_lever = pick(
        "lever", HEIGHTS, lambda one: format_quantity(one, "mm"), lambda one: lever_checks(params, one, pin, loads)
    )
    beam, of_beam = pick("beam", sections, lambda one: one.name, lambda one: beam_checks(params, one, loads))
    given = () if params.bar_tube else (tube[1],)
    roller = roller_for(params, loads.line)
    cross = max(math.ceil(cross_height(params, loads) / mm) * mm, 2 * STRIP * roller.bore)
    springs = next((one for one in PINS if spring_pin_check(params, one, loads).ok), PINS[-1])
    seams = saddle_seams(params, tube[0].outer_radius, roller, loads)
    throat = throat_for(seams, params.lever_thickness, params.lever_thickness)
    return Members(tube[0], lever, pin, springs, beam, roller, cross, throat, (*given, of_lever, of_pin, of_beam))


def saddle_seams(params: TensionCompensatorParams, radius: float, roller: RollingBearing, loads: Loads) -> float:
    """Greatest force on a length of the seams of a bar's saddle on its lever [N/m].

    radius  of the bar [m]. The bar's force lies a thickness beside the lever, its part across the arm at the saddle's
    corner as far as the bar; the seams are as long, and as far from each other, as the saddle is wide.
    """
    force, wide = loads.line * params.cloth.width / params.levers, 2 * STRIP * roller.bore
    moment = loads.torque / params.bar_arm * (radius + CORNER * roller.outer)
    return TwoSeams(wide, wide).force(force, moment, force * params.lever_thickness)


def saddle_checks(
    params: TensionCompensatorParams, radius: float, members: Members, loads: Loads
) -> tuple[Check, Check]:
    """The seams of a saddle, and the pin of its roller, that stands out of it; radius  of the bar [m]."""
    roller, seams = members.roller, saddle_seams(params, radius, members.roller, loads)
    source = "fillet welds of S235 [EN 1993-1-8, 4.5.3.3]"
    return (
        at_most("stress of the weld of a saddle", seams / members.throat, STRENGTH, "MPa", source).with_cure(
            CURE, part_id("saddle")
        ),
        roller_pin_check(params, roller, loads.line),
    )


def roller_pin_check(params: TensionCompensatorParams, roller: RollingBearing, line: float) -> Check:
    """Bending of a roller's pin, that stands out of its saddle to the roller's middle; line  load of a bar [N/m]."""
    bent = _roller_force(params, line) * (ROLLER_PLAY + roller.width / 2)
    return at_most("bending of the pin of a roller", 32 * bent / (math.pi * roller.bore**3), *_limit(params)).with_cure(
        CURE, part_id("roller-pin"), part_id("roller")
    )


def spring_pin_check(params: TensionCompensatorParams, pin: float, loads: Loads) -> Check:
    """Bending of the pin that carries springs on both sides of a lever, or of their lug, at its face."""
    stress = 32 * loads.overhung / (math.pi * pin**3)
    source = f"yield of {TOUGH.designation} over the parameter safety"
    return at_most("bending of a pin of the springs", stress, TOUGH.strength / params.safety, "MPa", source).with_cure(
        "set a smaller width, or more levers: a shorter support_span", part_id("spring-pin")
    )


def cross_height(params: TensionCompensatorParams, loads: Loads) -> float:
    """Least height [m] of the pieces that carry both rods, on a beam below the rear one.

    Each rod bears half of the bar's load, w p / 2, the front one at the rods' distance g: h² = 6 w p g / (2 t sigma).
    """
    return math.sqrt(6 * _cross_moment(params, loads) / (params.lever_thickness * params.strength / params.safety))


def cross_check(params: TensionCompensatorParams, height: float, loads: Loads) -> Check:
    """Bending of the pieces that carry the rods, of a height [m]."""
    stress = 6 * _cross_moment(params, loads) / (params.lever_thickness * height**2)
    return at_most("stress of a cross-piece of the rods", stress, *_limit(params)).with_cure(
        CURE, part_id("cross-piece")
    )


def _cross_moment(params: TensionCompensatorParams, loads: Loads) -> float:
    return loads.line * params.cloth.width / params.levers / 2 * loads.spread


def roller_for(params: TensionCompensatorParams, line: float) -> RollingBearing:
    """The smallest ball bearing that lives as the roller of bars and rods on its pin, else that of the largest load.

    line  load of a bar [N/m]; two rollers carry it at a lever
    """
    force = _roller_force(params, line)
    balls = sorted((row for row in ROLLING_BEARINGS.values() if row.kind == DEEP_GROOVE), key=lambda row: row.outer)
    lasting = (row for row in balls if row.static >= ROLLER_STATIC * force)
    living = (row for row in lasting if life(row.dynamic, force, row.kind) >= ROLLER_TURNS)
    borne = (row for row in living if roller_pin_check(params, row, line).ok)
    return next(borne, max(balls, key=lambda row: row.static))


def _roller_force(params: TensionCompensatorParams, line: float) -> float:
    return line * params.cloth.width / params.levers / (2 * math.cos(SADDLE))


def pick(
    name: str, offered: Sequence[T], label: Callable[[T], str], checks: Callable[[T], tuple[Check, ...]]
) -> tuple[T, Choice]:
    """The first of some in ascending order of price that keeps its checks, the last where none does; the choice."""
    judged: list[Alternative] = []
    for one in offered:
        judged.append(Alternative(label(one), checks(one)))
        if not judged[-1].failed:
            return one, choose(name, judged)[1]
    return offered[-1], Choice(name, label(offered[-1]), "the largest of the table")


def bar_checks(params: TensionCompensatorParams, tube: Tube, line: float) -> tuple[Check, ...]:
    """Deflection and stress of a bar under a load [N/m]."""
    span = params.cloth.width / params.levers
    sag = 7 * line * span**4 / (384 * STEEL.modulus * tube.inertia)
    return (
        at_most("deflection of a bar", sag, params.bar_deflection, "mm", "parameter bar_deflection").with_cure(
            CURE, part_id("bar")
        ),
        at_most("stress of a bar", line * span**2 / 8 / tube.modulus, *_limit(params)).with_cure(CURE, part_id("bar")),
    )


def lever_checks(params: TensionCompensatorParams, height: float, pin: float, loads: Loads) -> tuple[Check, ...]:
    """Bending of a lever of a height [m] at its pivot, beside the bore of the pin's bush, and the room of that bore."""
    bored = (pin + 2 * BUSH_WALL) / height
    section = params.lever_thickness * height**2 / 6 * max(1 - bored**3, 1e-9)
    return (
        at_most("stress of a lever", loads.torque / section, *_limit(params)).with_cure(
            "set a larger lever_thickness", part_id("lever")
        ),
        at_most("bore of a lever over its height", bored, WIDEST_BORE, "1", "assumed by this project").with_cure(
            "set a longer spring_arm, or a lower tension", part_id("lever"), part_id("bush")
        ),
    )


def pin_checks(params: TensionCompensatorParams, pin: float, loads: Loads) -> tuple[Check, ...]:
    """Shear of a pin of a diameter [m] in two sections, its bending between the lugs, and its pressure in the bush."""
    shear, pressure = pin_shear(loads.pivot, pin), mean_pressure(loads.pivot, pin, 2 * pin)
    bent = pin_bending(loads.pivot, pin, 2 * pin, params.lever_thickness)
    cure, source = "set a longer spring_arm", "bronze, assumed by this project"
    return (
        at_most("shear of a pivot pin", shear, SHEAR * params.strength / params.safety, "MPa", "yield").with_cure(
            cure, part_id("pin")
        ),
        at_most("bending of a pivot pin", bent, *_limit(params)).with_cure(cure, part_id("pin")),
        at_most("pressure of a pivot pin", pressure, PRESSURE, "MPa", source).with_cure(cure, part_id("pin")),
    )


def beam_checks(params: TensionCompensatorParams, section: HollowSquare, loads: Loads) -> tuple[Check, ...]:
    """Deflection and stress of the beam that carries the levers, from column to column."""
    given = loads.line, params.cloth.width
    sag = float(uniform.deflection_max(*given, STEEL.modulus, section.inertia))
    stress = float(uniform.bending_stress(uniform.moment_max(*given), section.side / 2, section.inertia))
    source = "assumed by this project: parameter beam_sag"
    cure = "set a lower tension, a narrower loom, or a larger beam_sag"
    return (
        at_most("deflection of the levers' beam", sag, params.beam_sag * params.cloth.width, "mm", source).with_cure(
            cure, part_id("beam")
        ),
        at_most("stress of the levers' beam", stress, *_limit(params)).with_cure(cure, part_id("beam")),
    )


def _limit(params: TensionCompensatorParams) -> tuple[float, str, str]:
    return params.strength / params.safety, "MPa", "yield over the parameter safety"
