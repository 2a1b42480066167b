"""Numbers of a mechanism in motion by sample: for JSON, and as columns of a table. SI and radians, points as [x, y]."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.jobs.mechanism.analysis import Analysis
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.model import Slide
from ilmek.linkage.motion import Status, moving_points
from ilmek.linkage.outputs import Travel, output_history
from ilmek.records import JsonObject
from ilmek.report import Report


def as_json(found: Analysis, report: Report) -> dict[str, object]:
    """The report, and all histories: input, status, bodies, points, slides, transmission angles, forces, powers."""
    run, motion = found.run, found.run.motion
    bodies = {
        body: {"angle": motion.angle(body), "omega": motion.omega(body), "alpha": motion.alpha(body)}
        for body in run.plan.mechanism.moving
    }
    points: dict[str, dict[str, object]] = {}
    for body, point in moving_points(run.plan.mechanism):
        moved = motion.point(body, point)
        rates = {"position": moved.position, "velocity": moved.velocity, "acceleration": moved.acceleration}
        points.setdefault(body, {})[point] = rates
    return {
        **report.as_json(),
        "values": run.values,
        "time": run.time,
        "status": [Status(code).name for code in motion.status],
        "bodies": bodies,
        "points": points,
        "slides": {name: dict(zip(SLIDE, curves, strict=True)) for name, curves in _slides(run).items()},
        "transmission": found.transmission,
        **_force_histories(run),
        **({"forward": _forward(found)} if found.forward is not None else {}),
    }


SLIDE = ("displacement", "velocity", "acceleration")


def _slides(run: MechanismRun) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
    """Displacement, velocity and acceleration of each slide along its guide."""
    slides = (joint.name for joint in run.plan.mechanism.joints if isinstance(joint, Slide))
    moved = {name: output_history(run.motion, Travel(name)) for name in slides}
    return {name: (one.value, one.rate, one.second_rate) for name, one in moved.items()}


def _force_histories(run: MechanismRun) -> JsonObject:
    if run.forces is None:
        return {}
    found, forces = run.forces, run.forces.forces
    joints: dict[str, dict[str, object]] = {name: {"force": force} for name, force in forces.reactions.items()}
    for name, couple in forces.couples.items():
        joints[name]["couple"] = couple
    for name, torque in forces.torques.items():
        joints[name]["torque"] = torque
    for name, friction in forces.frictions.items():
        joints[name]["friction"] = friction
    return {
        "forces": joints,
        "drives": dict(forces.efforts),
        "shaking": {"force": found.shaking.force, "moment": found.shaking.moment},
        "frame": {"force": found.frame.force, "moment": found.frame.moment},
        "power": {
            "input": forces.input_power,
            "loads": forces.load_power,
            "kinetic": forces.kinetic_rate,
            "residual": forces.power_residual,
        },
    }


def _forward(found: Analysis) -> dict[str, object]:
    assert found.forward is not None
    run, forces = found.forward.run, found.forward.forces
    return {
        "time": run.time,
        "position": run.position,
        "speed": run.speed,
        "acceleration": run.acceleration,
        "effort": run.effort,
        "kinetic": run.kinetic,
        "potential": run.potential,
        "drive_work": run.drive_work,
        "load_work": run.load_work,
        "forces": dict(forces.reactions),
    }


def columns(found: Analysis) -> dict[str, FloatArray]:
    """Columns by heading: time, those of `Motion.table` without the fixed inputs, slides, forces, drives, shaking."""
    run = found.run
    fixed = tuple(f"{entry.name} [" for entry in run.plan.mechanism.inputs if _rests(run, entry.name))
    table = {heading: values for heading, values in run.motion.table().items() if not heading.startswith(fixed)}
    if run.time is not None:
        table["time [s]"] = run.time
    for name, curves in _slides(run).items():
        for symbol, unit, values in zip(("s", "v", "a"), ("m", "m/s", "m/s^2"), curves, strict=True):
            table[f"{name} {symbol} [{unit}]"] = values
    for pin, angle in found.transmission.items():
        table[f"{pin} transmission [rad]"] = angle
    return {**table, **_force_columns(run)}


def _rests(run: MechanismRun, name: str) -> bool:
    """Whether an input is fixed over the samples."""
    return run.running is None or (name != run.running.name and np.ptp(run.motion.drives[name].value) == 0)


def _force_columns(run: MechanismRun) -> dict[str, FloatArray]:
    if run.forces is None:
        return {}
    found, forces = run.forces, run.forces.forces
    table = dict(list(forces.table().items())[len(forces.mechanism.inputs) :])  # the inputs stand before
    table["shaking Fx [N]"], table["shaking Fy [N]"] = found.shaking.force.real, found.shaking.force.imag
    table["shaking moment [N*m]"] = found.shaking.moment
    table["frame Fx [N]"], table["frame Fy [N]"] = found.frame.force.real, found.frame.force.imag
    return table
