"""The report of a mechanism: structure, mobility, motion; tables, figures, JSON, columns of numbers."""

from collections.abc import Callable, Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import FRAMES, animated
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.mobility import mobility
from ilmek.linkage.model import Rotation, degrees_of_freedom
from ilmek.linkage.motion import Status, moving_points
from ilmek.linkage.solve import solve
from ilmek.report import Axis, Column, Drawing, Figure, Plot, Report, Result, Series, Table
from ilmek.units import turn

CURVES = 4
"""Largest number of curves in a plot."""


def report(run: MechanismRun) -> Report:
    """Structure, mobility and motion of the mechanism."""
    mechanism = run.plan.mechanism
    results = (
        Result("freedoms", degrees_of_freedom(mechanism), "1", "degrees of freedom by count, with the inputs free"),
        Result(
            "mobility",
            _mobility(run),
            "",
            "degrees of freedom by count, and by the rank of all constraints in the first pose that closes",
        ),
        Result("inputs", [entry.name for entry in mechanism.inputs], "", "driving inputs"),
        Result(
            "groups",
            [step.description for step in run.plan.steps],
            "",
            "Assur groups of the mechanism, in the order of solution",
        ),
        Result(
            "closes",
            [list(ends) for ends in run.closing],
            run.unit,
            "ranges of the driving input in which the mechanism closes",
        ),
    )
    return Report(
        machine="mechanism",
        title=run.name,
        parameters={"running": run.running.name if run.running else None, "speed": run.speed},
        results=results if run.running else results[:-1],
        checks=(),
        tables=(_points_table(run), _bodies_table(run)),
        figures=_figures(run),
        warnings=_warnings(run),
    )


def _warnings(run: MechanismRun) -> tuple[str, ...]:
    try:
        run.motion.require()
    except MechanismError as error:
        return (str(error),)
    return ()


def _mobility(run: MechanismRun) -> str:
    first = int(np.flatnonzero(run.motion.status == Status.OK)[0])
    return mobility(run.plan.mechanism, run.motion.pose(first)).description


def _points_table(run: MechanismRun) -> Table:
    columns = (
        *(Column("point"), Column("x from", "mm"), Column("x to", "mm"), Column("y from", "mm"), Column("y to", "mm")),
        *(Column("speed up to", "m/s"), Column("acceleration up to", "m/s^2")),
    )
    points = moving_points(run.plan.mechanism)
    return Table("points", "Points that move", columns, tuple(_point_row(run, *one) for one in points))


def _point_row(run: MechanismRun, body: str, point: str) -> tuple[float | int | str, ...]:
    moved = run.motion.point(body, point)
    ends = [*_ends(np.real(moved.position)), *_ends(np.imag(moved.position))]
    return (f"{point} of {body}", *ends, _ends(np.abs(moved.velocity))[1], _ends(np.abs(moved.acceleration))[1])


def _bodies_table(run: MechanismRun) -> Table:
    columns = (
        *(Column("body"), Column("angle from", "deg"), Column("angle to", "deg")),
        *(Column("speed up to", "rad/s"), Column("acceleration up to", "rad/s^2")),
    )
    return Table("bodies", "Bodies", columns, tuple(_body_row(run, body) for body in run.plan.mechanism.moving))


def _body_row(run: MechanismRun, body: str) -> tuple[float | int | str, ...]:
    omega, alpha = np.abs(run.motion.omega(body)), np.abs(run.motion.alpha(body))
    return (body, *_ends(_angle(run, body)), _ends(omega)[1], _ends(alpha)[1])


def _ends(values: FloatArray) -> tuple[float, float]:
    """Least and greatest of the samples that closed."""
    return float(np.nanmin(values)), float(np.nanmax(values))


def _figures(run: MechanismRun) -> tuple[Figure, ...]:
    """The mechanism in motion over its longest range that closes, and the bodies' angles and speeds."""
    if run.running is None:
        return ()
    x = Axis(run.running.name, run.unit)
    turning = [body for body in run.plan.mechanism.moving if np.nanmax(np.abs(run.motion.omega(body))) > 0]
    curves = (
        ("angles", "Angles of the bodies", Axis("angle", "deg"), _angle),
        ("speeds", "Angular velocities", Axis("angular velocity", "rad/s"), _omega),
    )
    plots = (
        Plot(f"{name}-{start // CURVES + 1}", title, x, y, _series(run, turning[start : start + CURVES], curve))
        for name, title, y, curve in curves
        for start in range(0, len(turning), CURVES)
    )
    return (*_moving(run, x), *plots)


def _moving(run: MechanismRun, drive: Axis) -> Iterator[Figure]:
    """The mechanism in motion, with the paths of its free points."""
    at, travel = _frames(run)
    moved = solve(run.plan, run.at(at), {run.running.name: run.speed} if run.running else {})
    if moved.ok:
        joints = {joint.name for joint in run.plan.mechanism.joints}
        traces = [one for one in moving_points(run.plan.mechanism) if one[1] not in joints]
        period = travel / abs(run.speed) if run.speed else None
        drawn = Drawing("mechanism", f"{run.name} in motion", ())
        yield animated(moved, at, drawn, traces=traces, period=period, drive=drive)


def _frames(run: MechanismRun) -> tuple[FloatArray, float]:
    """Input values of the frames over the longest range that closes, and its length [rad or m]; a full turn is open."""
    one, other = max(run.closing, key=lambda ends: abs(ends[1] - ends[0]))
    first, last = min(one, other), max(one, other)
    whole = isinstance(run.running, Rotation) and abs(last - first - turn) < 1e-9
    return np.linspace(first, last, FRAMES, endpoint=not whole), last - first


def _angle(run: MechanismRun, body: str) -> FloatArray:
    return run.motion.angle(body)


def _omega(run: MechanismRun, body: str) -> FloatArray:
    return run.motion.omega(body)


def _series(
    run: MechanismRun, bodies: list[str], curve: Callable[[MechanismRun, str], FloatArray]
) -> tuple[Series, ...]:
    return tuple(Series(body, run.values, curve(run, body)) for body in bodies)


def as_json(run: MechanismRun) -> dict[str, object]:
    """The report, and the motion of all bodies and points by samples: SI and radians, points as [x, y]."""
    data = report(run).as_json()
    motion = run.motion
    bodies = {
        body: {"angle": _angle(run, body), "omega": motion.omega(body), "alpha": motion.alpha(body)}
        for body in run.plan.mechanism.moving
    }
    points: dict[str, dict[str, object]] = {}
    for body, point in moving_points(run.plan.mechanism):
        moved = motion.point(body, point)
        rates = {"position": moved.position, "velocity": moved.velocity, "acceleration": moved.acceleration}
        points.setdefault(body, {})[point] = rates
    status = [Status(code).name for code in motion.status]
    return {**data, "values": run.values, "status": status, "bodies": bodies, "points": points}


def columns(run: MechanismRun) -> dict[str, FloatArray]:
    """The columns of `Motion.table`, without the fixed inputs."""
    fixed = tuple(f"{entry.name} [" for entry in run.plan.mechanism.inputs if entry is not run.running)
    return {heading: values for heading, values in run.motion.table().items() if not heading.startswith(fixed)}
