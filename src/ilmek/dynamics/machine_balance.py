"""Counterweight on the crank and flywheel of any mechanism that a crank on the ground drives at constant speed.

    F + U omega² e^{i theta},   |...| = |F e^{-i theta} + U omega²|

The greatest shaking force over a turn is least where -U omega² is the centre of the smallest circle around the points
F e^{-i theta}, its radius is that force: no other counterweight on the crank leaves less. The flywheel limits the
fluctuation of the speed by the excess work of the drive's torque over a turn [`flywheel`].
"""

import cmath

import numpy as np

from ilmek.dynamics.flywheel import flywheel
from ilmek.dynamics.inverse_run import InverseRun
from ilmek.errors import MechanismError
from ilmek.linkage.joints import GROUND, Pin
from ilmek.linkage.model import Rotation
from ilmek.linkage.status import Status
from ilmek.plane.enclosing_circle import enclosing_circle
from ilmek.plane.vectors import cross
from ilmek.records import record, result
from ilmek.units import turn


@record
class MachineBalance:
    """The best counterweight on the crank, and the flywheel for a fluctuation of the speed."""

    counterweight_moment: float = result("", "static moment of the best counterweight on the crank (kg m)")
    counterweight_angle: float = result("deg", "its direction in the frame of the crank")
    shaking_force_max_balanced: float = result("N", "greatest shaking force with it")
    shaking_moment_max_balanced: float = result("N*m", "greatest shaking moment about the ground's origin with it")
    work_excess: float = result("J", "excess work of the drive's torque over a turn")
    flywheel_inertia: float = result("kg*m^2", "moment of inertia on the crank that keeps the fluctuation of its speed")


def machine_balance(run: InverseRun, speed: float, fluctuation: float) -> MachineBalance:
    """The balance of a machine over a turn of its crank at constant speed [rad/s].

    run          forces over one turn, its end among the samples
    fluctuation  (omega_max - omega_min) / omega of the flywheel's shaft [1]
    The counterweight turns about a pin on the ground, so that it does not change the drive's torque but by its weight,
    which is left out. Raises MechanismError where no crank on the ground turns once, closing everywhere.
    """
    motion = run.forces.motion
    mechanism = run.forces.mechanism
    crank = next((one for one in mechanism.inputs if one.name == run.driving), None)
    pins = {joint.name: joint for joint in mechanism.joints if isinstance(joint, Pin)}
    if not isinstance(crank, Rotation) or GROUND not in pins[crank.about].bodies:
        raise MechanismError("balance without a crank on the ground that drives", do="balance one that a crank drives")
    angle = motion.angle(crank.body)
    if (motion.status != Status.OK).any() or abs(abs(angle[-1] - angle[0]) - turn) > 1e-9 or run.effort is None:
        raise MechanismError(
            f"balance over {abs(angle[-1] - angle[0]) / turn:.3g} turns of {crank.name}",
            allowed="one whole turn, over which the mechanism closes",
        )
    centre, radius = enclosing_circle(run.shaking.force * np.exp(-1j * angle))
    pivot = motion.point(crank.body, crank.about).position
    added = -centre * np.exp(1j * angle)
    moment = run.shaking.moment + cross(pivot, added)
    effort, turned = np.abs(angle - angle[0]), run.effort * np.sign(speed)
    work = np.concatenate([[0.0], np.cumsum((turned[1:] + turned[:-1]) / 2 * np.diff(effort))])
    excess = float(np.ptp(work - effort / turn * work[-1]))
    return MachineBalance(
        abs(centre) / speed**2,
        cmath.phase(-centre) % turn,
        radius,
        float(np.abs(moment).max()),
        excess,
        flywheel(excess, speed, fluctuation),
    )
