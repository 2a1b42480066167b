"""The crank-rocker of a beat-up: its links, its lengths, and its motion and forces at given crank angles."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import AttachedPoint, Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.machines.beat_up.params import BEATER_RATIO, BeatUpParams
from ilmek.records import record
from ilmek.synthesis.crank_rocker.dead_centres import LinkRatios

PINS = ("A", "B", "C", "D")


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


def lengths_of(params: BeatUpParams, links: LinkRatios) -> dict[str, float]:
    """Lengths [m]; given ones stay as given, to the last bit."""
    ratios = {"ground": 1.0, "crank": links.crank, "coupler": links.coupler, "rocker": links.rocker}
    lengths = {name: float(getattr(params, name) or ratio * params.ground) for name, ratio in ratios.items()}
    return {**lengths, "beater": params.beater or BEATER_RATIO * lengths["rocker"]}


def evaluate(params: BeatUpParams, planned: Plan, inertias: Mapping[str, Inertia], angle: FloatArray) -> BeatUpState:
    """Motion and forces at the given crank angles [rad]."""
    return state_of(params, solve(planned, angle, params.speed).require(), inertias, angle)


def state_of(params: BeatUpParams, motion: Motion, inertias: Mapping[str, Inertia], angle: FloatArray) -> BeatUpState:
    """A motion at the crank's speed and crank angles [rad], with its forces."""
    gravity = params.gravity_vector
    forces = inverse(motion, inertias, (Gravity(gravity),))
    beater = motion.carried("rocker", motion.plan.mechanism.point("rocker", "E"))
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
