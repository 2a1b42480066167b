"""Strength of a beat-up's links and pins over a turn of the crank at its speed.

    crank     bent by the force of the coupler across it        s = M / Z + N / A
    coupler   pulled and pushed, bent by its own inertia        s = N / A + m a l / (8 Z),   P_k = pi^2 E I / l^2
    rocker    bent at B by the beater beyond it                 s = F (AE - AB) / Z
    pins      in forks                                          t = 2 F / (pi d^2),   p = F / (d b),   (p v)_mean

w x b is the section of a link, d the diameter of its pins: A = (w - d) b, Z = b (w^3 - d^3) / (6 w), and I = w b^3 / 12
out of the plane of motion, the smaller one of flat links. v = d/2 times the relative angular velocity of the two
links; the mean of p v is that over the time from one turn to the next. The forces are those of the empty beat: the
fell's resistance opposes the inertia of the beater and relieves the pins.            [theory of beams; Euler's column]
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from ilmek.machines.beat_up.design import PINS, BeatUp
from ilmek.machines.beat_up.use_params import StrengthParams
from ilmek.plane.vectors import dot
from ilmek.records import record, result
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose
from ilmek.units import MPa, format_quantity, mm

PIN_DIAMETERS = tuple(size * mm for size in (6, 8, 10, 12, 16, 20, 25, 30, 40, 50, 63, 80, 100))
"""Diameters of pins to choose from [m]: of ISO 2341 and 2340."""

SECTIONS = tuple(
    (width * mm, thickness * mm)
    for width, thickness in (
        (30, 10), (40, 12), (50, 15), (60, 20), (80, 25), (100, 30), (120, 40), (150, 50), (200, 60), (250, 80),
    )
)  # fmt: skip
"""Width and thickness of links to choose from [m]: flat steel."""

WIDEST_PIN = 0.6
"""Largest diameter of a pin over the width of its links; assumed by this project."""


@record
class BeatUpStrength:
    """Greatest stresses of links and pins; limits: those in force."""

    limits: StrengthParams
    pin_diameter: float = result("mm", "diameter of the pins: as given, or chosen", least=0.0)
    crank_stress: float = result("MPa", "greatest stress of the crank")
    coupler_stress: float = result("MPa", "greatest stress of the coupler")
    rocker_stress: float = result("MPa", "greatest stress of the rocker, at its pin to the coupler")
    coupler_buckling: float = result("1", "safety of the coupler against buckling", least=0.0)
    pin_shear: float = result("MPa", "greatest shear stress of a pin, in a fork")
    pin_pressure: float = result("MPa", "greatest pressure of a pin on its bush")
    pin_wear: float = result("1", "greatest mean of pressure times sliding speed of a pin over the time, in MPa m/s")
    choices: tuple[Choice, ...] = ()


@record
class LinkLoads:
    """Greatest loads over a turn: moment and pull of the crank, thrust of the coupler, beater, pins and their wear."""

    crank_moment: float
    crank_pull: float
    thrust: float
    tip: float
    pin: float
    wear: float

    def scaled(self, mass: float, speed: float, share: float) -> "LinkLoads":
        """The loads of another beater at another speed, over this one's mass and speed: forces go with m w^2.

        share  of the time for which the crank turns
        """
        force = mass * speed**2
        return LinkLoads(
            self.crank_moment * force,
            self.crank_pull * force,
            self.thrust * force,
            self.tip * force,
            self.pin * force,
            self.wear * force * speed * share,
        )


@record
class LinkSection:
    """Section of all links: width in their plane, thickness [m], mass per length [kg/m]."""

    width: float
    thickness: float
    line_mass: float


def link_strength(design: BeatUp, limits: StrengthParams, every: float | None = None) -> BeatUpStrength:
    """Stresses of the links and pins of a beat-up; of the stock pins the first that is enough, else the largest.

    every  time from one turn of the crank to the next [s]; default: it turns on
    """
    params = design.params
    section = LinkSection(params.width, params.thickness, params.width * params.thickness * params.density)
    loads = link_loads(design, every)
    found = section_strength(section, loads, design.lengths, params.speed, limits)
    smaller = [size for size in PIN_DIAMETERS if size < found.pin_diameter * (1 - 1e-9)]
    if limits.pin_diameter is not None or not smaller:
        return found
    other = section_strength(section, loads, design.lengths, params.speed, replace(limits, pin_diameter=smaller[-1]))
    tried = [Alternative(format_quantity(one.pin_diameter, "mm"), pin_checks(one)) for one in (other, found)]
    return replace(found, choices=(choose("strength.pin_diameter", tried)[1],))


def section_strength(
    section: LinkSection, loads: LinkLoads, lengths: Mapping[str, float], speed: float, limits: StrengthParams
) -> BeatUpStrength:
    """The same for links of a section under given loads, at a speed of the crank [rad/s]."""
    widest = WIDEST_PIN * section.width
    stock = [size for size in PIN_DIAMETERS if size <= widest] or [widest]
    offered = [limits.pin_diameter] if limits.pin_diameter else stock
    own = section.line_mass * lengths["coupler"] ** 2 * speed**2 * lengths["crank"] / 8
    return _next_enough(_with_pins(section, loads, lengths, own, limits, size) for size in offered)


def _next_enough(tried: Iterable[BeatUpStrength]) -> BeatUpStrength:
    one = None
    for one in tried:
        if all(check.ok for check in pin_checks(one)):
            break
    assert one is not None
    return one


def strength_checks(found: BeatUpStrength) -> tuple[Check, ...]:
    """Whether links and pins bear a beat."""
    limits, wider = found.limits, "set wider or thicker links, a shorter ground, or a lower speed"
    source = "parameter strength.stress"
    return (
        at_most("stress of the crank", found.crank_stress, limits.stress, "MPa", source, cure=wider),
        at_most("stress of the coupler", found.coupler_stress, limits.stress, "MPa", source, cure=wider),
        at_most("stress of the rocker", found.rocker_stress, limits.stress, "MPa", source, cure=wider),
        at_least(
            "buckling of the coupler",
            found.coupler_buckling,
            limits.buckling,
            "1",
            "Euler, hinged; safety assumed by this project: parameter strength.buckling",
            cure="set thicker links",
        ),
        *pin_checks(found),
    )


def pin_checks(found: BeatUpStrength) -> tuple[Check, ...]:
    """Whether the pins bear a beat."""
    limits, cure = found.limits, "set wider and thicker links for larger pins, or a lower speed"
    assumed = "assumed by this project: parameter strength."
    return (
        at_most("shear of the pins", found.pin_shear, limits.pin_shear, "MPa", f"{assumed}pin_shear", cure=cure),
        at_most(
            "pressure of the pins", found.pin_pressure, limits.pin_pressure, "MPa", f"{assumed}pin_pressure", cure=cure
        ),
        at_most(
            "wear of the pins, p v", found.pin_wear, limits.pin_wear, "1", f"{assumed}pin_wear, in MPa m/s", cure=cure
        ),
    )


def link_loads(design: BeatUp, every: float | None = None) -> LinkLoads:
    """The greatest loads over a turn at the speed, and the mean wear over the time from turn to turn [s]."""
    share = 1.0 if every is None else min(design.period / every, 1.0)
    params, state = design.params, design.state
    crank, coupler = state.motion.direction("crank"), state.motion.direction("coupler")
    at_crank, at_coupler = state.forces.pin("C"), state.forces.pin("B")
    along = np.maximum(np.abs(dot(at_coupler, coupler)), np.abs(dot(at_crank, coupler)))
    reach = max(design.lengths["beater"], design.lengths["rocker"])
    overhung = design.masses["rocker"] * _beyond(design.lengths) / reach / 2
    tip = (params.beater_mass + overhung) * np.abs(state.beater.acceleration - params.gravity_vector)
    return LinkLoads(
        crank_moment=float(np.max(np.abs(dot(at_crank, 1j * crank)))) * design.lengths["crank"],
        crank_pull=float(np.max(np.abs(dot(at_crank, crank)))),
        thrust=float(np.max(along)),
        tip=float(np.max(tip)),
        pin=max(float(state.pins[pin].max()) for pin in PINS),
        wear=share * max(_wear(design, pin) for pin in PINS),
    )


def _beyond(lengths: Mapping[str, float]) -> float:
    """The rocker beyond its pin to the coupler [m]."""
    return abs(lengths["beater"] - lengths["rocker"])


def _with_pins(  # noqa: PLR0917
    section: LinkSection,
    loads: LinkLoads,
    lengths: Mapping[str, float],
    own: float,
    limits: StrengthParams,
    diameter: float,
) -> BeatUpStrength:
    w, b = section.width, section.thickness
    area, modulus = max(w - diameter, 1e-9) * b, b * max(w**3 - diameter**3, 1e-18) / (6 * w)
    euler = math.pi**2 * limits.modulus * min(w * b**3, b * w**3) / 12 / lengths["coupler"] ** 2
    return BeatUpStrength(
        limits=limits,
        pin_diameter=diameter,
        crank_stress=loads.crank_moment / modulus + loads.crank_pull / area,
        coupler_stress=loads.thrust / area + own / modulus,
        rocker_stress=loads.tip * _beyond(lengths) / modulus,
        coupler_buckling=euler / loads.thrust if loads.thrust > 0 else math.inf,
        pin_shear=2 * loads.pin / (math.pi * diameter**2),
        pin_pressure=loads.pin / (diameter * b),
        pin_wear=loads.wear / b / MPa,
    )


def _wear(design: BeatUp, pin: str) -> float:
    """Mean over a turn of half the force of a pin times the relative angular velocity of its links [N/s]."""
    joint = next(one for one in design.plan.mechanism.joints if one.name == pin)
    first, second = (design.state.motion.omega(body) for body in joint.bodies)
    sliding = np.abs(second - first)
    return float(np.mean((design.state.pins[pin] * sliding)[:-1])) / 2
