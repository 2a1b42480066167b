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

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.attached import AttachedPoint, attached
from ilmek.dynamics.counterweight import Balance, balance
from ilmek.dynamics.inertia import Inertia, bar, bar_mass, combined, point_mass
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.motor_run import MotorRun, MotorTask, motor_run
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.quality import grashof
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.beat_up.family import FamilyResult, chosen_ratio, family_of, is_chosen
from ilmek.machines.beat_up.params import BEATER_RATIO, BeatUpParams
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

PINS = ("A", "B", "C", "D")

USE = ("beat_force", "interval", "strength", "start", "travel")
"""Parameters of its use: they change neither motion nor forces."""

SAMPLES = 720
"""Samples over a turn: half a degree."""

TOGGLE = 1e-9
"""Least Grashof margin, in ground links, of a crank-rocker that does not stand in a toggle."""


@record
class BeatUpState:
    """The mechanism at given crank angles, one value a sample.

    pins          pin -> magnitude of the force in it [N]
    torque        drive torque on the crank, counter-clockwise [N m]
    beater        position, velocity, acceleration of the beater E [m, s], complex
    beater_force  force of the rocker on the beater [N], complex: m_E (a_E - g)
    """

    angle: FloatArray
    motion: Motion
    forces: Forces
    pins: Mapping[str, FloatArray]
    torque: FloatArray
    beater: AttachedPoint
    beater_force: ComplexArray


def _peak(unit: str, doc: str, name: str) -> Computed[float]:
    """A result that is one of the `peaks`."""
    return computed(unit, doc, lambda it: it.peaks[name].value)


@record
class BeatUp:
    """A designed beat-up mechanism.

    links     ratios to the ground link        dead_centres  swing, crank rotation and beta of these links
    bodies    the moving bodies, the beater on the rocker
    state     over one turn, both ends included             peaks     greatest values over the turn
    balance   shaking force and counterweights              at        state at the crank angle given, if any
    """

    params: BeatUpParams
    links: LinkRatios
    dead_centres: DeadCentres
    bodies: Mapping[str, Inertia]
    plan: Plan
    state: BeatUpState
    peaks: Mapping[str, Extremum]
    balance: Balance
    at: BeatUpState | None
    lengths: Mapping[str, float] = result("mm", "lengths of the links, and of the beater from the rocker's pivot")
    masses: Mapping[str, float] = result("kg", "masses of the bars; the rocker's reaches to the beater")
    inertias: Mapping[str, float] = result("kg*m^2", "moments of inertia of the bars about their centres")

    crank = computed("1", "crank over ground (paper, Eq 1)", lambda it: float(it.links.crank))
    coupler = computed("1", "coupler over ground (paper, Eq 1)", lambda it: float(it.links.coupler))
    rocker = computed("1", "rocker over ground (paper, Eq 3)", lambda it: float(it.links.rocker))
    crank_coupler_ratio = computed("1", "crank over coupler, r/l", lambda it: it.crank / it.coupler)
    swing = computed("deg", "swing of the rocker between its dead centres", lambda it: float(it.dead_centres.swing))
    crank_rotation = computed(
        "deg",
        "rotation of the crank from the beat to the other dead centre",
        lambda it: float(it.dead_centres.rotation),
    )
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
        return _family(in_motion(self.params))

    def motor_run(self) -> MotorRun:
        """Its run by the motor, from rest with the beater farthest from the fell."""
        return _run(in_motion(self.params))

    def state_at(self, angle: FloatArray) -> BeatUpState:
        """Motion and forces at crank angles [rad]."""
        return evaluate(self.params, self.plan, self.bodies, angle)


def in_motion(params: BeatUpParams) -> BeatUpParams:
    """The parameters from which motion, forces, run and family follow: those of its use have their defaults."""
    usual = BeatUpParams()
    return replace(params, **{name: getattr(usual, name) for name in USE})


@lru_cache(maxsize=16)
def design(params: BeatUpParams) -> BeatUp:
    """Size, move and load a beat-up mechanism. What its use does not change is computed once.

    Raises ParameterError where the family of crank-rockers has no such member or none within the limits, and
    MechanismError where given lengths do not turn or do not swing.
    """
    return replace(_moved(in_motion(params)), params=params)


@lru_cache(maxsize=4)
def _family(params: BeatUpParams) -> FamilyResult:
    made = _moved(params)
    return family_of(params, made.links, made.dead_centres)


@lru_cache(maxsize=4)
def _run(params: BeatUpParams) -> MotorRun:
    made = _moved(params)
    task = MotorTask(
        params.speed, params.slip, params.fluctuation, made.back_angle, params.motor_torque, params.flywheel
    )
    return motor_run(made.plan, made.bodies, params.gravity_vector, lambda at: made.state_at(at).torque, task)


@lru_cache(maxsize=16)
def _moved(params: BeatUpParams) -> BeatUp:
    links = _links(params)
    lengths = _lengths(params, links)
    planned = plan(mechanism(lengths))
    bars = _bars(params, lengths)
    inertias = {**bars, "rocker": combined(bars["rocker"], point_mass(params.beater_mass, lengths["beater"]))}
    angle = np.arange(SAMPLES + 1) * (turn / SAMPLES)
    _require_swing(links, planned, angle)

    def state(at: FloatArray) -> BeatUpState:
        return evaluate(params, planned, inertias, at)

    whole = state(angle)
    return BeatUp(
        params=params,
        links=links,
        dead_centres=dead_centres(links),
        lengths=lengths,
        masses={name: inertia.mass for name, inertia in bars.items()},
        inertias={name: inertia.moment for name, inertia in bars.items()},
        bodies=inertias,
        plan=planned,
        state=whole,
        peaks=suprema(lambda at, _: magnitudes(state(at)), around(), samples=SAMPLES),
        balance=balance(
            whole.motion,
            lengths,
            inertias,
            share=params.balance_share,
            radius=params.counterweight_radius or lengths["crank"],
        ),
        at=None if params.crank_angle is None else state(np.array([params.crank_angle])),
    )


@lru_cache(maxsize=8)
def _stroke_of_a_metre() -> float:
    """Stroke of the beater of the paper's linkage with a ground of 1 m, along its path [m]."""
    params = BeatUpParams(ground=1.0)
    return _lengths(params, _links(params))["beater"] * params.rocker_swing


def ground_for(stroke: float) -> float:
    """Distance of the pivots [m] of the paper's linkage with a stroke of the beater [m], along its path."""
    return stroke / _stroke_of_a_metre()


def mechanism(lengths: Mapping[str, float]) -> Mechanism:
    """The crank-rocker with its beater, B above the ground line."""
    return Mechanism(
        name="beat-up",
        bodies=(
            Body(GROUND, {"D": 0, "A": lengths["ground"]}),
            Body("crank", {"D": 0, "C": lengths["crank"]}),
            Body("coupler", {"C": 0, "B": lengths["coupler"]}),
            Body("rocker", {"A": 0, "B": lengths["rocker"], "E": lengths["beater"]}),
        ),
        joints=(
            Pin("D", GROUND, "crank"),
            Pin("C", "crank", "coupler"),
            Pin("B", "coupler", "rocker"),
            Pin("A", GROUND, "rocker"),
        ),
        inputs=(Rotation("crank", "D"),),
        branches={"B": +1},
    )


def evaluate(params: BeatUpParams, planned: Plan, inertias: Mapping[str, Inertia], angle: FloatArray) -> BeatUpState:
    """Motion and forces at the given crank angles [rad]."""
    motion = solve(planned, angle, params.speed).require()
    gravity = params.gravity_vector
    forces = inverse(motion, inertias, (Gravity(gravity),))
    beater = attached(motion, "rocker", planned.mechanism.point("rocker", "E"))
    return BeatUpState(
        angle=angle,
        motion=motion,
        forces=forces,
        pins={pin: np.abs(forces.pin(pin)) for pin in PINS},
        torque=forces.effort("crank"),
        beater=beater,
        beater_force=params.beater_mass * (beater.acceleration - gravity),
    )


def magnitudes(state: BeatUpState) -> dict[str, FloatArray]:
    """The curves whose greatest values are reported, by name; pins by their letters."""
    return {
        "beater_velocity": np.abs(state.beater.velocity),
        "beater_acceleration": np.abs(state.beater.acceleration),
        "beater_force": np.abs(state.beater_force),
        "drive_torque": np.abs(state.torque),
        **state.pins,
    }


def _links(params: BeatUpParams) -> LinkRatios:
    if is_chosen(params):
        return links_of_ratio(params.rocker_swing, params.crank_rotation, chosen_ratio(params))
    if params.crank is None or params.coupler is None or params.rocker is None:
        return member(params.rocker_swing, params.crank_rotation, params.beta).links
    return LinkRatios(params.crank / params.ground, params.coupler / params.ground, params.rocker / params.ground)


def _lengths(params: BeatUpParams, links: LinkRatios) -> dict[str, float]:
    """Lengths [m]; given ones stay as given, to the last bit."""
    ratios = {"ground": 1.0, "crank": links.crank, "coupler": links.coupler, "rocker": links.rocker}
    lengths = {name: float(getattr(params, name) or ratio * params.ground) for name, ratio in ratios.items()}
    return {**lengths, "beater": params.beater or BEATER_RATIO * lengths["rocker"]}


def _bars(params: BeatUpParams, lengths: Mapping[str, float]) -> dict[str, Inertia]:
    """The bars of the moving links, from pin to pin; the rocker's reaches to the beater, or to B if that is farther."""
    spans = {**lengths, "rocker": max(lengths["rocker"], lengths["beater"])}
    masses = {
        name: float(bar_mass(spans[name], params.width, params.thickness, params.density))
        for name in ("crank", "coupler", "rocker")
    }
    return {name: bar(0, spans[name], mass=mass, width=params.width) for name, mass in masses.items()}


def _require_swing(links: LinkRatios, planned: Plan, angle: FloatArray) -> None:
    """Raise MechanismError unless the crank turns fully and the rocker swings, away from any toggle."""
    solve(planned, angle).require()
    shown = ", ".join(f"{name} {format_quantity(float(ratio), '1')}" for name, ratio in links._asdict().items())
    margin = float(grashof_margin(links))
    if margin < TOGGLE:
        raise MechanismError(
            f"beat-up stands in a toggle: {shown} (ground 1) are {margin:.2g} from a change point",
            allowed="shortest + longest link must be less than the sum of the other two",
            do="shorten the crank",
        )
    if grashof(1.0, *(float(link) for link in links)).kind != "crank-rocker":
        raise MechanismError(
            f"the rocker of beat-up turns right round instead of swinging: {shown} (ground 1)",
            allowed="the crank must be the shortest link",
            do="lengthen ground, or shorten the crank",
        )
