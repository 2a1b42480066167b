"""A crank-rocker of the loopers or of the knives as a mechanism of the engine, with its masses and loads.

The rocker carries its shaft, arms, bar, and loopers or knives. Held loops pull the hooks up, with both legs; a knife
presses the loop that it cuts against its hook.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, Load
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.link_tree import body_id, link_inertias
from ilmek.machines.linkage_strength import LinkageStrength, linkage_loads, linkage_strength, strength_checks
from ilmek.machines.tufting.params import TuftingParams
from ilmek.machines.tufting_machine.params import LooperParams
from ilmek.machines.tufting_machine.rocker_drive import TIP, RockerDrive
from ilmek.machines.tufting_machine.rocker_parts import NAME, RockerParts
from ilmek.part.tree import Occurrence
from ilmek.records import computed, group, record
from ilmek.report import Check
from ilmek.units import turn

SAMPLES = 360


class CarriedParts(Protocol):
    """The parts of a drive, and what its rocker carries."""

    @property
    def rocker(self) -> RockerParts:
        """What all drives have."""

    def carried(self, number: int) -> tuple[Occurrence, ...]:
        """What the rocker of a drive, counted from 0, carries in its frame."""


@record
class RockerMotion:
    """A drive over a turn of the main shaft, both ends included.

    shaft  P [m]      plan  of its mechanism      angle  of the main shaft [rad]
    """

    drive: RockerDrive
    shaft: complex
    plan: Plan
    angle: FloatArray
    motion: Motion

    def moved(self, angle: FloatArray, speed: float = 1.0) -> Motion:
        """Its motion at crank angles of the main shaft [rad]."""
        crank = self.drive.bodies[0]
        return solve(self.plan, {crank: self.drive.crank(angle)}, {crank: speed}).require()

    @property
    def crank_shaft(self) -> complex:
        """Q [m]."""
        return complex(self.plan.mechanism.body(GROUND).points["Q"])

    @property
    def tip(self) -> complex:
        """The working point in the rocker's frame [m]."""
        return complex(self.plan.mechanism.body(self.drive.bodies[2]).points[TIP])


def rocker_motion(drive: RockerDrive, shaft: complex, tip: complex, speed: float) -> RockerMotion:
    """The motion of a drive about a shaft, with its working point from there [m], at a speed [rad/s]."""
    planned, angle = plan(drive.mechanism(shaft, tip)), np.linspace(0.0, turn, SAMPLES + 1)
    crank = drive.bodies[0]
    motion = solve(planned, {crank: drive.crank(angle)}, {crank: speed}).require()
    return RockerMotion(drive, shaft, planned, angle, motion)


@record
class RockerForces:
    """The forces of a drive.

    torque  on the crank [N m]      inertia  mean reflected to the crank shaft [kg m²]
    """

    moves: RockerMotion
    parts: CarriedParts
    forces: Forces
    torque: FloatArray
    inertia: float
    strength: LinkageStrength = group()

    torque_max = computed("N*m", "greatest torque of a drive", lambda it: float(np.max(np.abs(it.torque))))

    @computed("N", "greatest force in each pin of a drive")
    def pin_force_max(self) -> dict[str, float]:
        return {pin: float(np.max(np.abs(self.forces.pin(pin)))) for pin in "QABP"}

    @property
    def checks(self) -> tuple[Check, ...]:
        """Links and pins."""
        name = self.moves.drive.name
        ids = {body: body_id(NAME, body) for body in self.moves.drive.bodies}
        checks = strength_checks(self.strength, name="looper.strength", drive="the looper crank's", parts=ids)
        return tuple(replace(check, name=f"{name}: {check.name}") for check in checks)


def rocker_forces(
    moves: RockerMotion, parts: CarriedParts, pulls: Sequence[Load], params: LooperParams, needle: TuftingParams
) -> RockerForces:
    """Forces and strength of a drive under pulls over the turn, at gravity and speed of the needle drive."""
    speed = needle.speed
    crank, coupler, rocker = moves.drive.bodies
    mechanism, motion = moves.plan.mechanism, moves.motion
    bodies = link_inertias(parts.rocker.linkage, mechanism, {rocker: parts.carried(0)})
    loads: tuple[Load, ...] = (Gravity(-1j * needle.gravity), *pulls)
    forces = inverse(motion, bodies, loads)
    section = params.link_width, params.link_thickness
    line = section[0] * section[1] * params.strength.of_links.density
    found = linkage_loads(
        forces, bodies, loads, {coupler: (), rocker: ()}, "AB",
        speed=speed, line_mass=line, times=moves.angle / speed,
    )  # fmt: skip
    sections = dict.fromkeys((coupler, rocker), section)
    strength = linkage_strength(found, params.limits, sections, name="looper.strength")
    return RockerForces(moves, parts, forces, forces.effort(crank), reflected_inertia(motion, bodies, speed), strength)


def reflected_inertia(motion: Motion, bodies: dict[str, Inertia], speed: float) -> float:
    """Mean over a motion of the inertia that its crank feels: Σ m v² + J w², over the speed squared [kg m²]."""
    total = np.zeros(len(motion))
    for name, body in bodies.items():
        pace = motion.carried(name, body.centre).velocity
        total = total + body.mass * np.abs(pace) ** 2 + body.moment * motion.omega(name) ** 2
    return float(np.mean(total)) / speed**2
