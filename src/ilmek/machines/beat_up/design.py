"""The beat-up's design: links, motion, forces, and their greatest values over a turn.

    ground D-A     crank D-C, driven, counter-clockwise     coupler C-B     rocker A-B, the beater at E beyond B

D is the origin, A lies on the x axis; crank angles are counted from D-A, counter-clockwise. The extended dead centre,
at the crank angle beta, is the beat.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.counterweight import Balance, balance
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.motor_run import MotorRun, MotorTask, motor_run
from ilmek.errors import MechanismError
from ilmek.linkage.quality import grashof
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.beat_up.family import FamilyResult, chosen_ratio, family_of, is_chosen
from ilmek.machines.beat_up.hand import HAND
from ilmek.machines.beat_up.linkage import PINS, BeatUpState, evaluate, lengths_of, magnitudes, mechanism, state_of
from ilmek.machines.beat_up.links import inertia_of, link_masses, moving_masses
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.strength import POINTS, BeatUpStrength, Duty, beat_up_strength, link_loads
from ilmek.machines.linkage_strength import LinkageLoads, bore_for, pins_of, smallest_pin
from ilmek.num.piecewise import Extremum, around, suprema
from ilmek.records import Computed, computed, record, result
from ilmek.report import Json
from ilmek.synthesis.crank_rocker.dead_centres import (
    DeadCentres,
    LinkRatios,
    dead_centres,
    grashof_margin,
    links_of_ratio,
    transmission_angle_min,
)
from ilmek.synthesis.crank_rocker.selection import member
from ilmek.units import format_quantity, minute, turn

USE = ("beat_force", "interval", "start", "travel")
"""Parameters of its use: they change neither motion nor forces."""

SAMPLES = 720
"""Samples over a turn: half a degree."""

ROUNDS = 3
"""Most rounds of pins and the links bored for them."""

TOGGLE = 1e-9
"""Least Grashof margin, in ground links, of a crank-rocker that does not stand in a toggle."""


def _peak(unit: str, doc: str, name: str) -> Computed[float]:
    """A result that is one of the `peaks`."""
    return computed(unit, doc, lambda it: it.peaks[name].value)


@record
class BeatUp:
    """A designed beat-up mechanism.

    links     ratios to the ground link        dead_centres  swing, crank rotation and beta of these links
    bodies    the moving bodies: the links, with their pins where they are as made, the beater on the rocker
    state     over one turn, both ends included             at        state at the crank angle given, if any
    pin       diameter of the pins, for which the links are bored [m]     duty  by which it was chosen
    """

    params: BeatUpParams
    links: LinkRatios
    dead_centres: DeadCentres
    bodies: Mapping[str, Inertia]
    plan: Plan
    state: BeatUpState
    at: BeatUpState | None
    pin: float
    duty: Duty
    lengths: Mapping[str, float] = result("mm", "lengths of the links, and of the beater from the rocker's pivot")
    masses: Mapping[str, float] = result("kg", "masses of the links; the rocker reaches to the beater")
    inertias: Mapping[str, float] = result("kg*m^2", "moments of inertia of the links about their centres")

    crank = computed("1", "crank over ground (paper, Eq 1)", lambda it: float(it.links.crank))
    coupler = computed("1", "coupler over ground (paper, Eq 1)", lambda it: float(it.links.coupler))
    rocker = computed("1", "rocker over ground (paper, Eq 3)", lambda it: float(it.links.rocker))
    crank_coupler_ratio = computed("1", "crank over coupler, r/l", lambda it: it.crank / it.coupler)
    swing = computed("deg", "swing of the rocker between its dead centres", lambda it: float(it.dead_centres.swing))

    @computed("deg", "rotation of the crank from the beat to the other dead centre")
    def crank_rotation(self) -> float:
        return float(self.dead_centres.rotation)

    beta = computed("deg", "crank angle of the beat, the extended dead centre", lambda it: float(it.dead_centres.beta))

    period = computed("s", "time of one beat, a turn of the crank", lambda it: turn / it.params.speed)
    beats_per_minute = computed("1", "beats a minute", lambda it: minute / it.period)
    beater_velocity_max = _peak("m/s", "greatest speed of the beater", "beater_velocity")
    beater_acceleration_max = _peak(
        "m/s^2", "greatest acceleration of the beater, along and across its path together", "beater_acceleration"
    )
    beater_acceleration_angle = computed(
        "deg", "crank angle of the greatest acceleration, near the beat", lambda it: it.peaks["beater_acceleration"].at
    )
    beater_force_max = _peak(
        "N", "greatest force between rocker and beater: mass times acceleration, less its weight", "beater_force"
    )
    pin_force_max = computed("N", "greatest force in each pin", lambda it: {pin: it.peaks[pin].value for pin in PINS})
    drive_torque_max = _peak("N*m", "greatest magnitude of the torque on the crank", "drive_torque")
    drive_power_max = computed(
        "W", "greatest power to and from the drive, at constant speed", lambda it: it.drive_torque_max * it.params.speed
    )

    @computed("deg", "least acute transmission angle over a turn")
    def transmission_angle_min(self) -> float:
        return float(transmission_angle_min(self.links))

    @computed("mm", "chord of the beater's path between the dead centres")
    def beater_stroke(self) -> float:
        return 2 * self.lengths["beater"] * math.sin(self.swing / 2)

    @computed("", "the same at crank_angle: torque with its sign, the others as magnitudes", name="at", optional=True)
    def at_crank_angle(self) -> Json:
        if self.at is None:
            return None
        state = self.at
        return {
            "drive_torque": float(state.torque[0]),
            "pin_forces": {pin: float(force[0]) for pin, force in state.pins.items()},
            "beater_acceleration": float(abs(state.beater.acceleration[0])),
            "beater_velocity": float(abs(state.beater.velocity[0])),
            "beater_force": float(abs(state.beater_force[0])),
        }

    @property
    def rocker_angles(self) -> tuple[float, float]:
        """Angle of the rocker A-B at the beat and at the other dead centre [rad]."""
        at_beat = float(np.angle((self.crank + self.coupler) * np.exp(1j * self.beta) - 1))
        return at_beat, at_beat + self.swing

    @property
    def back_angle(self) -> float:
        """Crank angle of the folded dead centre, the beater farthest from the fell [rad]."""
        return float(np.mod(self.dead_centres.beta + self.dead_centres.rotation, turn))

    def family(self) -> FamilyResult:
        """All crank-rockers with its dead centres."""
        return _family(in_motion(self.params), self.duty)

    def motor_run(self) -> MotorRun:
        """Its run by the motor, from rest with the beater farthest from the fell."""
        return _run(in_motion(self.params), self.duty)

    @property
    def peaks(self) -> Mapping[str, Extremum]:
        """Greatest values over the turn."""
        return _peaks(self)

    @property
    def balance(self) -> Balance:
        """Shaking force, and counterweights."""
        return _balance(self)

    @property
    def hole(self) -> float:
        """Diameter of the holes of the links [m]."""
        return bore_for(self.pin, self.params.width)

    @property
    def loads(self) -> LinkageLoads:
        """What links and pins bear over a turn."""
        return _loads(in_motion(self.params), self.duty)

    @property
    def strength(self) -> BeatUpStrength:
        """Strength of links and pins."""
        return _strength(in_motion(self.params), self.duty)

    def state_at(self, angle: FloatArray) -> BeatUpState:
        """Motion and forces at crank angles [rad]."""
        return evaluate(self.params, self.plan, self.bodies, angle)


def in_motion(params: BeatUpParams) -> BeatUpParams:
    """The parameters from which motion, forces, run and family follow: those of its use have their defaults."""
    travel = replace(_USUAL.travel, bar_distance=params.travel.bar_distance)
    return replace(params, **{name: getattr(_USUAL, name) for name in USE} | {"travel": travel})


_USUAL = BeatUpParams()


@lru_cache(maxsize=16)
def design(params: BeatUpParams, duty: Duty = Duty()) -> BeatUp:  # noqa: B008
    """Size, move and load a beat-up mechanism. What its use does not change is computed once.

    Raises ParameterError where the family of crank-rockers has no such member or none within the limits, and
    MechanismError where given lengths do not turn or do not swing.
    """
    return replace(_moved(in_motion(params), duty), params=params)


@lru_cache(maxsize=16)
def _loads(params: BeatUpParams, duty: Duty) -> LinkageLoads:
    made = _moved(params, duty)
    return link_loads(params, made.state, made.bodies, duty.every)


@lru_cache(maxsize=16)
def _strength(params: BeatUpParams, duty: Duty) -> BeatUpStrength:
    made = _moved(params, duty)
    return beat_up_strength(params, _loads(params, duty), made.lengths, duty, made.pin)


@lru_cache(maxsize=4)
def _family(params: BeatUpParams, duty: Duty) -> FamilyResult:
    made = _moved(params, duty)
    return family_of(params, made.links, made.dead_centres, made.hole)


@lru_cache(maxsize=16)
def _peaks(linkage: BeatUp) -> Mapping[str, Extremum]:
    return suprema(lambda at, _: magnitudes(linkage.state_at(at)), around(), samples=SAMPLES)


@lru_cache(maxsize=4)
def _balance(linkage: BeatUp) -> Balance:
    share, radius = linkage.params.balance_share, linkage.params.counterweight_radius or linkage.lengths["crank"]
    return balance(linkage.state.motion, linkage.lengths, linkage.bodies, share=share, radius=radius)


@lru_cache(maxsize=4)
def _run(params: BeatUpParams, duty: Duty) -> MotorRun:
    made = _moved(params, duty)
    task = MotorTask(
        params.speed, params.slip, params.fluctuation, made.back_angle, params.motor_torque, params.flywheel
    )
    return motor_run(made.plan, made.bodies, params.gravity_vector, task)


@record
class _Loaded:
    """A crank-rocker with pins of a diameter [m]: its links, bodies, and state over a turn."""

    pin: float
    links: LinkRatios
    lengths: Mapping[str, float]
    plan: Plan
    bodies: Mapping[str, Inertia]
    state: BeatUpState


def _loaded(params: BeatUpParams, pin: float) -> _Loaded:
    hole = bore_for(pin, params.width)
    links = _links(params, hole)
    lengths = lengths_of(params, links)
    planned = plan(mechanism(lengths))
    angle = np.arange(SAMPLES + 1) * (turn / SAMPLES)
    motion = solve(planned, angle, params.speed).require()
    _require_swing(links)
    bodies = {name: inertia_of(moments) for name, moments in moving_masses(params, lengths, hole).items()}
    state = state_of(params, motion, bodies, angle)
    return _Loaded(pin, links, lengths, planned, bodies, state)


def _with_pins(params: BeatUpParams, duty: Duty) -> _Loaded:
    """The crank-rocker with pins that bear it: larger pins have larger holes, links with these are lighter.

    From the smallest pins of stock on; where smaller pins would bear the links bored for larger ones, the larger stay.
    """
    size = params.width, params.thickness
    loaded = _loaded(params, smallest_pin(params.strength, params.width))
    for _ in range(ROUNDS - 1):
        loads = link_loads(params, loaded.state, loaded.bodies, duty.every, {})
        pins = pins_of(loads, params.strength, dict.fromkeys(POINTS, size))
        needed = max(pin.diameter for pin in pins.values())
        if needed <= loaded.pin:
            break
        loaded = replace(loaded, pin=needed) if params.link_mass == "bars" else _loaded(params, needed)
    return loaded


@lru_cache(maxsize=16)
def _moved(params: BeatUpParams, duty: Duty) -> BeatUp:
    loaded = _with_pins(params, duty)
    lengths, bodies, whole = loaded.lengths, loaded.bodies, loaded.state
    hole = bore_for(loaded.pin, params.width)
    links = {name: inertia_of(moments) for name, moments in link_masses(params, lengths, hole).items()}
    return BeatUp(
        params=params,
        links=loaded.links,
        dead_centres=dead_centres(loaded.links),
        lengths=lengths,
        masses={name: inertia.mass for name, inertia in links.items()},
        inertias={name: inertia.moment for name, inertia in links.items()},
        bodies=bodies,
        plan=loaded.plan,
        state=whole,
        at=None
        if params.crank_angle is None
        else evaluate(params, loaded.plan, bodies, np.array([params.crank_angle])),
        pin=loaded.pin,
        duty=duty,
    )


@lru_cache(maxsize=8)
def _rise_of_a_metre(hand: str, swing: float | None) -> float:
    """Height that the beater of a linkage with a ground of 1 m rises above the fell [m]; hand: its positions."""
    params = BeatUpParams(ground=1.0, hand=hand, swing=swing)
    return lengths_of(params, _links(params, 0.0))["beater"] * math.sin(params.rocker_swing)


def ground_for(rise: float, hand: str = HAND, swing: float | None = None) -> float:
    """Distance of the pivots [m] of a linkage whose beater rises to a height above the fell [m].

    hand  its positions; default: the paper's      swing  of its rocker [rad]; default: about these positions
    """
    return rise / _rise_of_a_metre(hand, swing)


def _links(params: BeatUpParams, hole: float) -> LinkRatios:
    """Links of the member, which limits may choose by masses; hole: diameter of the holes in them [m]."""
    if is_chosen(params):
        return links_of_ratio(params.rocker_swing, params.crank_rotation, chosen_ratio(params, hole))
    if params.crank is None or params.coupler is None or params.rocker is None:
        return member(params.rocker_swing, params.crank_rotation, params.beta).links
    return LinkRatios(params.crank / params.ground, params.coupler / params.ground, params.rocker / params.ground)


def _require_swing(links: LinkRatios) -> None:
    """Raise MechanismError unless links that close turn the crank fully and swing the rocker, away from any toggle."""
    shown = ", ".join(f"{name} {format_quantity(float(ratio), '1')}" for name, ratio in links._asdict().items())
    margin = float(grashof_margin(links))
    if margin < TOGGLE:
        given = f"beat-up stands in a toggle: {shown} (ground 1) are {margin:.2g} from a change point"
        allowed = "shortest + longest link must be less than the sum of the other two"
        raise MechanismError(given, allowed=allowed, do="shorten the crank")
    if grashof(1.0, *(float(link) for link in links)).kind != "crank-rocker":
        given = f"the rocker of beat-up turns right round instead of swinging: {shown} (ground 1)"
        allowed = "the crank must be the shortest link"
        raise MechanismError(given, allowed=allowed, do="lengthen ground, or shorten the crank")
