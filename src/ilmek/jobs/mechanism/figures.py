"""Figures of a mechanism: in motion; angles, speeds, slides; forces of joints and drive; forward run."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import FRAMES, animated
from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.speed_study import StudyOfSpeeds
from ilmek.jobs.mechanism.analysis import Analysis
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.model import GROUND, Pin, Rotation, Slide
from ilmek.linkage.motion import free_points
from ilmek.linkage.outputs import Travel, output_history
from ilmek.linkage.solve import solve
from ilmek.report import Axis, Drawing, Figure, Plot, Series
from ilmek.units import format_quantity, turn

if TYPE_CHECKING:
    from ilmek.dynamics.own_forward import OwnForward

CURVES = 4
"""Largest number of curves in a plot."""

BESIDE = 1e-6
"""Distance of the first and the last frame from a dead centre, relative to the range."""


def figures(found: Analysis) -> tuple[Figure, ...]:
    """The mechanism in motion over its longest range that closes, and curves over the driving input."""
    run = found.run
    if run.running is None:
        return ()
    x = Axis("time", "s") if run.by_time else Axis(run.running.name, run.unit)
    forces = _force_plots(run, run.forces, x) if run.forces is not None else ()
    forward = _forward_plots(found.forward) if found.forward is not None else ()
    study = _study_plots(found.study) if found.study is not None else ()
    return (*_moving(run, x), *study, *forces, *_transmission_plots(found, x), *_motion_plots(run, x), *forward)


def traced_points(run: MechanismRun) -> list[tuple[str, str]]:
    """Bodies and points whose paths are drawn: those of the file, or all points that are no joints."""
    return list(run.machine.paths or free_points(run.plan.mechanism))


def _moving(run: MechanismRun, drive: Axis) -> Iterator[Figure]:
    """The mechanism in motion, with the paths of its free points."""
    drawn = Drawing("mechanism", f"{run.name} in motion", ())
    if run.by_time:
        yield from _moving_over_time(run, drawn)
        return
    at, travel = _frames(run)
    speed = run.speed or 0.0
    moved = solve(run.plan, run.at(at), {run.running.name: speed} if run.running else {})
    if moved.ok:
        period = travel / abs(speed) if speed else None
        yield animated(moved, at, drawn, traces=traced_points(run), period=period, drive=drive)


def _moving_over_time(run: MechanismRun, drawn: Drawing) -> Iterator[Figure]:
    """The mechanism over the period of its given motion; to and fro where the motion ends."""
    assert run.time is not None
    assert run.running is not None
    if run.motion.ok:
        law = run.machine.motions[run.running.name]
        picked = np.linspace(0, len(run.time) - 1, FRAMES + 1).round().astype(int)[: FRAMES + (law.period is None)]
        at = np.linspace(run.time[0], run.time[-1], FRAMES + 1)[: len(picked)]
        drives = {
            name: np.broadcast_to(drive.value, run.time.shape)[picked] for name, drive in run.motion.drives.items()
        }
        moved = solve(run.plan, drives)
        period = float(run.time[-1] - run.time[0])
        closes = law.period is not None
        traces = traced_points(run)
        yield animated(moved, at, drawn, traces=traces, period=period, drive=Axis("time", "s"), closes=closes)


def _frames(run: MechanismRun) -> tuple[FloatArray, float]:
    """Input values of the frames over the longest range that closes, and its length [rad or m]; a full turn is open.

    The frames begin and end next to a dead centre, not at it, where velocities have no bound.
    """
    one, other = max(run.closing, key=lambda ends: abs(ends[1] - ends[0]))
    first, last = min(one, other), max(one, other)
    dead = {value for value, _ in run.closed.dead_centres} if run.closed else set()
    aside = BESIDE * (last - first)
    first, last = first + aside * (first in dead), last - aside * (last in dead)
    whole = isinstance(run.running, Rotation) and abs(last - first - turn) < 1e-9
    return np.linspace(first, last, FRAMES, endpoint=not whole), last - first


def _force_plots(run: MechanismRun, forces: InverseRun, x: Axis) -> Iterator[Figure]:
    """Drive effort, joint forces over the input, forces on the frame's pins as hodographs, shaking force and moment."""
    at = run.abscissa
    if forces.effort is not None:
        unit = "N*m" if forces.turning else "N"
        noun = "torque" if forces.turning else "force"
        level = (forces.drive_torque_mean if forces.turning else forces.drive_force_mean) or 0.0
        mean = Series(f"mean, {format_quantity(level, unit)}", at[[0, -1]], np.array([level, level]), dashed=True)
        curves = (Series(noun, at, forces.effort), mean)
        yield Plot("drive", f"Drive {noun} on {forces.driver}", x, Axis(noun, unit), curves)
    mechanism = run.plan.mechanism
    sizes = {one.name: np.abs(forces.forces.reactions[one.name]) for one in (*mechanism.joints, *mechanism.couplings)}
    yield from _groups("forces", "Forces of joints", x, Axis("force", "N"), at, sizes)
    pivots = [joint for joint in mechanism.joints if isinstance(joint, Pin) and GROUND in joint.bodies]
    loads = {pivot.name: forces.forces.pin(pivot.name, GROUND) for pivot in pivots}
    yield from _hodographs("frame-pins", "Forces on the frame at its pins", loads)
    if run.machine.inertias:
        yield from _hodographs("shaking", "Shaking force on the frame", {"shaking force": forces.shaking.force})
        moment = {"shaking moment": forces.shaking.moment}
        yield from _groups("shaking-moment", "Shaking moment about the origin", x, Axis("moment", "N*m"), at, moment)


def _transmission_plots(found: Analysis, x: Axis) -> Iterator[Figure]:
    y = Axis("transmission angle", "deg")
    yield from _groups("transmission", "Transmission angles", x, y, found.run.abscissa, found.transmission)


def _motion_plots(run: MechanismRun, x: Axis) -> Iterator[Figure]:
    """Slides' displacement, speed and acceleration; the bodies' angles, angular velocities and accelerations."""
    at, motion = run.abscissa, run.motion
    slides = [joint.name for joint in run.plan.mechanism.joints if isinstance(joint, Slide)]
    moved = {name: output_history(motion, Travel(name)) for name in slides}
    for name, title, y, field in (
        ("slide", "Displacement of slides", Axis("displacement", "mm"), "value"),
        ("slide-speed", "Speed of slides", Axis("speed", "m/s"), "rate"),
        ("slide-acceleration", "Acceleration of slides", Axis("acceleration", "m/s^2"), "second_rate"),
    ):
        yield from _groups(name, title, x, y, at, {slide: getattr(one, field) for slide, one in moved.items()})
    points = {f"{point} of {body}": np.abs(motion.point(body, point).velocity) for body, point in traced_points(run)}
    yield from _groups("point-speeds", "Speeds of points", x, Axis("speed", "m/s"), at, points)
    turning = [body for body in run.plan.mechanism.moving if np.nanmax(np.abs(motion.omega(body)), initial=0) > 0]
    for name, title, y, curve in (
        ("angles", "Angles of the bodies", Axis("angle", "deg"), motion.angle),
        ("speeds", "Angular velocities", Axis("angular velocity", "rad/s"), motion.omega),
        ("accelerations", "Angular accelerations", Axis("angular acceleration", "rad/s^2"), motion.alpha),
    ):
        yield from _groups(name, title, x, y, at, {body: curve(body) for body in turning})


def _study_plots(study: StudyOfSpeeds) -> Iterator[Figure]:
    """Greatest drive effort, pin forces and shaking force against the speed; least margin of the checks."""
    unit, effort = ("rpm", "N*m") if study.turning else ("m/s", "N")
    x, at = Axis("speed", unit), np.array([point.speed for point in study.points])
    peaks = np.array([point.run.peak or 0.0 for point in study.points])
    yield Plot(
        "study-drive", "Greatest effort of the drive by speed", x, Axis("effort", effort), (Series("drive", at, peaks),)
    )
    runs = [point.run for point in study.points]
    forces = {name: np.array([run.pin_forces_max[name] for run in runs]) for name in runs[0].pin_forces_max}
    forces["shaking force"] = np.array([run.shaking_force_max for run in runs])
    yield from _groups("study-forces", "Greatest forces by speed", x, Axis("force", "N"), at, forces)
    margins = np.array([point.least_margin[1] for point in study.points])
    if np.isfinite(margins).all():
        limit = Series("limit", at[[0, -1]], np.ones(2), dashed=True)
        curves = (Series("least margin", at, margins), limit)
        yield Plot("study-margin", "Least margin of the checks by speed", x, Axis("margin", "1"), curves)


def _forward_plots(forward: "OwnForward") -> Iterator[Figure]:
    """Speed of the input, effort of the drive and joint forces over time."""
    run = forward.run
    time = Axis("time", "s")
    speed, effort = ("rpm", "N*m") if forward.turning else ("m/s", "N")
    entry = forward.forces.mechanism.inputs[0].name
    yield from _groups("forward-speed", "Forward run: speed", time, Axis("speed", speed), run.time, {entry: run.speed})
    drive = {"drive": run.effort}
    yield from _groups("forward-drive", "Forward run: drive", time, Axis("effort", effort), run.time, drive)
    pins = {name: np.abs(force) for name, force in forward.forces.reactions.items()}
    yield from _groups("forward-forces", "Forward run: forces of joints", time, Axis("force", "N"), run.time, pins)


def _groups(  # noqa: PLR0917 - two axes, the abscissae, the curves
    name: str, title: str, x: Axis, y: Axis, at: FloatArray, curves: Mapping[str, FloatArray]
) -> Iterator[Plot]:
    """Plots of at most `CURVES` curves each."""
    series = [Series(label, at, values) for label, values in curves.items() if np.isfinite(values).any()]
    for start in range(0, len(series), CURVES):
        number = start // CURVES + 1
        yield Plot(f"{name}-{number}", title, x, y, tuple(series[start : start + CURVES]))


def _hodographs(name: str, title: str, forces: Mapping[str, np.ndarray]) -> Iterator[Plot]:
    """Ends of force vectors over the run, Fy over Fx."""
    series = [Series(label, force.real, force.imag) for label, force in forces.items() if np.isfinite(force).any()]
    for start in range(0, len(series), CURVES):
        x, y = Axis("Fx", "N"), Axis("Fy", "N")
        yield Plot(f"{name}-{start // CURVES + 1}", title, x, y, tuple(series[start : start + CURVES]))
