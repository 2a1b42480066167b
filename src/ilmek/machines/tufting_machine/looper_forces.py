"""The looper's linkage as a mechanism of the engine, in the axes of the needle drive, with its masses and loads.

    ground Q-P      crank Q-A, driven by the looper shaft     coupler A-B     rocker P-B, with the arm to the hook's tip

Q is beside P towards the main shaft. The rocker carries its shaft, arms, bar and loopers. Held loops
pull the hooks up, with both legs; in cut pile the knives push them near the forward end.
"""

import cmath
import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity, Load, PointForce
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan
from ilmek.machines.link_tree import body_id, link_inertias
from ilmek.machines.linkage_strength import LinkageStrength, linkage_loads, linkage_strength, strength_checks
from ilmek.machines.tufting.params import TuftingParams
from ilmek.machines.tufting_machine.loop import Loop
from ilmek.machines.tufting_machine.looper import LooperDrive, rocker_angle
from ilmek.machines.tufting_machine.looper_parts import (
    BODIES,
    COUPLER,
    CRANK,
    NAME,
    ROCKER,
    LooperParts,
    looper_parts,
)
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.records import computed, group, record
from ilmek.report import Check
from ilmek.units import turn

SAMPLES = 360
CUTTING = 0.8
"""Share of the swing forward from which the knives cut; assumed by this project."""


@record
class LooperForces:
    """A looper drive over a turn of the main shaft, both ends included.

    tip     hook's point in the rocker's frame [m]      angle   of the main shaft [rad]
    torque  on the looper's crank [N m]                 inertia  mean reflected to the looper shaft [kg m²]
    """

    parts: LooperParts
    plan: Plan
    tip: complex
    angle: FloatArray
    motion: Motion
    forces: Forces
    torque: FloatArray
    inertia: float
    strength: LinkageStrength = group("looper_")

    looper_torque_max = computed(
        "N*m", "greatest torque of a looper drive", lambda it: float(np.max(np.abs(it.torque)))
    )

    @computed("N", "greatest force in each pin of a looper drive")
    def looper_pin_force_max(self) -> dict[str, float]:
        return {pin: float(np.max(np.abs(self.forces.pin(pin)))) for pin in "QABP"}

    @property
    def ids(self) -> dict[str, str]:
        """Ids of the parts of its links."""
        return {name: body_id(NAME, name) for name in BODIES}

    @property
    def checks(self) -> tuple[Check, ...]:
        """Links and pins."""
        checks = strength_checks(self.strength, name="looper.strength", drive="the looper crank's", parts=self.ids)
        return tuple(replace(check, name=f"looper: {check.name}") for check in checks)


def looper_pivots(drive: LooperDrive, loop: Loop, needle: TuftingParams, lowest: float) -> tuple[complex, complex]:
    """Crank shaft Q and looper shaft P [m]; lowest: height of the needle's point where it is lowest [m]."""
    params = drive.params
    line = needle.shaft_distance + needle.needle_distance
    across = line - drive.sense * params.arm * math.sin(drive.forward)
    shaft = complex(across, lowest + loop.geometry.hook - params.arm * math.cos(drive.forward))
    return shaft - params.ground, shaft


def looper_mechanism(drive: LooperDrive, crank_shaft: complex, shaft: complex) -> tuple[Mechanism, complex]:
    """The crank-rocker, and the hook's point in the rocker's frame [m]."""
    lengths = drive.lengths
    middle = -rocker_angle(drive.linkage, drive.swing)
    tip = drive.params.arm * cmath.exp(1j * (math.pi / 2 - middle))
    return (
        Mechanism(
            name="looper",
            bodies=(
                Body(GROUND, {"Q": crank_shaft, "P": shaft}),
                Body(CRANK, {"Q": 0, "A": lengths["crank"]}),
                Body(COUPLER, {"A": 0, "B": lengths["coupler"]}),
                Body(ROCKER, {"P": 0, "B": lengths["rocker"], "tip": tip}),
            ),
            joints=(
                Pin("Q", GROUND, CRANK),
                Pin("A", CRANK, COUPLER),
                Pin("B", COUPLER, ROCKER),
                Pin("P", GROUND, ROCKER),
            ),
            inputs=(Rotation(CRANK, "Q"),),
            branches={"B": -1},
        ),
        tip,
    )


def looper_forces(
    params: TuftingMachineParams, carpet: TuftedCarpet, drive: LooperDrive, loop: Loop, lowest: float
) -> LooperForces:
    """Motion, forces and strength of a looper drive; lowest: height of the needle's point where it is lowest [m]."""
    looper, speed = params.looper, params.needle.speed
    mechanism, tip = looper_mechanism(drive, *looper_pivots(drive, loop, params.needle, lowest))
    planned, angle = plan(mechanism), np.linspace(0.0, turn, SAMPLES + 1)
    motion = solve(planned, {CRANK: angle + drive.offset}, {CRANK: speed}).require()
    parts = looper_parts(params, drive, mechanism, carpet.needles)
    bodies = link_inertias(parts.linkage, mechanism, {ROCKER: parts.carried(0)})
    hooks = carpet.needles / params.drives
    held = np.mod(angle - loop.catch, turn) < loop.release - loop.catch
    cutting = (drive.deviation(angle) > CUTTING * drive.swing / 2) & (params.pile == "cut")
    pull = hooks * (2j * looper.loop_tension * held - drive.sense * looper.cut * cutting)
    loads: tuple[Load, ...] = (Gravity(-1j * params.needle.gravity), PointForce((ROCKER, tip), pull))
    forces = inverse(motion, bodies, loads)
    section = looper.link_width, looper.link_thickness
    line = section[0] * section[1] * looper.strength.of_links.density
    found = linkage_loads(
        forces, bodies, loads, {COUPLER: (), ROCKER: ()}, "AB",
        speed=speed, line_mass=line, times=angle / speed,
    )  # fmt: skip
    return LooperForces(
        parts,
        planned,
        tip,
        angle,
        motion,
        forces,
        forces.effort(CRANK),
        reflected_inertia(motion, bodies, speed),
        linkage_strength(
            found,
            looper.limits,
            dict.fromkeys((COUPLER, ROCKER), section),
            name="looper.strength",
        ),
    )


def reflected_inertia(motion: Motion, bodies: dict[str, Inertia], speed: float) -> float:
    """Mean over a motion of the inertia that its crank feels: Σ m v² + J w², over the speed squared [kg m²]."""
    total = np.zeros(len(motion))
    for name, body in bodies.items():
        pace = motion.carried(name, body.centre).velocity
        total = total + body.mass * np.abs(pace) ** 2 + body.moment * motion.omega(name) ** 2
    return float(np.mean(total)) / speed**2
