"""The knotting four-bar as a mechanism of the engine, with masses and loads, and its state at given crank angles.

    ground O1-O1'     crank O1-O2, driven     coupler O2-O2', the hand H on its line     rocker O1'-O2'

O1 is the origin, unless the four-bar is made for poses; all angles are counter-clockwise from x. It has one degree of
freedom: the coupler's angle follows from the crank's. The report chooses both; that is the same as to turn the ground
link until the loop closes, see `closing_ground`. A servo drives the crank through gears.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, Load, PointForce
from ilmek.elements.motors import Motor, Reducer, geared_motor
from ilmek.elements.reducers import RATIOS
from ilmek.errors import ParameterError
from ilmek.linkage.groups import rrr
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.plane.vectors import cross, unit
from ilmek.records import computed, record, result
from ilmek.report import Json
from ilmek.units import format_quantity, turn

PIN_BODIES = {"O1": "crank", "O2": "coupler", "O2'": "coupler", "O1'": "rocker"}
"""Pins, and the body on which their forces are reported."""


@record
class KnottingState:
    """The mechanism at given crank angles, one value a sample.

    pins    pin -> force [N], complex: O1 on the crank, O2 and O2' on the coupler, O1' on the rocker
    torque  drive torque on the crank, counter-clockwise [N m]
    """

    angle: FloatArray
    motion: Motion
    forces: Forces
    pins: Mapping[str, ComplexArray]
    torque: FloatArray

    @property
    def torque_max(self) -> float:
        """Greatest magnitude of the torque [N m]."""
        return float(np.max(np.abs(self.torque)))

    def first_as_json(self) -> dict[str, Json]:
        """The first sample by the report's symbols [SI]: motion of coupler (2) and rocker (3), torque, pin forces."""
        motion, forces = self.motion, {pin: complex(force[0]) for pin, force in self.pins.items()}
        links = {"2": "coupler", "3": "rocker"}
        return {
            **{f"theta{link}": float(motion.angle(body)[0]) % turn for link, body in links.items()},
            **{f"omega{link}": float(motion.omega(body)[0]) for link, body in links.items()},
            **{f"alpha{link}": float(motion.alpha(body)[0]) for link, body in links.items()},
            "drive_torque": float(self.torque[0]),
            "pin_forces": {pin: abs(force) for pin, force in forces.items()},
            "pin_force_vectors": {pin: [force.real, force.imag] for pin, force in forces.items()},
        }


@record
class GearedServo:
    """The drive of the crank: a servo behind gears; None where no servo of the catalogue is enough."""

    reducer: Reducer
    torque: float = result(
        "N*m",
        "torque of the servo, moving or at rest: at crank_angle, with poses or both sides over the motion",
        name="servo_torque",
    )
    speed: float = result("rad/s", "speed of the servo", name="servo_speed")
    servo: Motor | None

    gear_ratio = computed("", "turns of the servo for one of the crank", lambda it: it.reducer.ratio)

    @computed("", "smallest servo that gives both", name="servo")
    def servo_name(self) -> str:
        return self.servo.name if self.servo else "none of the catalogue is enough"


def drive_for(params: KnottingFourBarParams, torque: float) -> GearedServo:
    """The smallest servo and its gears for a torque on the crank [N m], in either direction, at the crank's speed."""
    ratios = RATIOS if params.gear_ratio is None else (params.gear_ratio,)
    reducers = [Reducer(ratio, params.gear_efficiency) for ratio in ratios]
    load, speed = abs(torque), abs(params.speed)
    servo, reducer = geared_motor(load, speed, reducers, "servo") or (None, reducers[0])
    return GearedServo(reducer, reducer.motor_torque(load), speed * reducer.ratio, servo)


def closing_ground(params: KnottingFourBarParams) -> float:
    """Direction [rad] of O1 -> O1' with which the loop closes at the stated crank and coupler angles, on the branch.

    Raises ParameterError where it closes with none, or with both of its two mirror images.
    """
    O2 = params.crank * unit(params.stated_crank_angle)
    far = O2 + params.coupler * unit(params.stated_coupler_angle)
    with np.errstate(invalid="ignore"):
        pivots = [complex(rrr.position(0j, far, params.ground, params.rocker, branch=side)) for side in (+1, -1)]
    if not np.isfinite(pivots).all():
        away, reach = (format_quantity(length, "mm") for length in (float(np.abs(far)), params.ground + params.rocker))
        raise ParameterError(
            f"no ground closes the stated pose: O2' is {away} from O1, ground and rocker reach 0..{reach} and differ "
            f"by {format_quantity(abs(params.ground - params.rocker), 'mm')}",
            do="change stated_crank_angle or stated_coupler_angle, or give ground_angle",
        )
    found = [float(np.angle(at)) for at in pivots if np.sign(cross(at - O2, far - O2)) == params.branch]
    if len(found) != 1:
        angles = " and ".join(format_quantity(float(np.angle(at)), "deg", 8) for at in pivots)
        raise ParameterError(f"the branch does not tell the grounds {angles} apart", do="give one as ground_angle")
    return found[0]


def mechanism(params: KnottingFourBarParams, ground_angle: float, origin: complex = 0j) -> Mechanism:
    """The four-bar with its hand, its pivot O1 at `origin` [m]."""
    return Mechanism(
        name="knotting-four-bar",
        bodies=(
            Body(GROUND, {"O1": origin, "O1'": complex(origin + params.ground * unit(ground_angle))}),
            Body("crank", {"O1": 0, "O2": params.crank}),
            Body("coupler", {"O2": 0, "O2'": params.coupler, "H": params.hand}),
            Body("rocker", {"O1'": 0, "O2'": params.rocker}),
        ),
        joints=(
            Pin("O1", GROUND, "crank"),
            Pin("O2", "crank", "coupler"),
            Pin("O2'", "coupler", "rocker"),
            Pin("O1'", GROUND, "rocker"),
        ),
        inputs=(Rotation("crank", "O1"),),
        branches={"O2'": params.branch},
    )


def loads_of(params: KnottingFourBarParams) -> tuple[Load, ...]:
    """Weight, and the yarn's force on the gripping point."""
    pull = PointForce("coupler.H", params.grip_force * unit(params.grip_angle))
    return Gravity(-1j * params.gravity), pull


def evaluate(  # noqa: PLR0917
    params: KnottingFourBarParams,
    planned: Plan,
    bodies: Mapping[str, Inertia],
    angle: FloatArray,
    speed: float,
    acceleration: float = 0.0,
) -> KnottingState:
    """Motion and forces at the given crank angles [rad], speed [rad/s] and acceleration [rad/s²] of the crank."""
    motion = solve(planned, angle, speed, acceleration).require()
    forces = inverse(motion, bodies, loads_of(params))
    return KnottingState(
        angle=angle,
        motion=motion,
        forces=forces,
        pins={pin: forces.pin(pin, on=body) for pin, body in PIN_BODIES.items()},
        torque=forces.effort("crank"),
    )
