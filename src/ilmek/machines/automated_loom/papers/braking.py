"""What motors give back while they brake, and what takes it: the capacitors of an amplifier, then its resistor.

    E = E_b / n + J w² / 2      of a motor at its greatest: E_b of all that its body carries, n motors, J, w rated
    P = falls of the energy over a turn of the drive / period, the rotor's in the same share; without friction
    E <= C (U_b² - U²) / 2, which the next acceleration draws again; else P <= P_r

U of the bars, sqrt(2) of the feed of an amplifier on the mains; U_b where the resistor is switched on. Steppers share
their bars of 48 V, whose braking module burns what all of them give back. A motor beside a clutch with a brake goes on
turning while that stops its body.
"""

import math
from collections.abc import Iterator

from ilmek.elements.motor_loads import MAINS, PHASE, STEPPER_VOLTS, MotorLoad
from ilmek.elements.motors import MOTORS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.power_plan import MotorCircuit
from ilmek.machines.automated_loom.in_space.maker import KNOT
from ilmek.machines.automated_loom.in_space.scene import loom_tree, periods_of
from ilmek.machines.automated_loom.papers.wiring import plan_of
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.moving_energy import MovingEnergy, moving_energies
from ilmek.records import record
from ilmek.report import Check, Column, PaperSection, Table, at_most
from ilmek.sentences import Sentence

_BARS = {PHASE: (325.0, 390.0, 150e-6), MAINS: (565.0, 780.0, 40e-6)}
"""By the feed of an amplifier: voltage of its bars and that from which its resistor burns [V], capacity by its rated
current [F/A]; mean values of series, assumed by this project."""

_RESISTOR, _LEAST = 5.0, 2.5
"""Mean power of an amplifier's own resistor by its rated current [W/A], and the least amplifier that has one [A];
assumed by this project, as that of the braking module."""

CLUTCH = "clutch and brake"
"""Process of what stops a body whose motor turns on."""

MODULE = 60.0
"""Mean power of the braking module on the bars of 48 V [W]."""


@record
class Braking:
    """A motor that brakes: the energy of a stop [J], mean power [W]; what its amplifier stores [J] and burns [W]."""

    circuit: MotorCircuit
    energy: float
    power: float
    stored: float
    burnt: float

    @property
    def share(self) -> float:
        """Of what it gives back in what is taken: by the capacitors, or over a long time by the resistor."""
        shares = (self.energy / self.stored if self.stored else math.inf, self.power / self.burnt)
        return min(shares)


def braking_of(loom: LoomDesign) -> tuple[Braking, ...]:
    """Every motor with an amplifier on the mains, and those on the bars of 48 V, whose module takes all of theirs."""
    tree, periods = loom_tree(loom), periods_of(loom)
    energies, counts = dict(moving_energies(tree, periods)), tree.counts()
    if loom.heads:  # along the row, which no turn of a drive shows: a stop for each knot
        mass = math.fsum(counts[own] / counts[HEAD] * tree.body(own).moments.zeroth for own in tree.carried_by(HEAD))
        energy = mass * loom.weaver.params.carriage_speed**2 / 2
        energies[HEAD] = MovingEnergy(loom.weaver.params.carriage_speed, energy, energy / periods[KNOT])
    clutched = {
        own.part.id
        for body in tree.bodies
        if any(own.part.process == CLUTCH for own in body.occurrences)
        for own in body.occurrences
    }
    moved = {
        body.joint.motor: body.id for body in tree.bodies if body.id in energies and body.joint.motor not in clutched
    }
    braking, rotors = [], {row.name: row.inertia * row.speed**2 / 2 for row in MOTORS}
    for motor in plan_of(loom).motors:
        name = moved.get(motor.part.id)
        if name is not None and motor.part.purchase is not None:
            own, motors = energies[name], motor.number / counts[name]
            rotor = rotors.get(motor.part.purchase.row, 0.0)
            power = own.returned * (1 / motors + rotor / own.energy) if own.energy > 0 else 0.0
            braking.append(Braking(motor, own.energy / motors + rotor, power, *_taken(motor.load)))
    return tuple(braking)


def _taken(load: MotorLoad) -> tuple[float, float]:
    """What an amplifier stores [J] and burns [W]."""
    if load.volts not in _BARS:
        return 0.0, MODULE
    volts, most, by_current = _BARS[load.volts]
    rated = load.amplifier
    return by_current * rated * (most**2 - volts**2) / 2, _RESISTOR * rated if rated >= _LEAST else 1e-9


def braking_checks(loom: LoomDesign) -> Iterator[Check]:
    """Whether the amplifiers, and the module of the steppers, take what the motors give back."""
    own = braking_of(loom)
    alone = [braking for braking in own if braking.circuit.load.volts in _BARS]
    source = "capacitors and resistors of series of amplifiers, without friction; assumed by this project"
    if alone:
        worst = max(alone, key=lambda one: one.share)
        yield at_most(
            "braking energy of a motor, over what its amplifier takes", worst.share, 1.0, "1", source
        ).with_cure("order an outer braking resistor, or set a lower acceleration", worst.circuit.part.id)
    steppers = [braking for braking in own if braking.circuit.load.volts == STEPPER_VOLTS]
    if steppers:
        power = math.fsum(stepper.power * stepper.circuit.number for stepper in steppers)
        yield at_most("mean braking power of the steppers, by their module", power, MODULE, "W", source)


def braking_section(loom: LoomDesign) -> PaperSection:
    """Each motor with what it gives back, and what takes it."""
    rows = tuple(
        (
            own.circuit.sign,
            own.circuit.part.title,
            own.energy,
            own.power,
            own.stored,
            own.burnt if own.burnt > 1 else 0.0,
        )
        for own in braking_of(loom)
    )
    heads = (
        Column(Sentence("electric.sign")),
        Column(Sentence("electric.motor")),
        Column(Sentence("electric.stop-energy"), "J", 3),
        Column(Sentence("electric.mean-braking"), "W", 3),
        Column(Sentence("electric.stored"), "J", 3),
        Column(Sentence("electric.burnt"), "W", 3),
    )
    title = Sentence("electric.braking-title")
    return PaperSection(title, (Sentence("electric.braking-how"),), Table("braking", title, heads, rows))
