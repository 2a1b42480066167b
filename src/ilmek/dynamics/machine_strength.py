"""Strength of the links and pins of an own machine over an inverse run, as values and checks with cures.

Links are flat bars (`link_strength`), pins are bolts in a bush or a rolling bearing (`pin_strength`). A hole of the
greatest pin of a link weakens it. Values are over the samples at which the mechanism closes.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.dynamics.inverse_run import InverseRun, all_loads
from ilmek.dynamics.link_forces import internal_forces
from ilmek.dynamics.link_strength import RESONANCE, LinkStrength, link_strength
from ilmek.dynamics.own_machine import FlatMember, OwnMachine, PinMember
from ilmek.dynamics.pin_strength import PinDuty, PinStrength, bearing_life, pin_duty, pin_strength
from ilmek.elements.bearings import find_bearing
from ilmek.elements.flat_section import FlatSection
from ilmek.elements.materials import find_material
from ilmek.linkage.model import GROUND, Slide
from ilmek.records import computed, record
from ilmek.report import Check, at_least, at_most
from ilmek.units import format_quantity, turn

WIDEST = 0.75
"""Greatest hole of a pin over the width of its link: the range of the notch factor."""

BUCKLING = 3.0
"""Least safety against buckling of a link [usual practice]."""


@record
class MachineStrength:
    """Strength of the links and pins.

    links   body -> its strength      pins  joint -> its stresses      lives  joint -> life of its bearing [s]
    speed   greatest speed of the driving input [rad/s]; 0: it slides or rests
    """

    machine: OwnMachine
    links: Mapping[str, LinkStrength]
    pins: Mapping[str, PinStrength]
    lives: Mapping[str, float]
    speed: float
    balance: float

    link_stress_max = computed(
        "MPa",
        "greatest stress of each link",
        lambda it: {name: one.stress for name, one in it.links.items()},
        shown=False,
    )
    pin_pressure_max = computed(
        "MPa",
        "greatest pressure of each pin",
        lambda it: {name: one.pressure for name, one in it.pins.items()},
        shown=False,
    )

    @property
    def checks(self) -> tuple[Check, ...]:
        """The checks of all links, then of all pins."""
        links = (check for name, one in self.links.items() for check in self._of_link(name, one))
        pins = (check for name, one in self.pins.items() for check in self._of_pin(name, one))
        return (*links, *pins)

    @property
    def transient_checks(self) -> tuple[Check, ...]:
        """The checks of greatest stresses and pressures alone: those that a single start may break."""
        lasting = ("fatigue", "frequency", "speed", "life", "hole of its pins")
        return tuple(check for check in self.checks if not check.name.endswith(lasting))

    def _of_link(self, name: str, found: LinkStrength) -> Iterator[Check]:
        member = self.machine.members[name]
        material = find_material(member.material)
        given = member.stress is not None
        limit = member.stress if member.stress is not None else material.strength / member.safety
        source = "given" if given else f"yield strength of {material.name} over {member.safety:g}"
        hole = _hole(self.machine, name)
        if hole >= WIDEST * member.width:
            cure = f"make {name} wider than {format_quantity(hole / WIDEST, 'mm')}, or its pins thinner"
            widest = WIDEST * member.width
            yield at_most(f"{name}: hole of its pins", hole, widest, "mm", f"{WIDEST:g} of its width").with_cure(cure)
        width = format_quantity(member.width * math.sqrt(max(found.stress / limit, 1.0)), "mm", 3)
        cure = f"make {name} about {width} wide, or thicker"
        yield at_most(f"{name}: stress", found.stress, limit, "MPa", source).with_cure(cure)
        if not given and material.fatigue is not None:
            source = "Goodman, with the holes' notch; infinite life"
            yield at_least(f"{name}: safety against fatigue", found.fatigue, member.safety, "1", source).with_cure(cure)
        if math.isfinite(found.buckling):
            cure = f"make {name} thicker or shorter"
            yield at_least(f"{name}: safety against buckling", found.buckling, BUCKLING, "1", "Euler").with_cure(cure)
        if self.speed and math.isfinite(found.frequency):
            source = f"{RESONANCE:g} times the driving frequency"
            cure = f"make {name} wider or shorter, or run slower"
            lowest, driving = found.frequency / turn, RESONANCE * self.speed / turn
            yield at_least(f"{name}: natural frequency", lowest, driving, "Hz", source).with_cure(cure)

    def _of_pin(self, name: str, found: PinStrength) -> Iterator[Check]:
        pin = self.machine.pins[name]
        thick = format_quantity(pin.diameter * math.sqrt(max(found.shear / pin.shear, 1.0)), "mm", 3)
        cure = f"a pin of {thick}" + ("" if pin.fork else ", or a fork")
        yield at_most(f"pin {name}: shear stress", found.shear, pin.shear, "MPa", "allowed of the pin").with_cure(cure)
        if pin.fork:
            thick = format_quantity(pin.diameter * max(found.bending / pin.bending, 1.0) ** (1 / 3), "mm", 3)
            cure = f"a pin of {thick}, or a shorter fork"
            yield at_most(f"pin {name}: bending", found.bending, pin.bending, "MPa", "allowed of the pin").with_cure(
                cure
            )
        if pin.bearing is not None:
            cure = "a larger bearing, or a lower speed"
            source = f"required life of {pin.bearing}"
            if pin.life > 0:
                yield at_least(f"pin {name}: bearing life", self.lives[name], pin.life, "h", source).with_cure(cure)
            return
        long = format_quantity(pin.length * max(found.pressure / pin.pressure, 1.0), "mm", 3)
        cure = f"a bush of {long}, or a thicker pin"
        yield at_most(f"pin {name}: pressure", found.pressure, pin.pressure, "MPa", "allowed of the pin").with_cure(
            cure
        )
        cure = "a longer bush, a rolling bearing, or a lower speed"
        yield at_most(f"pin {name}: pressure x speed", found.wear, pin.wear, "MPa*m/s", "allowed of the pin").with_cure(
            cure
        )


def machine_strength(machine: OwnMachine, run: InverseRun) -> MachineStrength | None:
    """Strength of a machine's links and pins over a run, as far as their forces are determined; None without any.

    Raises MechanismError for a member or pin of an unknown body or joint; ParameterError for an unknown material or
    bearing.
    """
    if not machine.members and not machine.pins:
        return None
    forces, loads = run.forces, all_loads(machine)
    links, balance = {}, 0.0
    unknown = forces.undetermined
    known_pins = {joint: pin for joint, pin in machine.pins.items() if joint not in unknown.joints}
    for body, member in machine.members.items():
        if body != GROUND and body not in unknown.bodies:
            section, material = _section(machine, body, member), find_material(member.material)
            line_mass = section.line_mass(material.density)
            inner = internal_forces(forces, body, machine.inertias, loads, line_mass=line_mass)
            links[body] = link_strength(inner, section, material)
            balance = max(balance, inner.equilibrium_error)
    times = None if run.time is None else np.abs(run.time - run.time[0])
    duties = {joint: pin_duty(forces, joint, times) for joint in known_pins}
    pins = {joint: _pin(known_pins[joint], duty) for joint, duty in duties.items()}
    lives = {
        joint: bearing_life(duties[joint], find_bearing(str(pin.bearing)))
        for joint, pin in known_pins.items()
        if pin.bearing is not None
    }
    return MachineStrength(machine, links, pins, lives, _speed(run), balance)


def _hole(machine: OwnMachine, body: str) -> float:
    """Diameter of the greatest pin of a link [m]; 0 without."""
    joints = (joint for joint in machine.mechanism.joints if body in joint.bodies and not isinstance(joint, Slide))
    return max((machine.pins[joint.name].diameter for joint in joints if joint.name in machine.pins), default=0.0)


def _section(machine: OwnMachine, body: str, member: FlatMember) -> FlatSection:
    """The section of a link, with the hole of its greatest pin; one too large leaves a hundredth of the width."""
    return FlatSection(member.width, member.thickness, min(_hole(machine, body), 0.99 * member.width))


def _pin(pin: PinMember, duty: PinDuty) -> PinStrength:
    return pin_strength(duty, pin.diameter, pin.length, fork=pin.fork)


def _speed(run: InverseRun) -> float:
    if not run.turning or run.driving is None:
        return 0.0
    return float(np.max(np.abs(run.forces.motion.drives[run.driving].speed)))
