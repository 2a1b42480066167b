"""Strength of a needle mechanism over a turn of its main shaft: links, pins, shafts, bearings, motor.

A link is the largest flat bar of stock that is not heavier than the mass given for it; given widths change no mass.
The crank is an eccentric on the main shaft, without a check of its own. Rocker and arm are bent as cantilevers on the
driven shaft. Each mechanism has two bearings on either shaft, one beside each face of its links, with half the force:

    M = F/2 lever,   T from its least to its greatest value over the turn;   safety after Goodman, feather keyway
"""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from ilmek.dynamics.inverse_run import rms
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.pin_strength import PinDuty, bearing_life, pin_duty
from ilmek.elements.bearing_table import DEEP_GROOVE, ROLLING_BEARINGS, RollingBearing
from ilmek.elements.duty import MARGIN
from ilmek.elements.fatigue import NOTCHES, Loading, endurance_limit, goodman, notch_factor
from ilmek.elements.motors import SERVO, Motor, geared_motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.elements.sections import round_section
from ilmek.machines.linkage_strength import LinkageStrength, bore_for, linkage_loads, linkage_strength, strength_checks
from ilmek.machines.tufting.design import Tufting, loaded, turn_with
from ilmek.machines.tufting.links import LINKS, NAME, STEEL, NeedleSizes, link_sections
from ilmek.machines.tufting.model import PINS, friction
from ilmek.machines.tufting.params import TuftingParams
from ilmek.machines.tufting.strength_params import NeedleStrengthParams
from ilmek.records import computed, group, record, result
from ilmek.report import Check, at_least, must
from ilmek.units import mm

SHAFTS = tuple(size * mm for size in (20, 25, 30, 35, 40, 45, 50, 55, 60, 70, 80))
"""Diameters of shafts to choose from [m]: the bores of the bearings."""

KEYWAY, KEYWAY_RADIUS = NOTCHES["keyway"], 0.02
"""Stress concentration of a keyway, and its radius over the shaft's diameter [Shigley, table 7-1]."""

MOTOR = (f"{NAME}/motor",)

SERVO_PEAK = 3.0
"""Peak over continuous torque of servos, for the choice of the motor."""


@record
class ShaftStrength:
    """A shaft: its diameter, and its safety against fatigue; its bearing, and the bearing's life [s of running]."""

    diameter: float
    fatigue: float
    bearing: RollingBearing
    life: float


@record
class NeedleStrength:
    """Strength of a needle mechanism; limits: those in force. motor, reducer: of the main shaft; None: no servo."""

    limits: NeedleStrengthParams
    main: ShaftStrength
    driven: ShaftStrength
    motor: tuple[Motor, Reducer] | None
    motor_torque: float = result("N*m", "continuous torque required of the motor, on the main shaft")
    linkage: LinkageStrength = group()

    main_shaft_diameter = computed("mm", "diameter of the main shaft: as given, or chosen", lambda it: it.main.diameter)
    driven_shaft_diameter = computed(
        "mm", "diameter of the driven shaft: as given, or chosen", lambda it: it.driven.diameter
    )
    main_shaft_fatigue = computed("1", "safety of the main shaft against fatigue", lambda it: it.main.fatigue)
    driven_shaft_fatigue = computed("1", "safety of the driven shaft against fatigue", lambda it: it.driven.fatigue)
    main_bearing = computed("", "bearings of the main shaft", lambda it: it.main.bearing.name)
    driven_bearing = computed("", "bearings of the driven shaft", lambda it: it.driven.bearing.name)
    main_bearing_life = computed("h", "life of the main shaft's bearings", lambda it: it.main.life)
    driven_bearing_life = computed("h", "life of the driven shaft's bearings", lambda it: it.driven.life)
    drive_motor = computed(
        "", "servo of the main shaft", lambda it: it.motor[0].name if it.motor else None, absent="none is enough"
    )


@lru_cache(maxsize=8)
def needle_strength(design: Tufting) -> NeedleStrength:
    """Stresses, safeties and lives over a turn at the speed."""
    params, limits = design.params, design.params.strength
    sections = link_sections(params)
    angle, side = turn_with(design.breaks)
    times, forces = angle / params.speed, design.state.forces
    loads = (Gravity(-1j * params.gravity), friction(params, forces.motion, side))
    line = min(width * thickness for width, thickness in sections.values()) * limits.of_links.density
    found = linkage_loads(
        forces,
        design.bodies,
        loads,
        dict.fromkeys(LINKS, ()),
        [pin for pin in PINS if pin not in ("O", "C")],
        speed=params.speed,
        line_mass=line,
        times=times,
    )
    angles, torque = design.shaft_torque()
    required = max(MARGIN * rms(torque, angles), float(np.max(np.abs(torque))) / SERVO_PEAK)
    driven = design.ranges["driven_torque"]
    return NeedleStrength(
        limits=limits,
        main=_shaft(pin_duty(forces, "O", times), (float(torque.min()), float(torque.max())), limits),
        driven=_shaft(pin_duty(forces, "C", times), driven, limits),
        motor=geared_motor(required, params.speed, (DIRECT, *PLANETARY), SERVO),
        motor_torque=required,
        linkage=linkage_strength(found, limits, sections),
    )


def design(params: TuftingParams) -> Tufting:
    """A needle mechanism; the shafts and holes of links as made grow until they bear the forces of their masses.

    Raises MechanismError where it does not turn or its rocker does not swing.
    """
    if params.link_mass == "paper":
        return loaded(params)
    sizes = needle_sizes(loaded(params))
    while True:
        tufting = loaded(params, sizes)
        needed = _required(needle_strength(tufting))
        if sizes.covers(needed):
            return tufting
        sizes = sizes.with_least(needed)


def needle_sizes(tufting: Tufting) -> NeedleSizes:
    """Diameters of shafts and pins: those that the masses were computed with, or that bear the forces."""
    return tufting.sizes or _required(needle_strength(tufting))


def _required(strength: NeedleStrength) -> NeedleSizes:
    widths = {link: section.width for link, section in strength.linkage.sections.items()}
    pins = {name: strength.linkage.pins[name].diameter for name in "BDE"}
    least = {"B": ("coupler", "rocker"), "D": ("arm", "rod"), "E": ("rod",)}
    bored = {name: bore_for(size, min(widths[link] for link in least[name])) for name, size in pins.items()}
    return NeedleSizes(strength.main.diameter, strength.driven.diameter, tuple(bored.items()))


def _shaft(duty: PinDuty, torque: tuple[float, float], limits: NeedleStrengthParams) -> ShaftStrength:
    """A shaft of the least stock diameter that is enough, and of its bearings the lightest that is enough."""
    loading = Loading(
        moment=duty.greatest / 2 * limits.shaft_lever,
        torque=abs(torque[0] + torque[1]) / 2,
        torque_amplitude=(torque[1] - torque[0]) / 2,
    )
    half = PinDuty(duty.name, duty.bodies, duty.force / 2, duty.omega, duty.weights)
    offered = (limits.shaft_diameter,) if limits.shaft_diameter else SHAFTS
    sizes = [(size, _shaft_safety(loading, size)) for size in offered]
    diameter, safety = next((one for one in sizes if one[1] >= limits.fatigue), sizes[-1])
    fitting = [
        one for one in ROLLING_BEARINGS.values() if one.kind == DEEP_GROOVE and one.bore >= diameter * (1 - 1e-9)
    ]
    if not fitting:  # The largest bearing does not fit on the shaft: no life.
        return ShaftStrength(diameter, safety, max(ROLLING_BEARINGS.values(), key=lambda one: one.bore), 0.0)
    lives = sorted(((one.mass, bearing_life(half, one), one) for one in fitting), key=lambda one: one[:2])
    _, life, bearing = next((live for live in lives if live[1] >= limits.bearing_life), lives[-1])
    return ShaftStrength(diameter, safety, bearing, life)


def _shaft_safety(loading: Loading, diameter: float) -> float:
    notch = [
        notch_factor(concentration, KEYWAY_RADIUS * diameter, STEEL.tensile, torsion=torsion)
        for concentration, torsion in zip(KEYWAY, (False, True), strict=True)
    ]
    limit = endurance_limit(STEEL.tensile, diameter)
    section = round_section(diameter)
    return goodman(loading, section, endurance=limit, tensile=STEEL.tensile, notch=(notch[0], notch[1]))


def needle_checks(strength: NeedleStrength, parts: Mapping[str, str]) -> tuple[Check, ...]:
    """Whether links, pins, shafts and bearings bear the speed; parts: ids of links and pins by name."""
    limits, slower = strength.limits, "set a lower speed, or lighter moving links and needle"
    stronger = "set a lower speed, or a heavier and therefore stronger link, or a lighter needle"
    shafts = (("main", strength.main), ("driven", strength.driven))
    return (
        *strength_checks(strength.linkage, stronger=stronger, parts=parts),
        *(
            at_least(
                f"safety of the {name} shaft against fatigue",
                shaft.fatigue,
                limits.fatigue,
                "1",
                "Goodman, keyway, C45 +QT; parameter strength.fatigue",
            ).with_cure(slower, f"{NAME}/{name}-shaft")
            for name, shaft in shafts
        ),
        *(
            at_least(
                f"life of the {name} shaft's bearings",
                shaft.life,
                limits.bearing_life,
                "h",
                f"ISO 281, {shaft.bearing.name}; parameter strength.bearing_life",
            ).with_cure(slower, f"{NAME}/{name}-bearing")
            for name, shaft in shafts
        ),
    )


def motor_check(strength: NeedleStrength) -> Check:
    """Whether a servo turns the main shaft."""
    slower = "set a lower speed, or lighter moving links and needle"
    return must("a servo turns the main shaft", strength.motor is not None, "motor table, margin 1.25").with_cure(
        slower, *MOTOR
    )
