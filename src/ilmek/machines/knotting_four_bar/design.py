"""The knotting four-bar's design: where it closes, its pose, motion, forces, and the servo for it."""

import dataclasses
import math
from collections.abc import Mapping
from functools import partial

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import ParameterError
from ilmek.linkage.quality import Grashof, grashof, input_range, least_transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.knotting_four_bar.links import inertias, parts
from ilmek.machines.knotting_four_bar.model import (
    GearedServo,
    KnottingState,
    closing_ground,
    drive_for,
    evaluate,
    mechanism,
)
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams, PosedParams, read_three_poses
from ilmek.machines.knotting_four_bar.posed import PosedFourBar, through_poses, through_the_reports_poses
from ilmek.machines.knotting_four_bar.sides import KnottingSides, both_sides
from ilmek.machines.knotting_four_bar.strength import four_bar_strength
from ilmek.machines.linkage_strength import LinkageStrength, bore_for, smallest_pin
from ilmek.machines.strength_params import StrengthParams
from ilmek.records import JsonObject, computed, group, record, result
from ilmek.synthesis.three_poses import ThreePoseSynthesis, synthesised
from ilmek.units import deg, format_quantity, turn

SAMPLES = 360
EDGE = 0.02
"""Part of the crank's range left out of the curves at each dead point, where forces grow without bound."""

STATED = 135 * deg
"""Default of the crank angle to report [rad]."""


@record
class KnottingFourBar:
    """A designed knotting four-bar.

    params        in force: with poses, the links that follow from them
    posed         the four-bar through the poses; None without
    crank_angle   to report [rad]
    working       crank angles from the first pose to the last, the lesser first [rad]; None without poses
    at            at the crank angle to report
    static, unit  the same at rest, and at 1 rad/s without acceleration
    moving        over the working range, or the whole range without its edges
    standing      the same at rest
    load_torque   that the drive is chosen for [N m]: the greatest magnitude, moving or at rest, at the crank angle to
                  report, with poses over the working range
    hole          diameter of the pins' holes [m]: of the pins' that bear the load
    instead       the four-bar of both arms through the report's poses; None with poses
    sides         both sides over the same motion, coupled by gears; None of one side
    """

    params: KnottingFourBarParams
    posed: PosedFourBar | None = group()
    crank_angle: float
    plan: Plan
    ground_angle: float = result("deg", "direction of the ground link, O1 to O1'")
    grashof: Grashof
    range: tuple[float, float] | None = result(
        "deg", "crank angles between its dead points", name="crank_range", absent="it turns fully"
    )
    working: tuple[float, float] | None = result(
        "deg", "crank angles from the first pose to the last", name="working_range", optional=True
    )
    parts: Mapping[str, Inertia]
    inertias: Mapping[str, Inertia]
    at: KnottingState
    static: KnottingState
    unit: KnottingState
    moving: KnottingState
    standing: KnottingState
    load_torque: float
    hole: float
    drive: GearedServo = group()
    instead: PosedFourBar | None
    sides: KnottingSides | None

    grashof_class = computed("", "class of the four-bar", lambda it: it.grashof.kind, name="grashof")
    distance = computed(
        "deg",
        "rotation of the crank to the nearer dead point, from crank_angle, with poses least over the working range",
        lambda it: it.dead_point_distance if it.range else None,
        name="dead_point_distance",
        absent="the crank turns fully",
    )

    @computed("deg", "acute angle of coupler and rocker at crank_angle, with poses least over the working range")
    def transmission_angle(self) -> float:
        return least_transmission_angle(self.moving.motion if self.working else self.at.motion, "O2'")

    @computed("N*m", "greatest torque on the crank over the working range, moving or at rest", optional=True)
    def drive_torque_max(self) -> float | None:
        return self.load_torque if self.working else None

    at_crank_angle = computed(
        "",
        "motion of coupler and rocker at crank_angle, torque on the crank, forces in the pins as magnitudes and as "
        "x, y (O1 on the crank, O2 and O2' on the coupler, O1' on the rocker)",
        lambda it: it.at.first_as_json(),
        name="at",
    )
    drive_torque_static = computed(
        "N*m", "torque on the crank at rest, from weight and the yarn's force", lambda it: float(it.static.torque[0])
    )

    @computed("N*m*s^2", "torque that each (rad/s)² of the crank's speed adds to it", least=-math.inf)
    def drive_torque_dynamic(self) -> float:
        return float(self.unit.torque[0]) - self.drive_torque_static

    masses = computed(
        "",
        "of each link, SI: mass, mass centre from its first pin, moment of inertia about it; hand on the coupler",
        lambda it: {
            name: {"mass": inertia.mass, "centre": complex(inertia.centre).real, "moment": inertia.moment}
            for name, inertia in it.inertias.items()
        },
    )
    replacement = computed(
        "",
        "four-bar whose coupler takes the report's three poses: parameters to set; crank and torque at the poses, "
        "gears and servo for the greatest; SI",
        lambda it: None if it.instead is None else it.instead.to_use_instead(),
        name="instead",
        optional=True,
    )

    @property
    def strength(self) -> LinkageStrength:
        """Stresses of links and pins; pins of links as made fit the holes."""
        made = self.params.link_mass == "made"
        limits = self.params.strength
        return self.strength_of(dataclasses.replace(limits, pin_diameter=self.hole) if made else limits)

    def strength_of(self, limits: StrengthParams) -> LinkageStrength:
        """The same for other limits; near a dead point only the motion through given poses counts."""
        return four_bar_strength(self.params, self.moving if self.working else self.at, self.inertias, limits)

    @property
    def dead_point_distance(self) -> float:
        """Rotation of the crank from its angle, or its working range, to the nearer dead point [rad].

        Infinite where it turns fully.
        """
        if not self.range:
            return math.inf
        return min(abs(angle - end) for end in self.range for angle in self.working or (self.crank_angle,))

    @property
    def onward(self) -> slice:
        """The samples in the order of the poses; without poses, of the crank's angle."""
        angles = self.posed.crank_angles if self.posed else (0.0, 1.0)
        return slice(None, None, -1 if angles[0] > angles[-1] else 1)


def design(params: KnottingFourBarParams) -> KnottingFourBar:
    """Position, move and load a knotting four-bar.

    Links as made weigh less by their holes, whose pins bear their forces: the holes grow until their pins do.
    Raises ParameterError where no ground closes the stated pose, or no four-bar takes the poses, MechanismError where
    it does not close at the crank angle.
    """
    synthesis = None
    if params.poses is not None:
        synthesis = synthesised(read_three_poses(params.poses), params.ground_angle)
    hole = smallest_pin(params.strength, params.width)
    while True:
        bar = _bored(params, synthesis, hole)
        needed = bore_for(bar.strength_of(params.strength).pin_diameter, params.width)
        if params.link_mass == "bars":
            return dataclasses.replace(bar, hole=needed)
        if needed <= hole:
            return bar
        hole = needed


def _bored(params: KnottingFourBarParams, found: ThreePoseSynthesis | None, hole: float) -> KnottingFourBar:
    """The four-bar with holes of a diameter [m]; found: through the poses, where there are some."""
    posed = None
    if found is not None:
        posed = through_poses(params, found, hole)
        params = posed.params
    angle = STATED if params.crank_angle is None else params.crank_angle
    params = dataclasses.replace(params, crank_angle=angle)
    ground_angle = closing_ground(params) if params.ground_angle is None else params.ground_angle
    planned = posed.plan if posed else plan(mechanism(params, ground_angle))
    at = np.array([angle])
    solve(planned, at).require()
    closes = _range(params, ground_angle, angle)
    working = None if posed is None else _working(posed, angle)
    angles = _angles(angle, closes) if working is None else np.linspace(*working, SAMPLES + 1)
    bodies = inertias(params, hole)
    evaluated = partial(evaluate, params, planned, bodies)
    here, static = evaluated(at, params.speed, params.acceleration), evaluated(at, 0.0)
    moving, standing = evaluated(angles, params.speed, params.acceleration), evaluated(angles, 0.0)
    load = max(state.torque_max for state in ((moving, standing) if working else (here, static)))
    sides = both_sides(params, planned, moving, standing, hole) if params.sides > 1 else None
    return KnottingFourBar(
        params=params,
        posed=posed,
        crank_angle=angle,
        plan=planned,
        ground_angle=ground_angle % turn,
        grashof=grashof(params.ground, params.crank, params.coupler, params.rocker),
        range=closes,
        working=working,
        parts=parts(params),
        inertias=bodies,
        at=here,
        static=static,
        unit=evaluated(at, 1.0),
        moving=moving,
        standing=standing,
        load_torque=load,
        hole=hole,
        # Without poses the crank angle may be nearer to a dead point than the curves; both sides stand there.
        drive=drive_for(params, max(sides.torque, 2 * load) if sides else load),
        instead=None if posed else through_the_reports_poses(params, hole),
        sides=sides,
    )


def parameters(design: KnottingFourBar) -> KnottingFourBarParams:
    """The parameters in force; with poses, the poses and the links that follow from them."""
    if design.posed is None:
        return design.params
    found = design.posed.synthesis
    own: JsonObject = {field.name: getattr(design.params, field.name) for field in dataclasses.fields(design.params)}
    return PosedParams(**{**own, "poses": found.poses.text, "ground_angle": found.ground_angle})


def _working(posed: PosedFourBar, angle: float) -> tuple[float, float]:
    """The crank's range from the first pose to the last. Raises ParameterError for an angle outside."""
    low, high = float(np.min(posed.crank_angles)), float(np.max(posed.crank_angles))
    if not low - 1e-9 <= angle <= high + 1e-9:
        given, *ends = (format_quantity(one, "deg") for one in (angle, low, high))
        raise ParameterError(
            f"crank_angle {given} is outside the motion through the poses", allowed=f"{ends[0]} to {ends[1]}"
        )
    return low, high


def _range(params: KnottingFourBarParams, ground_angle: float, angle: float) -> tuple[float, float] | None:
    """The interval about the crank angle in which the loop closes; `input_range` counts from the ground link."""
    intervals = input_range(params.ground, params.crank, params.coupler, params.rocker)
    for start, end in intervals:
        if end - start >= turn:
            return None
        # The turn on which the interval lies about the crank angle: its middle is the nearest.
        middle = ground_angle + (start + end) / 2
        middle += turn * round((angle - middle) / turn)
        half = (end - start) / 2
        if abs(angle - middle) <= half:
            return middle - half, middle + half
    raise AssertionError("a crank angle that closes lies in an interval that does")


def _angles(angle: float, closes: tuple[float, float] | None) -> FloatArray:
    """Crank angles of the curves: a turn, or the range without its edges."""
    if closes is None:
        return angle + np.arange(SAMPLES + 1) * (turn / SAMPLES)
    edge = EDGE * (closes[1] - closes[0])
    return np.linspace(closes[0] + edge, closes[1] - edge, SAMPLES + 1)
