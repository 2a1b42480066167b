"""The knotting four-bar as a mechanism of the engine, with masses and loads, and its state at given crank angles.

    ground O1-O1'     crank O1-O2, driven     coupler O2-O2', the hand H on its line     rocker O1'-O2'

O1 is the origin, unless the four-bar is made for poses; all angles are counter-clockwise from x. One freedom: the
coupler's angle follows from the crank's.
The report chooses both; that is the same as to turn the ground link until the loop closes, see `closing_ground`.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.inertia import Inertia, bar, bar_mass, bar_moment, combined
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, PointForce
from ilmek.errors import ParameterError
from ilmek.linkage.groups import rrr
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.plane.vectors import cross, unit
from ilmek.units import format_quantity

PINS = ("O1", "O2", "O2'", "O1'")


@dataclass(frozen=True, slots=True)
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


def parts(params: KnottingFourBarParams) -> dict[str, Inertia]:
    """The bars of the links, and holder and gripper beyond the coupler's end on the hand's side."""
    near, far = min(0.0, params.hand), max(params.coupler, params.hand)
    end, outward = (far, 1) if params.hand > 0 else (near, -1)
    holder = end + outward * params.holder_length / 2
    gripper = end + outward * (params.holder_length + params.gripper_length / 2)
    return {
        "crank": _bar(params, 0.0, params.crank),
        "coupler bar": _bar(params, near, far),
        "holder": _block(params, holder, params.holder_length, params.holder_width),
        "gripper": _block(params, gripper, params.gripper_length, params.gripper_width),
        "rocker": _bar(params, 0.0, params.rocker),
    }


def inertias(params: KnottingFourBarParams) -> dict[str, Inertia]:
    """The moving bodies; coupler, holder and gripper are one."""
    made = parts(params)
    hand = combined(made["coupler bar"], made["holder"], made["gripper"])
    return {"crank": made["crank"], "coupler": hand, "rocker": made["rocker"]}


def _bar(params: KnottingFourBarParams, start: float, end: float) -> Inertia:
    mass = float(bar_mass(end - start, params.width, params.thickness, params.density))
    return bar(start, end, mass=mass, width=params.width)


def _block(params: KnottingFourBarParams, middle: float, length: float, width: float) -> Inertia:
    mass = float(bar_mass(length, width, params.thickness, params.density))
    return Inertia(mass, complex(middle), float(bar_moment(mass, length, width)))


def evaluate(
    params: KnottingFourBarParams, planned: Plan, angle: FloatArray, speed: float, acceleration: float = 0.0
) -> KnottingState:
    """Motion and forces at the given crank angles [rad], speed [rad/s] and acceleration [rad/s²] of the crank."""
    motion = solve(planned, angle, speed, acceleration).require()
    pull = PointForce("coupler", "H", params.grip_force * unit(params.grip_angle))
    forces = inverse(motion, inertias(params), (Gravity(-1j * params.gravity), pull))
    on = {"O1": "crank", "O2": "coupler", "O2'": "coupler", "O1'": "rocker"}
    return KnottingState(
        angle=angle,
        motion=motion,
        forces=forces,
        pins={pin: forces.pin(pin, on=body) for pin, body in on.items()},
        torque=forces.effort("crank"),
    )
