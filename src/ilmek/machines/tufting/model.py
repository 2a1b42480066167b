"""The needle six-bar as a mechanism of the engine, with its masses and loads, and its state at given crank angles.

    ground O-C     crank O-A, driven     coupler A-B     rocker C-B, arm C-D: both on the driven shaft C
    rod D-E        needle bar at E, on a vertical line; its point F is `needle` below E

O is the origin, x to the right, y up; the crank turns counter-clockwise from x. B lies on the left of A -> C, E below
D. Rocker and arm are two bodies: the torque that holds the arm at its fixed angle on the rocker is the driven shaft's.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.dynamics.friction import OFFSET, AngleRange, Friction
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import AttachedPoint, Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.machines.tufting.params import TuftingParams
from ilmek.records import record
from ilmek.units import deg

PINS = ("O", "A", "B", "C", "D", "E")
DOWN = -90 * deg


@record
class TuftingState:
    """The mechanism at given crank angles, one value a sample.

    joints         joint -> force in it [N], complex: O to E and guide; C: whole force of the driven shaft's bearing
    main_torque    torque on the crank, counter-clockwise [N m]
    driven_torque  torque of the rocker on the arm through the driven shaft, counter-clockwise [N m]
    height         needle's point F against the driven shaft, upward [m]
    velocity       of the needle, downward [m/s]          acceleration  of the needle, downward [m/s²]
    friction       force of the backing on the needle, upward [N]
    """

    angle: FloatArray
    motion: Motion
    forces: Forces
    joints: Mapping[str, ComplexArray]
    main_torque: FloatArray
    driven_torque: FloatArray
    height: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    friction: FloatArray


def mechanism(params: TuftingParams) -> Mechanism:
    """The six-bar; rocker and arm turn as one, the arm held at its angle on the rocker by a second input."""
    shaft = complex(params.shaft_distance, params.shaft_height)
    return Mechanism(
        name="tufting",
        bodies=(
            Body(GROUND, {"O": 0, "C": shaft, "guide": shaft + params.needle_distance}),
            Body("crank", {"O": 0, "A": params.crank}),
            Body("coupler", {"A": 0, "B": params.coupler}),
            Body("rocker", {"C": 0, "B": params.rocker, "shaft": 0}),
            Body("arm", {"shaft": 0, "D": params.arm}),
            Body("rod", {"D": 0, "E": params.rod}),
            Body("needle", {"E": 0, "guide": 0, "F": -1j * params.needle}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "coupler"),
            Pin("B", "coupler", "rocker"),
            Pin("C", GROUND, "rocker"),
            Pin("shaft", "rocker", "arm"),
            Pin("D", "arm", "rod"),
            Pin("E", "rod", "needle"),
            Slide("guide", "needle", GROUND, along=DOWN),
        ),
        inputs=(Rotation("crank", "O"), Rotation("arm", "shaft")),
        branches={"B": +1, "E": +1},
    )


def inertias(params: TuftingParams) -> dict[str, Inertia]:
    """Mass centres in the middle of the links, the needle's in E: it does not turn, so that any point will do."""
    return {
        "crank": Inertia(params.crank_mass, params.crank / 2, params.crank_inertia),
        "coupler": Inertia(params.coupler_mass, params.coupler / 2, params.coupler_inertia),
        "rocker": Inertia(params.rocker_mass, params.rocker / 2, params.rocker_inertia),
        "arm": Inertia(params.arm_mass, params.arm / 2, params.arm_inertia),
        "rod": Inertia(params.rod_mass, params.rod / 2, params.rod_inertia),
        "needle": Inertia(params.needle_mass, 0j, 0.0),
    }


def move(params: TuftingParams, planned: Plan, angle: FloatArray) -> Motion:
    """Motion at the given crank angles [rad]. Raises MechanismError where it does not close."""
    angles: dict[str, RealField] = {"crank": angle, "arm": params.arm_angle}
    return solve(planned, angles, {"crank": params.speed}).require()


def evaluate(
    params: TuftingParams,
    planned: Plan,
    angle: FloatArray,
    side: RealField = 1.0,
    bodies: Mapping[str, Inertia] | None = None,
) -> TuftingState:
    """Motion and forces at crank angles [rad].

    side    which limit counts where the friction jumps, see `Friction`
    bodies  inertias of the links; default: by the masses that the parameters give
    """
    motion = move(params, planned, angle)
    load = friction(params, motion, side)
    forces = inverse(motion, bodies or inertias(params), (Gravity(-1j * params.gravity), load))
    point = _point(motion)
    return TuftingState(
        angle=angle,
        motion=motion,
        forces=forces,
        joints={name: forces.pin(name) for name in (*PINS, "guide", "shaft")},
        main_torque=forces.effort("crank"),
        driven_torque=forces.effort("arm"),
        height=np.imag(point.position) - params.shaft_height,
        velocity=-np.imag(point.velocity),
        acceleration=-np.imag(point.acceleration),
        friction=np.imag(load.force(motion)),
    )


def friction(params: TuftingParams, motion: Motion, side: RealField) -> Friction:
    """The backing's friction on the needle over a motion: from entry to exit, all the time, or by depth."""
    window = None if params.friction == "always" else AngleRange(params.entry, params.exit)
    force: RealField = params.friction_force
    if params.friction == "depth":
        (level,) = _point(move(params, motion.plan, np.array([params.entry]))).position.imag
        point, speed = _point(motion), np.asarray(motion.drives["crank"].speed, dtype=float)
        falling = point.velocity.imag + OFFSET * np.asarray(side) / speed * point.acceleration.imag < 0
        force = params.penetration.force(level - point.position.imag, down=falling)
    return Friction("needle.F", force, "crank", window, side)


def _point(motion: Motion) -> AttachedPoint:
    """The needle's point F."""
    return motion.carried("needle", motion.plan.mechanism.point("needle", "F"))
