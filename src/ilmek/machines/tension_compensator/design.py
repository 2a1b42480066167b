"""Design of the tension compensator: number of bars, rollers, synthesised levers with springs, members."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.tubes import Tube
from ilmek.machines.tension_compensator.members import Loads, Members, bar_checks, bar_tubes, members_for, pick
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.machines.tension_compensator.parts import CompensatorParts, parts_of, sprung_bar
from ilmek.machines.tension_compensator.supports import BarSupports
from ilmek.machines.tension_compensator.synthesis import BarTask, SprungLever, synthesise
from ilmek.records import computed, record, result
from ilmek.report import Check, Choice, at_least, at_most
from ilmek.units import mm, turn
from ilmek.weaving.tension import compensated_tension

STEPS = 33
"""Rotations between rest and open shed at which the tension is computed."""

CLEARANCE = 3 * mm
"""Least distance of a lever from a rod's surface, its warps between them; assumed by this project."""

_ROUNDS, _FARTHER = 12, 5 * mm
"""Spans of the rods that are tried beyond the usual one, and their step [m]."""

STEP = 1e-4
"""Step of the finite differences of the arms [rad]."""


@record
class TensionCompensator:
    """The compensator, designed.

    bars      sprung bars                                 one   lever of a bar with its springs
    members   tubes, levers, pins, beams                  loads in the open shed
    parts     what is made and bought of them
    """

    params: TensionCompensatorParams
    one: SprungLever
    members: Members
    parts: CompensatorParts
    loads: Loads
    choice: Choice
    bars: int = result("1", "sprung bars: one for all warps, or one for each parity", name="bars")
    lengthening: float = result("mm", "lengthening of a lifted warp in the open shed", name="shed_lengthening")
    tension_open: float = result("N", "greatest tension of a lifted warp, while its shed opens")
    tension_low: float = result("N", "tension of the other warps then")
    frequency: float = result("Hz", "least natural frequency of a bar on springs and warps", name="natural_frequency")
    moving_mass: float = result("kg", "moving mass of a bar, its levers and springs, referred to the bar")

    tension_fixed = computed(
        "N",
        "tension of a lifted warp without the compensator",
        lambda it: it.fixed_tension,
        name="tension_not_compensated",
    )
    relief = computed(
        "1",
        "share of the lengthening that the compensator gives to a lifted warp",
        lambda it: 1 - (it.tension_open - it.params.cloth.warp_tension) / (it.one.task.rate * it.lengthening),
        name="compensation",
    )
    levers = computed("1", "levers of a bar", lambda it: it.params.levers)
    springs = computed("1", "springs on a lever", lambda it: it.one.springs, name="springs_per_lever")
    spring_rate = computed("N/mm", "rate of a spring", lambda it: it.one.rate)
    spring_preload = computed("N", "force of a spring at rest", lambda it: it.one.preload)
    spring_force = computed("N", "force of a spring in the open shed", lambda it: it.one.force)
    spring_wire = computed("mm", "wire of a spring", lambda it: it.wound("wire_diameter"), absent="none is enough")
    spring_diameter = computed(
        "mm", "mean diameter of a spring", lambda it: it.wound("diameter"), absent="none is enough"
    )
    spring_coils = computed("1", "active coils of a spring", lambda it: it.wound("coils"), absent="none is enough")
    spring_length = computed(
        "mm", "its length without load", lambda it: it.wound("free_length"), absent="none is enough"
    )
    spring_lean = computed("deg", "lean of the springs at rest", lambda it: float(it.one.lever.lean))
    lever_angle = computed("deg", "rotation of a lever from rest to the open shed", lambda it: it.one.angle)
    bar_travel = computed(
        "mm",
        "travel of a bar from rest to the open shed",
        lambda it: 2 * it.params.bar_arm * math.sin(it.one.angle / 2),
    )
    strand_angle_least = computed(
        "deg",
        "least deflection of a strand, in the open shed",
        lambda it: float(min(it.one.lever.path.strands(it.one.lever.bar(it.one.angle)))),
    )
    bar_tube = computed("", "tube of bars and rods", lambda it: it.members.tube.name)
    lever_height = computed("mm", "height of a lever", lambda it: it.members.lever)
    pivot_pin = computed("mm", "pin of a lever's pivot", lambda it: it.members.pin)
    beam = computed("", "square hollow section of the levers' beams", lambda it: it.members.beam.name)
    height = computed(
        "mm", "from the top of the upper rods to the foot of the lower ones", lambda it: 2 * it.span, name="height"
    )
    half_depth = computed(
        "mm",
        "from the middle plane to the sheet of a parity: the bars keep a radius between them, the cross-pieces pass "
        "over what carries a back rest of their radius, and the beams of two parities have room beside each other",
        lambda it: max(
            -it.one.lever.rest.real + 1.5 * it.radius,
            -it.parts.supports.low + (it.members.beam.side + CLEARANCE / 2 if it.bars > 1 else -2 * it.radius),
        ),
    )

    @property
    def beams(self) -> tuple[tuple[complex, complex], ...]:
        """Axes of the beams that the frame carries, x from the middle plane, y along the warps [m], and the directions
        of their sides; those of the odd parity are turned half round about the warps.
        """
        own = [(axis + self.half_depth, side) for axis, side in self.parts.supports.beams]
        odd = [(-axis.conjugate(), -side.conjugate()) for axis, side in own]
        return tuple((own + odd) if self.bars > 1 else own)

    @property
    def swing(self) -> float:
        """Length of the warps' run that it takes [m]: from rod to rod, and its cross-pieces and saddles behind a back
        rest of the bars' radius.
        """
        at, path, radius = self.parts.supports, self.one.lever.path, self.radius
        roller, corner, _ = at.saddle(complex(-path.radius), -1)
        saddle = roller + np.linspace(0.0, 1.0, STEPS) * (corner - roller)
        apart = radius + max(at.strip, at.members.roller.outer / 2) + CLEARANCE
        over = self.half_depth + saddle.real + radius  # the axis of the back rest
        behind = np.abs(saddle.imag) + np.sqrt(np.maximum(apart**2 - over**2, 0.0)) - radius
        return 2 * max(
            self.span, path.half + max(at.strip + CLEARANCE, float(behind.max(where=over < apart, initial=0.0)))
        )

    @property
    def rear(self) -> float:
        """From its middle to the rear of its last beam, that of the rods, along the warps [m]."""
        return self.parts.supports.beams[1][0].imag + self.members.beam.side / 2

    @property
    def roller_radius(self) -> float:
        """Radius of its bars and rods [m]."""
        return self.radius

    @property
    def fixed_tension(self) -> float:
        """Tension of a lifted warp on fixed bars [N]."""
        return self.params.cloth.warp_tension + self.one.task.rate * self.lengthening

    @property
    def radius(self) -> float:
        """Radius of bars and rods [m]."""
        return self.one.lever.path.radius

    @property
    def span(self) -> float:
        """From the bar to the outer side of a rod [m]."""
        return self.one.lever.path.half + self.radius

    def wound(self, attribute: str) -> float | None:
        """A property of the spring; None where there is none."""
        return None if self.one.spring is None else float(getattr(self.one.spring, attribute))


def design(params: TensionCompensatorParams) -> TensionCompensator:
    """The compensator for the parameters; with the largest of the tables where nothing is enough."""
    rate, longer = params.rate, params.longer
    bars, choice = _bars(params)
    task = bar_task(params, bars)
    tube = _tube(params, task)
    one, loads, members = _beside_the_rods(params, task, tube)
    mean = task.tension + rate * task.lengthening
    if one.angle > 0:
        mean = float(equilibrium_tension(one, np.linspace(0.0, one.angle, STEPS)).max())
    apart = rate * (longer - task.lengthening)
    parts = parts_of(params, one, members)
    mass = moving_mass(parts)
    stiff = min(stiffness(one, angle) for angle in (0.0, one.angle))
    return TensionCompensator(
        params=params,
        one=one,
        members=members,
        parts=parts,
        loads=loads,
        choice=choice,
        bars=bars,
        lengthening=longer,
        tension_open=mean + apart,
        tension_low=mean - apart if bars == 1 else params.cloth.warp_tension,
        frequency=math.sqrt(max(stiff, 0.0) / (mass / params.levers * params.bar_arm**2)) / turn,
        moving_mass=mass,
    )


def _beside_the_rods(
    params: TensionCompensatorParams, task: BarTask, tube: tuple[Tube, Choice]
) -> tuple[SprungLever, Loads, Members]:
    """The lever, its loads and its members; the rods so far apart that lever and rollers of the bar pass them."""
    span = 0.0
    for _ in range(_ROUNDS):
        one = synthesise(params, task, tube[0].outer_radius, span)
        loads = _loads(params, one)
        members = members_for(params, tube, loads)
        least = min(one.clearance(members.lever), _roller_gap(BarSupports(params, one, members)))
        if params.guide_span or least >= CLEARANCE:
            break
        span = one.lever.path.half + _FARTHER
    return one, loads, members


def _roller_gap(at: BarSupports) -> float:
    """Least gap between the rollers of a bar and the rods, at rest and in the open shed [m]."""
    lever, path = at.sprung.lever, at.sprung.lever.path
    turned = np.exp(-1j * np.array([0.0, at.sprung.angle]))
    rollers = lever.pivot + np.outer(turned, at.saddle(at.bar, -at.bar)[::2])
    rods = complex(-path.radius, path.half), complex(-path.radius, -path.half)
    return float(min(np.abs(rollers - rod).min() for rod in rods)) - path.radius - at.members.roller.outer / 2


def _bars(params: TensionCompensatorParams) -> tuple[int, Choice]:
    """The number of bars: as given, or the least that keeps the tensions within their limits."""
    offered = (params.bars,) if params.bars else (1, 2)
    return pick("bars", offered, str, lambda number: swing_checks(params, *swing(params, number)))


def bar_task(params: TensionCompensatorParams, bars: int) -> BarTask:
    """Task of one of 1 or 2 bars: the mean lengthening of its warps in the open shed."""
    return BarTask(
        params.cloth.warps / bars / params.levers, params.rate, params.cloth.warp_tension, params.longer * bars / 2
    )


def swing(params: TensionCompensatorParams, bars: int) -> tuple[float, float]:
    """Greatest and least tension of a warp in the open shed [N] with 1 or 2 bars of the rate that is wished."""
    gain = params.rate * params.longer
    return compensated_tension(params.cloth.warp_tension, gain, bars, params.rate_share)


def swing_checks(params: TensionCompensatorParams, most: float, least: float) -> tuple[Check, ...]:
    """Greatest and least tension in the open shed [N] against those that are allowed."""
    rest, source = params.cloth.warp_tension, "assumed by this project: parameter "
    high, low = params.tension_most * rest, params.tension_least * rest
    cure = "set bars=2, a lower rate_share, or a longer warp"
    return (
        at_most("tension in the open shed", most, high, "N", f"{source}tension_most").with_cure(cure),
        at_least("least tension of a warp", least, low, "N", f"{source}tension_least").with_cure(cure),
    )


def _tube(params: TensionCompensatorParams, task: BarTask) -> tuple[Tube, Choice]:
    """Tube of bars and rods: at rest and in the open shed the strands deflect by nearly the same angle."""
    tension = max(task.tension, task.open_tension(params.rate_share))
    line = task.warps * params.levers / params.cloth.width * tension * 2 * math.sin(params.strand_angle)
    return pick("bar_tube", bar_tubes(params), lambda one: one.name, lambda one: bar_checks(params, one, line))


def _loads(params: TensionCompensatorParams, one: SprungLever) -> Loads:
    """Greatest loads of rest and open shed."""
    lever, task, line, torque, pivot = one.lever, one.task, 0.0, 0.0, 0.0
    for angle, spring in ((0.0, one.preload), (one.angle, one.force)):
        tension = task.tension + task.rate * (task.lengthening * (angle > 0) - float(lever.slack(angle)))
        pull = complex(lever.path.pull(lever.bar(angle))) * task.warps * tension
        torque = max(torque, task.warps * tension * float(lever.warp_arm(angle)))
        turned = complex(math.cos(angle), -math.sin(angle)) * lever.reach + lever.pivot
        along = turned - complex(lever.anchor)
        pivot = max(pivot, abs(pull + one.springs * spring * along / abs(along)))
        line = max(line, abs(pull) * params.levers / params.cloth.width)
    overhung = one.force * one.pitch * math.ceil(one.springs / 2) ** 2 / 2
    return Loads(line, torque, pivot, 2 * lever.path.half, overhung)


def equilibrium_tension(one: SprungLever, angle: FloatArray) -> FloatArray:
    """Mean tension of a bar's warps [N] that holds its springs in equilibrium at rotations of the lever [rad]."""
    force = one.rate * (one.free_length - one.lever.spring_length(angle))
    return np.asarray(
        one.springs * force * one.lever.spring_moment_arm(angle) / (one.task.warps * one.lever.warp_arm(angle))
    )


def stiffness(one: SprungLever, angle: float) -> float:
    """Stiffness of a lever about its pivot [N m/rad]: minus the derivative of the torque of warps and springs."""
    return (torque(one, angle - STEP, angle) - torque(one, angle + STEP, angle)) / (2 * STEP)


def torque(one: SprungLever, angle: float, about: float) -> float:
    """Torque on a lever [N m] at an angle, with the shed held as it is in equilibrium `about` an angle [rad]."""
    lever, task = one.lever, one.task
    opened = task.lengthening if about > 0 else 0.0
    tension = task.tension + task.rate * (opened - float(lever.slack(angle)))
    force = one.rate * (one.free_length - float(lever.spring_length(angle)))
    driven = task.warps * tension * float(lever.warp_arm(angle))
    return driven - one.springs * force * float(lever.spring_moment_arm(angle))


def moving_mass(parts: CompensatorParts) -> float:
    """Moment of inertia of a bar, levers, springs' ends and a third of these over the square of its arm [kg]."""
    supports = parts.supports
    params, sprung = supports.params, supports.sprung
    body = sprung_bar(parts, "sprung", None).moments
    strut = parts.struts
    ends = sum(part.mass for part in (strut.eye, strut.sleeve) if part is not None)
    wound = sprung.spring.mass if sprung.spring else 0.0
    springs = params.levers * sprung.springs * (wound / 3 + ends)
    return float((body.second[0, 0] + body.second[1, 1] + springs * params.spring_arm**2) / params.bar_arm**2)
