"""Both sides of the knotting machine: the four-bar and its mirror image, their cranks coupled 1:-1 by equal gears.

The mirror is an upright line half way between the pivots of the two cranks, so both hands come to it at one height and
at one time. It is one mechanism of one degree of freedom: the first crank drives the second through the gears' teeth.
"""

import math
from collections.abc import Mapping
from functools import partial

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.inertia import Inertia, combined
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, PointForce
from ilmek.elements.gears import EqualGears, equal_gears
from ilmek.errors import ParameterError, restated
from ilmek.linkage.clearance import Clearance, OutlinedBody, clearance
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.mirror import GEARS, coupled, mirrored, other
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.one_input import one_input
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.knotting_four_bar.links import gear_part, inertias, tool
from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.link_tree import inertia_of
from ilmek.part.tree import Occurrence
from ilmek.plane.outlines import Outline
from ilmek.plane.vectors import unit
from ilmek.records import computed, group, record, result
from ilmek.report import Json
from ilmek.weaving.knots.two_hands import TwoHandKnot, knot_of_hands, pitch_range

BODIES = ("crank", "coupler", "rocker")


@record
class Coupled:
    """Motion and forces of both sides at given crank angles, and the torques of each side driven alone.

    torque  of the motor on the first crank [N m]       alone  of the first and of the second side on their own cranks
    tooth   force along the pitch circle [N]
    """

    angle: FloatArray
    motion: Motion
    forces: Forces
    torque: FloatArray
    tooth: FloatArray
    alone: tuple[FloatArray, FloatArray]

    @property
    def torque_error(self) -> float:
        """Motor torque against that of both sides alone, over the greatest; the cranks turn in opposite directions."""
        missed = self.torque - (self.alone[0] - self.alone[1])
        return float(np.max(np.abs(missed)) / max(float(np.max(np.abs(self.torque))), 1e-300))


@record
class KnottingSides:
    """Both sides, designed.

    facing    +1: the mirror is right of the first side, -1: left
    gears     on the cranks' pivots           least_distance  of these that keeps side_clearance [m]
    moving    over the motion of the crank    standing        the same at rest
    """

    mirror: float = result("mm", "x of the upright line that the second side is mirrored in")
    facing: int
    gears: EqualGears
    least_distance: float
    plan: Plan
    moving: Coupled
    standing: Coupled
    knot: float = result("deg", "crank angle at which the hands are nearest to one another", name="knot_crank_angle")

    axis_distance = computed("mm", "distance of the pivots of both cranks", lambda it: it.gears.distance)
    hand_distance_min = computed("mm", "least distance of the two hands", lambda it: float(it.gap.min()))

    @computed("N*m", "greatest torque of one motor on the first crank, for both sides", name="motor_torque_max")
    def torque(self) -> float:
        return max(float(np.max(np.abs(one.torque))) for one in (self.moving, self.standing))

    @computed(
        "",
        "of both cranks, equal, SI; the pins contain the force of the teeth, along the pitch circle and apart, but no "
        "friction or play",
        name="gears",
        shown=False,
    )
    def gear_data(self) -> Json:
        gears = self.gears
        names = ("module", "teeth", "width", "pitch_radius", "pressure_angle", "profile_shift")
        return {
            **{name: getattr(gears, name) for name in names},
            "tooth_force_max": self.tooth,
            "separating_force_max": gears.separating(self.tooth),
            "bending_stress": gears.bending(self.tooth),
        }

    @computed("", "greatest force in each pin over the motion, *: of the second side; SI", shown=False)
    def side_pin_forces_max(self) -> Json:
        pins = (joint.name for joint in self.plan.mechanism.joints)
        return {name.replace(" ", ""): float(np.max(np.abs(self.moving.forces.pin(name)))) for name in pins}

    @property
    def tooth(self) -> float:
        """The greatest force along the gears' pitch circle [N], moving or at rest."""
        return max(float(np.max(np.abs(one.tooth))) for one in (self.moving, self.standing))

    @property
    def gap(self) -> FloatArray:
        """Distance of the two hands over the motion [m]."""
        first, second = hands(self.moving.motion)
        return np.asarray(np.abs(second - first))


@record
class SidesAnalysis:
    """Clearances of both sides, and the knot that the hands tie.

    clearances  of each body to its mirror image        proof  of the knot on warps at warp_pitch
    wider       the knot on warps opened to the middle of knot_pitches, "" where there are none
    """

    sides: KnottingSides = group()
    clearances: Mapping[str, Clearance]
    proof: TwoHandKnot
    knot_pitches: tuple[float, float] | None = result(
        "mm", "least and greatest distance of two warps on which a knot is tied", absent="on none"
    )
    wider: str

    @computed("mm", "least of all bodies over the motion, each to its mirror image")
    def side_clearance_min(self) -> float:
        return min(one.least for one in self.clearances.values())

    gripper_clearance_min = computed(
        "mm", "least of the couplers with their grippers", lambda it: it.clearances["coupler"].least
    )
    knot_tied = computed(
        "", "knot on two warps at warp_pitch between the sides, by the crossings of the yarn", lambda it: it.proof.name
    )
    knot_why = computed("", "where it is tied, or why there is none", lambda it: it.proof.why, shown=False)


def analyse_sides(params: KnottingFourBarParams, sides: KnottingSides, onward: slice) -> SidesAnalysis:
    """Clearances, and the knot; `onward`: the samples in the order of the poses."""
    first, second = (path[onward] for path in hands(sides.moving.motion))
    wide = pitch_range(first, second)
    return SidesAnalysis(
        sides=sides,
        clearances=clearances(params, sides),
        proof=knot_of_hands(first, second, params.warp_pitch),
        knot_pitches=wide,
        wider="" if wide is None else knot_of_hands(first, second, sum(wide) / 2).name,
    )


def hands(motion: Motion) -> tuple[ComplexArray, ComplexArray]:
    """Positions of both hands over the samples [m]."""
    first, second = motion.point("coupler", "H"), motion.point(other("coupler"), other("H"))
    return np.asarray(first.position), np.asarray(second.position)


def both_sides(
    params: KnottingFourBarParams, one: Plan, moving: KnottingState, standing: KnottingState, hole: float
) -> KnottingSides:
    """The mirrored side beside the first one and its states, and the gears between them; hole: of the pins [m].

    Raises ParameterError where the axes are too close for gears.
    """
    angles, start = moving.angle, one.mechanism.point(GROUND, "O1")
    hand = moving.motion.point("coupler", "H").position.real
    facing = max((+1, -1), key=lambda side: float(np.max(side * (hand - start.real))))
    least = 2 * _reach(params, moving.motion, start, facing) + params.side_clearance
    gears = _gears(params, least, max(moving.torque_max, standing.torque_max))
    mirror = start.real + facing * gears.distance / 2
    image, planned = plan(mirrored(one.mechanism, mirror)), plan(coupled(one.mechanism, mirror, gears.pressure_angle))
    run = partial(_coupled_run, params, (one, image, planned), _side_inertias(params, gears, hole), angles)
    return KnottingSides(
        mirror=mirror,
        facing=facing,
        gears=gears,
        least_distance=least,
        plan=planned,
        moving=run(speed=params.speed, acceleration=params.acceleration),
        standing=run(speed=0.0, acceleration=0.0),
        knot=float(angles[int(np.argmax(facing * hand))]),
    )


def _side_inertias(params: KnottingFourBarParams, gears: EqualGears, hole: float) -> dict[str, Inertia]:
    """The moving bodies of a side, its crank with a gear: a solid disc beside bars, a bored one beside made links."""
    bore = hole if params.link_mass == "made" else 0.0
    bodies, gear = inertias(params, hole), inertia_of((Occurrence(gear_part(params, gears, bore)),))
    return {**bodies, "crank": combined(bodies["crank"], gear)}


def outlines(params: KnottingFourBarParams, mechanism: Mechanism, body: str) -> OutlinedBody:
    """A body of the first side as seen in the plane of motion: its bar, on the coupler holder and gripper too."""
    shapes = [Outline(tuple(mechanism.body(body).points.values()), params.width / 2)]
    if body == "coupler":
        shapes += [
            Outline(tuple(complex(x, side * width / 2) for x in (start, end) for side in (+1, -1)))
            for start, end, width in tool(params).values()
        ]
    return OutlinedBody(body, tuple(shapes))


def _reach(params: KnottingFourBarParams, motion: Motion, start: complex, facing: int) -> float:
    """Greatest distance of any body from the crank's pivot to one side [m]."""
    most = 0.0
    for body in BODIES:
        origin, direction = motion.origin(body), motion.direction(body)
        for shape in outlines(params, motion.plan.mechanism, body).outlines:
            corners = origin[:, None] + direction[:, None] * shape.corners
            most = max(most, float(np.max(facing * (corners.real - start.real))) + shape.radius)
    return most


def _gears(params: KnottingFourBarParams, least: float, torque: float) -> EqualGears:
    with restated(ParameterError):
        return equal_gears(
            least if params.axis_distance is None else params.axis_distance,
            torque,
            width=params.gear_width,
            stress=params.gear_stress,
            module=params.gear_module,
            standard=params.axis_distance is None,
        )


def _coupled_run(
    params: KnottingFourBarParams,
    plans: tuple[Plan, Plan, Plan],
    bodies: Mapping[str, Inertia],
    angles: FloatArray,
    *,
    speed: float,
    acceleration: float,
) -> Coupled:
    """Both sides coupled, and each alone; plans of the first side, its mirror image, and both; the bodies of a side."""
    one, image, both = plans
    images = {other(body): inertia for body, inertia in bodies.items()}
    force, weight = params.grip_force * complex(unit(params.grip_angle)), Gravity(-1j * params.gravity)
    pull, mirrored_pull = (
        PointForce("coupler.H", force),
        PointForce((other("coupler"), other("H")), -force.conjugate()),
    )
    first = inverse(solve(one, angles, speed, acceleration).require(), bodies, (weight, pull))
    # The second crank turns in the other direction.
    second = inverse(solve(image, math.pi - angles, -speed, -acceleration).require(), images, (weight, mirrored_pull))
    motion = solve(both, angles, speed, acceleration).require()
    forces = inverse(motion, {**bodies, **images}, (weight, pull, mirrored_pull))
    alone = first.effort("crank"), second.effort(other("crank"))
    (mesh,) = both.mechanism.couplings
    along = np.abs(forces.tooth(GEARS)) * math.cos(mesh.pressure_angle)
    return Coupled(angles, motion, forces, forces.effort("crank"), along, alone)


def clearances(params: KnottingFourBarParams, sides: KnottingSides) -> dict[str, Clearance]:
    """The least clearance of each body, and of its mirror image, over the motion [m].

    No other pair comes nearer: a body that stays the distance d from the mirror stays 2 d from its image, and d + d'
    from any other that stays d' from it. The coupler has holder and gripper.
    """
    angles = sides.moving.angle
    path = InputPath(one_input(sides.plan), float(np.min(angles)), float(np.max(angles)))
    bodies = {body: outlines(params, sides.plan.mechanism, body) for body in BODIES}
    return {body: clearance(path, one, OutlinedBody(other(body), one.outlines)) for body, one in bodies.items()}
