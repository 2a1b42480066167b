"""The needle mechanism's design: ranges of its angles, its stroke, and greatest torques and forces over a turn.

Torques and forces jump where the needles enter and leave the backing and where they turn round in it. Greatest values
are suprema: at a jump the limits from both sides count.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.attached import attached
from ilmek.dynamics.friction import AngleRange
from ilmek.errors import MechanismError
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.tufting.bars import all_breaks, together
from ilmek.machines.tufting.model import PINS, TuftingState, evaluate, mechanism, move
from ilmek.machines.tufting.params import TuftingParams
from ilmek.num.piecewise import Extremum, around, integrals, roots_of_turn, suprema
from ilmek.units import turn

SAMPLES, PARTS = 720, 16
"""Samples over a turn: half a degree; parts of a turn that are integrated one by one."""

LINKS = {"theta2": "coupler", "theta3": "rocker", "theta4": "arm", "theta5": "rod"}
"""The paper's angles: of A-B, C-B, C-D and D-E against x."""


@dataclass(frozen=True, slots=True)
class Tufting:
    """A designed needle mechanism.

    ranges           theta2 ... theta5 -> least and greatest angle [rad], unwrapped as in the paper
    lowest, highest  crank angles [rad] at which the needle turns round
    stroke           of the needle [m]
    breaks           crank angles [rad] at which the friction jumps
    state            over one turn, both ends included; at breaks twice, with both limits
    peaks            greatest sizes over the turn: main_torque, driven_torque, joints, needle_velocity and
                     needle_acceleration, and of all bars together total_torque and bearing
    extremes         least and greatest values with their signs: main_torque, driven_torque
    work             over a turn [J]: drive, friction (what the backing takes), and sums for the rms torques [N² m² rad]
    pressure_angle   greatest angle [rad] between rod and needle's line
    transmission     least acute angle [rad] between coupler and rocker
    at               at the crank angle asked for, if any
    """

    params: TuftingParams
    plan: Plan
    ranges: Mapping[str, tuple[float, float]]
    lowest: float
    highest: float
    stroke: float
    breaks: tuple[float, ...]
    state: TuftingState
    peaks: Mapping[str, Extremum]
    extremes: Mapping[str, tuple[float, float]]
    work: Mapping[str, float]
    pressure_angle: float
    transmission: float
    at: TuftingState | None

    @property
    def lowest_within(self) -> bool:
        """Whether the needle is lowest between entry and exit."""
        return bool(AngleRange(self.params.entry, self.params.exit).holds(self.lowest))

    def height(self, angle: float) -> float:
        """Needle's point against its lowest place [m] at a crank angle [rad]."""
        ends = np.array([angle, self.lowest])
        heights = np.imag(attached(move(self.params, self.plan, ends), "needle", 0j).position)
        return float(heights[0] - heights[1])

    def rms(self, name: str) -> float:
        """Root mean square over a turn [N m] of main_torque or driven_torque."""
        return math.sqrt(self.work[f"{name}_squared"] / turn)


def design(params: TuftingParams) -> Tufting:
    """Move and load a needle mechanism. Raises MechanismError where it does not turn or its rocker does not swing."""
    planned = plan(mechanism(params))
    ranges = _ranges(params, planned)
    turns = roots_of_turn(
        lambda at: np.imag(attached(move(params, planned, at), "needle", 0j).velocity), samples=SAMPLES
    )
    lowest, highest, stroke = _reversals(params, planned, turns)
    breaks = _breaks(params, turns)

    def curves(at: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
        return _curves(params, planned, at, side)

    pieces = around(breaks)
    top = suprema(curves, pieces, samples=SAMPLES)
    quality = suprema(lambda at, _: _quality(params, planned, at), around(), samples=SAMPLES)
    work = integrals(lambda *at: _work(params, planned, *at), around(breaks, parts=PARTS))
    return Tufting(
        params=params,
        plan=planned,
        ranges=ranges,
        lowest=lowest,
        highest=highest,
        stroke=stroke,
        breaks=breaks,
        state=evaluate(params, planned, *course(breaks)),
        peaks={**_sizes(top), **quality, **_all_bars(params, planned, breaks)},
        extremes={name: (-top[f"{name} least"].value, top[f"{name} greatest"].value) for name in TORQUES},
        work={name: math.fsum(parts) for name, parts in work.items()},
        pressure_angle=quality["pressure angle"].value,
        transmission=math.pi / 2 - quality["off square"].value,
        at=None if params.crank_angle is None else evaluate(params, planned, np.array([params.crank_angle])),
    )


TORQUES = ("main_torque", "driven_torque")


def course(breaks: tuple[float, ...]) -> tuple[FloatArray, FloatArray]:
    """Crank angles over a turn [rad], ascending, both ends included, each break twice; and the side meant at each."""
    even = np.arange(SAMPLES + 1) * (turn / SAMPLES)
    angle = np.concatenate((even, breaks, breaks))
    side = np.concatenate((np.ones(even.size), -np.ones(len(breaks)), np.ones(len(breaks))))
    order = np.lexsort((side, angle))
    return angle[order], side[order]


def _ranges(params: TuftingParams, planned: Plan) -> dict[str, tuple[float, float]]:
    """Least and greatest of every angle. Raises MechanismError where a link turns right round.

    Angles are taken about the link's mean direction, so that a swing across 0 is one swing.
    """
    motion = move(params, planned, np.arange(SAMPLES) * (turn / SAMPLES))
    mean = {name: complex(np.mean(motion.direction(body))) for name, body in LINKS.items()}
    for name, body in LINKS.items():
        if np.any(np.real(np.conj(mean[name]) * motion.direction(body)) <= 0):
            raise MechanismError(
                f"the {body} of tufting turns right round or swings by more than half a turn",
                allowed=f"{name} must swing, for the needle to go up and down",
                do="shorten crank",
            )

    def about_mean(angle: FloatArray, _: FloatArray) -> dict[str, FloatArray]:
        moved = move(params, planned, angle)
        off = {name: np.angle(np.conj(mean[name]) * moved.direction(body)) for name, body in LINKS.items()}
        return {f"{name} {end}": sign * off[name] for name in LINKS for end, sign in (("least", -1), ("greatest", 1))}

    found = suprema(about_mean, around(), samples=SAMPLES)
    middle = {name: float(np.angle(direction)) % turn for name, direction in mean.items()}
    # Eq 15; the mean directions of rocker and arm differ by beta1 to rounding, as they turn together.
    middle["theta4"] = middle["theta3"] + params.arm_angle - turn
    return {
        name: (middle[name] - found[f"{name} least"].value, middle[name] + found[f"{name} greatest"].value)
        for name in LINKS
    }


def _reversals(params: TuftingParams, planned: Plan, turns: FloatArray) -> tuple[float, float, float]:
    """Crank angles of the lowest and highest place of the needle, and the stroke between them."""
    if turns.size == 0:
        raise MechanismError("the needle of tufting does not move", do="lengthen crank or arm")
    height = np.imag(attached(move(params, planned, turns), "needle", 0j).position)
    low, high = int(np.argmin(height)), int(np.argmax(height))
    return float(turns[low]), float(turns[high]), float(height[high] - height[low])


def _breaks(params: TuftingParams, turns: FloatArray) -> tuple[float, ...]:
    ends = (params.entry, params.exit) if params.friction == "window" else ()
    return tuple(sorted(at % turn for at in (*turns.tolist(), *ends)))


def _all_bars(params: TuftingParams, planned: Plan, breaks: tuple[float, ...]) -> dict[str, Extremum]:
    pieces = around(all_breaks(breaks, params.bars, params.phase))
    return suprema(lambda *at: _shaft_sizes(params, planned, *at), pieces, samples=SAMPLES)


def _curves(params: TuftingParams, planned: Plan, angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
    state = evaluate(params, planned, angle, side)
    torques = {"main_torque": state.main_torque, "driven_torque": state.driven_torque}
    ends = {
        f"{name} {end}": sign * torque
        for name, torque in torques.items()
        for end, sign in (("least", -1.0), ("greatest", 1.0))
    }
    return {**ends, **{name: np.abs(force) for name, force in _pin_forces(state).items()}}


def _pin_forces(state: TuftingState) -> dict[str, ComplexArray]:
    """Joints as reported; what the driven shaft gives to rocker and arm each is told apart from their sum C."""
    joints = state.joints
    return {
        **{name: joints[name] for name in (*PINS, "guide")},
        "C on rocker": joints["C"] - joints["shaft"],
        "C on arm": joints["shaft"],
    }


def _sizes(top: Mapping[str, Extremum]) -> dict[str, Extremum]:
    """The greatest sizes: of a torque the greater of its two ends."""
    joints = {name: peak for name, peak in top.items() if not name.endswith((" least", " greatest"))}
    torques = {
        name: max((top[f"{name} least"], top[f"{name} greatest"]), key=lambda peak: peak.value) for name in TORQUES
    }
    return {**torques, **joints}


def shaft(params: TuftingParams, planned: Plan, angle: FloatArray, side: FloatArray) -> tuple[FloatArray, ComplexArray]:
    """Torque on the main shaft [N m] and force of its bearings on it [N], all bars together."""

    def one(at: FloatArray, beside: FloatArray) -> tuple[FloatArray, ComplexArray]:
        state = evaluate(params, planned, at, beside)
        return state.main_torque, state.joints["O"]

    return together(one, params.bars, params.phase, angle, side)


def _shaft_sizes(params: TuftingParams, planned: Plan, angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
    torque, force = shaft(params, planned, angle, side)
    return {"total_torque": np.abs(torque), "bearing": np.abs(force)}


def _work(params: TuftingParams, planned: Plan, angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
    state = evaluate(params, planned, angle, side)
    return {
        "drive": state.main_torque,
        "friction": state.friction * state.velocity / params.speed,
        "main_torque_squared": state.main_torque**2,
        "driven_torque_squared": state.driven_torque**2,
    }


def _quality(params: TuftingParams, planned: Plan, angle: FloatArray) -> dict[str, FloatArray]:
    motion = move(params, planned, angle)
    rod, needle = motion.direction("rod"), attached(motion, "needle", 0j)
    return {
        "pressure angle": np.arctan2(np.abs(np.real(rod)), -np.imag(rod)),
        "needle_velocity": np.abs(np.imag(needle.velocity)),
        "needle_acceleration": np.abs(np.imag(needle.acceleration)),
        "off square": np.abs(transmission_angle(motion, "B") - math.pi / 2),
    }
