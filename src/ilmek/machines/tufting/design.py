"""The needle mechanism's design: ranges of its angles, its stroke, and greatest torques and forces over a turn.

Torques and forces jump where the needles enter and leave the backing and where they reverse in it. Greatest values
are suprema: at a jump the limits from both sides count.

Several mechanisms on one main shaft run each behind the one before by the same angle:

    M(theta) = sum_k M_b(theta - k phase),      R(theta) = sum_k R_O(theta - k phase),      k = 0 ... bars - 1

The sum R is carried by all bearings of the main shaft together; their shares depend on their positions.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.friction import AngleRange
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import MechanismError
from ilmek.linkage.motion import AttachedPoint, Motion
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.tufting.links import NeedleSizes, made_inertias
from ilmek.machines.tufting.model import PINS, TuftingState, evaluate, inertias, mechanism, move
from ilmek.machines.tufting.params import TuftingParams
from ilmek.num.piecewise import Extremum, around, integrals, roots_of_turn, suprema
from ilmek.records import Computed, computed, record, result
from ilmek.report import Json
from ilmek.units import turn

SAMPLES, PARTS = 720, 16
"""Samples over a turn: half a degree; parts of a turn that are integrated one by one."""

LINKS = {"theta2": "coupler", "theta3": "rocker", "theta4": "arm", "theta5": "rod"}
"""The paper's angles: of A-B, C-B, C-D and D-E against x."""

TORQUES = ("main_torque", "driven_torque")
JOINTS = (*PINS, "guide")

Moved: TypeAlias = Callable[[FloatArray], Motion]
"""Motion at crank angles [rad]."""

Evaluated: TypeAlias = Callable[[FloatArray, FloatArray], TuftingState]
"""State at crank angles [rad]; sides: which limit counts where the friction jumps."""


def _peak(unit: str, doc: str, name: str) -> Computed[float]:
    """A result that is one of the `peaks`."""
    return computed(unit, doc, lambda it: it.peaks[name].value)


def _ends(unit: str, doc: str, name: str) -> Computed[list[float]]:
    """A result that is the least and the greatest value of an angle or torque."""
    return computed(unit, doc, lambda it: list(it.ranges[name]))


@record
class Tufting:
    """A designed needle mechanism.

    ranges           least and greatest values: of theta2 ... theta5 [rad], unwrapped as in the paper, and with their
                     signs of main_torque and driven_torque [N m]
    bodies           inertias of the links              sizes  of shafts and pins of links as made; None: by strength
    breaks           crank angles [rad] at which the friction jumps
    state            over one turn, both ends included; at breaks twice, with both limits
    peaks            greatest values over the turn: magnitudes of main_torque, driven_torque, joints, needle_velocity
                     and needle_acceleration; total_torque and bearing of all bars together
    work             over a turn [J]: drive, friction (in the backing), and sums for the rms torques [N² m² rad]
    at               at the given crank angle, if any
    """

    params: TuftingParams
    plan: Plan
    bodies: Mapping[str, Inertia]
    sizes: NeedleSizes | None
    ranges: Mapping[str, tuple[float, float]]
    breaks: tuple[float, ...]
    state: TuftingState
    peaks: Mapping[str, Extremum]
    work: Mapping[str, float]
    at: TuftingState | None
    stroke: float = result("mm", "distance of the needle's highest position from its lowest")
    lowest: float = result("deg", "crank angle at which the needle is lowest", name="lowest_crank_angle")
    highest: float = result("deg", "crank angle at which the needle is highest", name="highest_crank_angle")
    transmission: float = result("deg", "least acute angle of coupler and rocker", name="transmission_angle_min")
    pressure_angle: float = result("deg", "greatest angle of the rod to the needle's line", name="pressure_angle_max")

    theta2_range = _ends("deg", "least and greatest angle of the coupler, A to B", "theta2")
    theta3_range = _ends("deg", "least and greatest angle of the rocker, C to B", "theta3")
    theta4_range = _ends("deg", "those of the arm, C to D: theta3 + beta1 - 360 deg (Eq 15)", "theta4")
    theta5_range = _ends("deg", "least and greatest angle of the rod, D to E", "theta5")
    entry_height = computed("mm", "needle above its lowest position at entry", lambda it: it.height(it.params.entry))
    exit_height = computed("mm", "needle above its lowest position at exit", lambda it: it.height(it.params.exit))
    needle_velocity_max = _peak("m/s", "greatest speed of the needle", "needle_velocity")
    needle_acceleration_max = _peak("m/s^2", "greatest acceleration of the needle", "needle_acceleration")
    main_shaft_torque_max = _peak("N*m", "greatest magnitude of the torque on the crank", "main_torque")
    main_shaft_torque_range = _ends("N*m", "least and greatest, with sign", "main_torque")
    main_shaft_torque_rms = computed("N*m", "root mean square of the same", lambda it: it.rms("main_torque"))
    driven_shaft_torque_max = _peak(
        "N*m", "greatest magnitude of the torque from rocker to arm; a limit where friction jumps", "driven_torque"
    )
    driven_shaft_torque_range = _ends("N*m", "least and greatest, with sign", "driven_torque")
    driven_shaft_torque_rms = computed("N*m", "root mean square of the same", lambda it: it.rms("driven_torque"))

    @computed("N", "greatest force in each joint; C is the whole load of the driven shaft's bearing")
    def pin_force_max(self) -> dict[str, float]:
        return {name: self.peaks[name].value for name in JOINTS}

    @computed("N", "greatest force of the driven shaft on rocker and arm each")
    def driven_shaft_force_max(self) -> dict[str, float]:
        return {name: self.peaks[f"C on {name}"].value for name in ("rocker", "arm")}

    energy_per_revolution = computed("J", "work of the drive in a turn of the crank", lambda it: it.work["drive"])
    friction_work_per_revolution = computed("J", "part of it for the backing", lambda it: it.work["friction"])
    main_shaft_torque_mean = computed("N*m", "mean torque on the crank", lambda it: it.work["drive"] / turn)
    power_mean = computed("W", "mean power of the drive", lambda it: it.main_shaft_torque_mean * it.params.speed)
    total_torque_max = _peak("N*m", "greatest torque of all bars on the main shaft", "total_torque")
    total_energy_per_revolution = computed(
        "J", "work of the drive for all bars", lambda it: it.params.bars * it.energy_per_revolution
    )
    shaft_bearing_force_max = _peak("N", "greatest force of its bearings on the main shaft", "bearing")

    @computed(
        "",
        "the same at crank_angle, just after it where they jump; torques counter-clockwise, needle downward",
        name="at",
        optional=True,
    )
    def at_crank_angle(self) -> Json:
        if self.at is None:
            return None
        return {
            "main_shaft_torque": float(self.at.main_torque[0]),
            "driven_shaft_torque": float(self.at.driven_torque[0]),
            "pin_forces": {name: float(np.abs(self.at.joints[name][0])) for name in JOINTS},
            "needle_velocity": float(self.at.velocity[0]),
            "needle_acceleration": float(self.at.acceleration[0]),
        }

    @property
    def lowest_within(self) -> bool:
        """Whether the needle is lowest between entry and exit."""
        return bool(AngleRange(self.params.entry, self.params.exit).contains(self.lowest))

    def height(self, angle: float) -> float:
        """Needle's point above its lowest position [m] at a crank angle [rad]."""
        heights = np.imag(_needle(move(self.params, self.plan, np.array([angle, self.lowest]))).position)
        return float(heights[0] - heights[1])

    def rms(self, name: str) -> float:
        """Root mean square over a turn [N m] of main_torque or driven_torque."""
        return math.sqrt(self.work[f"{name}_squared"] / turn)

    def shaft_torque(self) -> tuple[FloatArray, FloatArray]:
        """Crank angles of the first bar [rad] and torque of all bars on the main shaft [N m]; at jumps twice."""
        breaks = tuple(sorted(at % turn for at in _all_breaks(self.params, self.breaks)))
        angle, side = turn_with(breaks)
        return angle, _shaft(self.params, partial(evaluate, self.params, self.plan, bodies=self.bodies), angle, side)[0]


def loaded(params: TuftingParams, sizes: NeedleSizes | None = None) -> Tufting:
    """Move and load a needle mechanism; sizes: of the shafts and pins of links as made; None: the masses are given.

    Raises MechanismError where it does not turn or its rocker does not swing.
    """
    planned = plan(mechanism(params))
    bodies = inertias(params) if sizes is None else made_inertias(params, sizes)
    moved, evaluated = partial(move, params, planned), partial(evaluate, params, planned, bodies=bodies)
    ranges = _ranges(params, moved)
    reversals = roots_of_turn(lambda at: np.imag(_needle(moved(at)).velocity), samples=SAMPLES)
    lowest, highest, stroke = _reversals(moved, reversals)
    breaks = _breaks(params, reversals)
    pieces, all_pieces = around(breaks), around(_all_breaks(params, breaks))
    top = suprema(lambda *at: _curves(evaluated(*at)), pieces, samples=SAMPLES)
    quality = suprema(lambda at, _: _quality(moved(at)), around(), samples=SAMPLES)
    shaft = suprema(lambda *at: _shaft_loads(params, evaluated, *at), all_pieces, samples=SAMPLES)
    work = integrals(lambda *at: _work(params, evaluated(*at)), around(breaks, parts=PARTS))
    torques = {name: (-top[f"{name} least"].value, top[f"{name} greatest"].value) for name in TORQUES}
    return Tufting(
        params=params,
        plan=planned,
        bodies=bodies,
        sizes=sizes,
        ranges={**ranges, **torques},
        breaks=breaks,
        state=evaluated(*turn_with(breaks)),
        peaks={**top, **quality, **shaft},
        work={name: math.fsum(parts) for name, parts in work.items()},
        at=None if params.crank_angle is None else evaluated(np.array([params.crank_angle])),
        stroke=stroke,
        lowest=lowest,
        highest=highest,
        transmission=math.pi / 2 - quality["off square"].value,
        pressure_angle=quality["pressure angle"].value,
    )


def turn_with(breaks: tuple[float, ...]) -> tuple[FloatArray, FloatArray]:
    """Crank angles over a turn [rad], ascending, both ends included, each break twice; and the side of each."""
    even = np.arange(SAMPLES + 1) * (turn / SAMPLES)
    angle = np.concatenate((even, breaks, breaks))
    side = np.concatenate((np.ones(even.size), -np.ones(len(breaks)), np.ones(len(breaks))))
    order = np.lexsort((side, angle))
    return angle[order], side[order]


def _needle(motion: Motion) -> AttachedPoint:
    return motion.carried("needle", 0j)


def _ranges(params: TuftingParams, moved: Moved) -> dict[str, tuple[float, float]]:
    """Least and greatest of every angle. Raises MechanismError where a link makes full turns.

    Angles are taken about the link's mean direction, so that a swing across 0 is one swing.
    """
    motion = moved(np.arange(SAMPLES) * (turn / SAMPLES))
    mean = {name: complex(np.mean(motion.direction(body))) for name, body in LINKS.items()}
    for name, body in LINKS.items():
        if np.any(np.real(np.conj(mean[name]) * motion.direction(body)) <= 0):
            given = f"the {body} of tufting turns right round or swings by more than half a turn"
            allowed = f"{name} must swing, for the needle to go up and down"
            raise MechanismError(given, allowed=allowed, do="shorten crank")

    def about_mean(angle: FloatArray, _: FloatArray) -> dict[str, FloatArray]:
        motion = moved(angle)
        return _both_ends(
            {name: np.angle(np.conj(mean[name]) * motion.direction(body)) for name, body in LINKS.items()}
        )

    found = suprema(about_mean, around(), samples=SAMPLES)
    middle = {name: float(np.angle(direction)) % turn for name, direction in mean.items()}
    # Eq 15; the mean directions of rocker and arm differ by beta1 to rounding, as they turn together.
    middle["theta4"] = middle["theta3"] + params.arm_angle - turn
    return {
        name: (middle[name] - found[f"{name} least"].value, middle[name] + found[f"{name} greatest"].value)
        for name in LINKS
    }


def _both_ends(curves: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Each curve with both signs, so that its supremum gives the least value too."""
    ends = (("least", -1.0), ("greatest", 1.0))
    return {f"{name} {end}": sign * values for name, values in curves.items() for end, sign in ends}


def _reversals(moved: Moved, reversals: FloatArray) -> tuple[float, float, float]:
    """Crank angles of the lowest and highest position of the needle, and the stroke between them."""
    if reversals.size == 0:
        raise MechanismError("the needle of tufting does not move", do="lengthen crank or arm")
    height = np.imag(_needle(moved(reversals)).position)
    low, high = int(np.argmin(height)), int(np.argmax(height))
    return float(reversals[low]), float(reversals[high]), float(height[high] - height[low])


def _breaks(params: TuftingParams, reversals: FloatArray) -> tuple[float, ...]:
    ends = (params.entry, params.exit) if params.friction != "always" else ()
    return tuple(sorted(at % turn for at in (*reversals.tolist(), *ends)))


def _all_breaks(params: TuftingParams, breaks: tuple[float, ...]) -> list[float]:
    """Angles at which the sum of all bars may jump [rad]: those of each bar."""
    return [at + params.phase * bar for at in breaks for bar in range(params.bars)]


def _curves(state: TuftingState) -> dict[str, FloatArray]:
    """Torques with both signs; magnitudes of torques and forces, the driven shaft's on rocker and arm besides C."""
    forces = {
        **{name: state.joints[name] for name in JOINTS},
        "C on rocker": state.joints["C"] - state.joints["shaft"],
        "C on arm": state.joints["shaft"],
    }
    torques = {"main_torque": state.main_torque, "driven_torque": state.driven_torque}
    return {**_both_ends(torques), **{name: np.abs(values) for name, values in {**torques, **forces}.items()}}


def _shaft(
    params: TuftingParams, evaluated: Evaluated, angle: FloatArray, side: FloatArray
) -> tuple[FloatArray, ComplexArray]:
    """Torque on the main shaft [N m] and force of its bearings on it [N], all bars together."""
    behind, alike = np.unique(np.mod(params.phase * np.arange(params.bars), turn), return_counts=True)
    state = evaluated(np.ravel(angle - behind[:, None]), np.tile(side, behind.size))
    torque, force = (alike @ one.reshape(behind.size, -1) for one in (state.main_torque, state.joints["O"]))
    return torque, force


def _shaft_loads(
    params: TuftingParams, evaluated: Evaluated, angle: FloatArray, side: FloatArray
) -> dict[str, FloatArray]:
    torque, force = _shaft(params, evaluated, angle, side)
    return {"total_torque": np.abs(torque), "bearing": np.abs(force)}


def _work(params: TuftingParams, state: TuftingState) -> dict[str, FloatArray]:
    return {
        "drive": state.main_torque,
        "friction": state.friction * state.velocity / params.speed,
        "main_torque_squared": state.main_torque**2,
        "driven_torque_squared": state.driven_torque**2,
    }


def _quality(motion: Motion) -> dict[str, FloatArray]:
    needle = _needle(motion)
    return {
        "pressure angle": pressure_angle(motion),
        "needle_velocity": np.abs(np.imag(needle.velocity)),
        "needle_acceleration": np.abs(np.imag(needle.acceleration)),
        "off square": np.abs(transmission_angle(motion, "B") - math.pi / 2),
    }


def pressure_angle(motion: Motion) -> FloatArray:
    """Angle of the rod to the needle's line [rad], 0 ... pi, one a sample."""
    rod = motion.direction("rod")
    return np.asarray(np.arctan2(np.abs(np.real(rod)), -np.imag(rod)))
