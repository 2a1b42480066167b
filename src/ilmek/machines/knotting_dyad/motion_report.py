"""What is said of the cycle in time and of its drives: results, checks, a table, figures, warnings."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_dyad.drives import ArmDrives, JointDrive, drives_of
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.motion import CENTRE, LEFT, RIGHT, KnotCycle, cycle_of
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.report import Axis, Check, Column, Figure, Json, Lane, Mark, Plot, Result, Series, Table, Timing, at_most
from ilmek.timing.path_speed.solve import TOLERANCE
from ilmek.units import format_quantity, turn

BALANCE = 1e-9
ARMS = {LEFT: "left arm", RIGHT: "right arm"}


@dataclass(frozen=True, slots=True, eq=False)
class HeadMotion:
    """The cycle of a head, and the drives that it needs."""

    cycle: KnotCycle
    drives: ArmDrives

    @property
    def torque_max(self) -> float:
        """Greatest torque at any joint [N m]."""
        return max(joint.torque_max for joint in self.drives.joints)

    @property
    def power_error(self) -> float:
        """Greatest power residual of the torques, over the powers' size."""
        return max(arm.forces.power_error for arm in self.drives.arms.values())


def head_motion(params: KnottingDyadParams, head: Head) -> HeadMotion:
    """The cycle and the drives of a head."""
    cycle = cycle_of(params, head)
    return HeadMotion(cycle, drives_of(params, head, cycle))


def motion_results(motion: HeadMotion) -> tuple[Result, ...]:
    """The motion's results."""
    cycle, joints = motion.cycle, motion.drives.joints
    parts: list[Json] = [
        {"name": part.name, "start": part.start, "end": part.end, "grippers": list(part.grippers)}
        for part in cycle.parts
    ]
    drives: list[Json] = [_drive(joint) for joint in joints]
    rms, speed = max(joint.torque_rms for joint in joints), max(joint.speed_max for joint in joints)
    # The stronger of two classes, or none where a joint has none.
    servos = [joint.servo for joint in joints]
    strongest = None if None in servos else max((one for one in servos if one), key=lambda servo: servo.power).name
    return (
        Result("cycle_time", cycle.period, "ms", "of a knot, every motion as quick as the limits of the drives allow"),
        Result("torque_max", motion.torque_max, "mN*m", "greatest torque at a joint"),
        Result("torque_rms", rms, "mN*m", "greatest root mean square of the torque at a joint, over the cycle"),
        Result("joint_speed_max", speed, "rad/s", "greatest speed of a joint"),
        Result("servo", strongest, "", "servo class that is enough for every joint"),
        Result("drives", drives, "", "of first and second link, for the worse arm: at the joint and at its servo, SI"),
        Result("cycle", parts, "", "phases and grips, one after the other [s]"),
    )


def motion_checks(motion: HeadMotion) -> tuple[Check, ...]:
    """The motion's checks."""
    used = "greatest use of a drive's limit: speed, acceleration, jerk"
    return (
        at_most(used, motion.cycle.usage, 1 + TOLERANCE, "1", "limits of joints and centre gripper"),
        at_most("power balance of the torques", motion.power_error, BALANCE, "1", "virtual power"),
    )


def motion_warnings(motion: HeadMotion) -> tuple[str, ...]:
    """Joints for which no servo is enough."""
    return tuple(
        f"no servo of the catalogue gives the {joint.joint} {format_quantity(joint.torque_max, 'mN*m')} at "
        f"{format_quantity(joint.speed_max, 'rad/s')}, behind the gears that it may have"
        for joint in motion.drives.joints
        if joint.servo is None
    )


def motion_tables(motion: HeadMotion) -> tuple[Table, ...]:
    """The drives, and the cycle."""
    return _drive_table(motion), _cycle_table(motion)


def motion_figures(motion: HeadMotion) -> tuple[Figure, ...]:
    """Cyclogram, and angles, speeds, the use of the limits and torques over time."""
    return (cyclogram(motion.cycle), *(plot(motion) for plot in (angles, speeds, limits, torques)))


def cyclogram(cycle: KnotCycle) -> Timing:
    """The cycle's phases: arms, centre gripper, and which gripper closes or opens when."""
    time, first = np.unique(cycle.time, return_index=True)
    ways = {LEFT: cycle.arms[LEFT].s, RIGHT: cycle.arms[RIGHT].s, CENTRE: -cycle.centre[0]}
    lanes = []
    for name, way in ways.items():
        share = (way - way.min()) / np.ptp(way)
        grips = tuple(
            Mark(part.start / cycle.period * turn, part.name) for part in cycle.parts if name in part.grippers
        )
        actuator = "two servos" if name in ARMS else "centre drive"
        angle = np.minimum(time / cycle.period * turn, turn)
        lanes.append(Lane(ARMS.get(name, "centre gripper"), actuator, angle, share[first], grips))
    note = "0: in front of the warps, 1: at the hand-over behind them."
    return Timing("knotting-dyad-cycle", "Cycle of a knot", cycle.period, tuple(lanes), note)


def angles(motion: HeadMotion) -> Plot:
    """Turns of both arms' links from where they rest."""
    arms = {name: arm.angle - arm.angle[0] for name, arm in motion.cycle.arms.items()}
    return _plot(motion, "angles", "Turns of the links from rest", Axis("angle", "deg"), _links(arms))


def speeds(motion: HeadMotion) -> Plot:
    """Speeds of both arms' links."""
    arms = {name: arm.speed for name, arm in motion.cycle.arms.items()}
    return _plot(motion, "speeds", "Speeds of the links", Axis("speed", "rad/s"), _links(arms))


def limits(motion: HeadMotion) -> Plot:
    """The greatest use of each of the joints' limits."""
    curves = dict(zip(("speed", "acceleration", "jerk"), motion.cycle.used, strict=True))
    return _plot(motion, "limits", "Use of the joints' limits", Axis("greatest over its limit"), curves)


def torques(motion: HeadMotion) -> Plot:
    """Torques of both arms' drives."""
    arms = {name: arm.torque for name, arm in motion.drives.arms.items()}
    return _plot(motion, "torques", "Torques at the joints", Axis("torque", "mN*m"), _links(arms))


def _links(arms: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    return {f"{said}, link {at + 1}": arms[arm][:, at] for arm, said in ARMS.items() for at in (0, 1)}


def _plot(motion: HeadMotion, name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
    series = tuple(
        Series(said, motion.cycle.time, course, dashed=said.endswith("2")) for said, course in curves.items()
    )
    phases = [part for part in motion.cycle.parts if not part.grippers]
    marks = tuple(Mark(part.start, str(at)) for at, part in enumerate(phases, 1))
    note = f"1 to {len(phases)}: the phases begin."
    return Plot(f"knotting-dyad-{name}", title, Axis("time", "ms"), y, series, marks, note=note)


def _drive(joint: JointDrive) -> dict[str, Json]:
    return {
        "joint": joint.joint,
        "torque_max": joint.torque_max,
        "torque_rms": joint.torque_rms,
        "speed_max": joint.speed_max,
        "power_max": joint.power_max,
        "gear_ratio": joint.reducer.ratio,
        "servo_torque_max": joint.servo_torque_max,
        "servo_torque_rms": joint.servo_torque_rms,
        "servo_speed": joint.servo_speed,
        "servo": joint.servo.name if joint.servo else None,
    }


def _drive_table(motion: HeadMotion) -> Table:
    columns = (
        Column("joint"),
        Column("torque", "mN*m"),
        Column("root mean square", "mN*m"),
        Column("speed", "rad/s"),
        Column("gears"),
        Column("servo's torque", "mN*m"),
        Column("servo"),
    )
    rows = tuple(
        (
            one.joint,
            one.torque_max,
            one.torque_rms,
            one.speed_max,
            one.reducer.ratio,
            one.servo_torque_max,
            one.servo.name if one.servo else "none is enough",
        )
        for one in motion.drives.joints
    )
    return Table("knotting-dyad-drives", "Drives, for the worse arm; servos with their rotors", columns, rows)


def _cycle_table(motion: HeadMotion) -> Table:
    columns = Column("part"), Column("begins", "ms"), Column("takes", "ms"), Column("grippers")
    rows = tuple(
        (part.name, part.start, part.end - part.start, ", ".join(part.grippers)) for part in motion.cycle.parts
    )
    return Table("knotting-dyad-cycle", "The cycle in time", columns, rows)
