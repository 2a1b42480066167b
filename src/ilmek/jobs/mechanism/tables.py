"""Tables of a mechanism in motion: points, bodies, slides, forces of joints, transmission angles, events."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ilmek.dynamics.inverse_run import greatest
from ilmek.dynamics.machine_strength import MachineStrength
from ilmek.dynamics.speed_study import StudyOfSpeeds
from ilmek.jobs.mechanism.analysis import Analysis
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.model import Pin, Slide
from ilmek.linkage.motion import moving_points
from ilmek.linkage.outputs import Travel, output_history
from ilmek.linkage.status import Status
from ilmek.report import Column, Table, columns
from ilmek.units import turn

if TYPE_CHECKING:
    from ilmek.dynamics.own_forward import OwnForward

ROUNDING = 1e-12
"""Component of a force or position, relative to its greatest magnitude, that counts as rounding."""

Row = tuple[float | int | str, ...]


def tables(found: Analysis) -> tuple[Table, ...]:
    """The tables of a mechanism in motion, those of its forces first."""
    return tuple(table for table in _tables(found) if table.rows)


def _tables(found: Analysis) -> Iterator[Table]:
    run = found.run
    if run.forces is not None:
        yield _forces_table(run)
        yield _drives_table(run)
    if found.strength is not None:
        yield _links_table(found.strength)
        yield _pins_table(found.strength)
    if found.study is not None:
        yield _study_table(found.study)
    yield _transmission_table(found)
    yield _slides_table(run)
    yield _points_table(run)
    yield _bodies_table(run)
    if found.forward is not None:
        yield _events_table(found.forward)


def _links_table(strength: MachineStrength) -> Table:
    heads = columns("link", "stress up to [MPa]", "between", "at [mm]", "fatigue safety", "buckling safety")
    rows = []
    for name, one in strength.links.items():
        start, end, at = one.position
        values = (one.stress, f"{start} and {end}", at, one.fatigue, one.buckling, one.frequency / turn)
        rows.append((name, *values))
    return Table("links", "Strength of links", (*heads, *columns("natural frequency [Hz]")), tuple(rows), brief=True)


def _pins_table(strength: MachineStrength) -> Table:
    heads = columns("pin | force up to [N] | shear [MPa] | bending [MPa] | pressure [MPa] | pressure x speed [MPa*m/s]")
    rows = tuple(
        (name, one.force, one.shear, one.bending, one.pressure, one.wear, strength.lives.get(name, ""))
        for name, one in strength.pins.items()
    )
    return Table("pins", "Strength of pins", (*heads, *columns("bearing life [h]")), rows, brief=True)


def _study_table(study: StudyOfSpeeds) -> Table:
    speed, effort = ("rpm", "N*m") if study.turning else ("m/s", "N")
    heads = columns(
        f"speed [{speed}]", f"drive up to [{effort}]", "pin", "pin force up to [N]", "shaking force up to [N]"
    )
    rows = []
    for point in study.points:
        pin, force = point.pin_force
        check, least = point.least_margin
        row = (point.speed, point.run.peak or 0.0, pin, force, point.run.shaking_force_max)
        rows.append((*row, least if check else "", check))
    return Table("study", "Study of speeds", (*heads, *columns("least margin", "of")), tuple(rows), brief=True)


def _events_table(forward: "OwnForward") -> Table:
    position, speed = ("deg", "rpm") if forward.turning else ("mm", "m/s")
    heads = columns("event", "time [s]", f"position [{position}]", f"speed [{speed}]")
    events = forward.run.events
    rows = tuple((one.name, one.time, float(one.state.position), float(one.state.speed)) for one in events)
    return Table("events", "Events of the forward run", heads, rows, brief=True)


def _forces_table(run: MechanismRun) -> Table:
    """Greatest force of each joint, where it occurs, and the range of its components."""
    heads = (
        *columns("joint", "of", "force up to [N]"),
        Column("at", "s" if run.by_time else run.unit),
        *columns("Fx from [N]", "Fx to [N]", "Fy from [N]", "Fy to [N]", "couple up to [N*m]"),
    )
    return Table("forces", "Forces of joints and teeth", heads, tuple(_force_rows(run)), brief=True)


def _force_rows(run: MechanismRun) -> Iterator[Row]:
    assert run.forces is not None
    forces = run.forces.forces
    mechanism = run.plan.mechanism
    for one in (*mechanism.joints, *mechanism.couplings):
        force = forces.reactions[one.name]
        level = ROUNDING * greatest(force)
        kind = "pin" if isinstance(one, Pin) else "slide" if isinstance(one, Slide) else one.kind
        couple: float | str = greatest(forces.couples[one.name]) if one.name in forces.couples else ""
        on = one.bodies[1] if not isinstance(one, Slide) else one.body
        name = f"{one.name} ({kind})"
        if one.name in forces.undetermined.names:
            couple = greatest(forces.torques[one.name]) if one.name in forces.torques else ""
            yield name, f"on {on}", "not determined", "", "", "", "", "", couple
            continue
        if one.name in forces.undetermined.couples:
            couple = "not determined"
        yield (
            name,
            f"on {on}",
            greatest(force),
            *_where(run, force),
            *_ends(force.real, level),
            *_ends(force.imag, level),
            couple,
        )


def _where(run: MechanismRun, values: np.ndarray) -> tuple[float | str]:
    """Value of the abscissa at the greatest magnitude."""
    size = np.abs(values)
    if run.running is None or not np.isfinite(size).any():
        return ("",)
    return (float(run.abscissa[int(np.nanargmax(size))]),)


def _drives_table(run: MechanismRun) -> Table:
    """Efforts of the inputs where there are several, or of the actuators."""
    assert run.forces is not None
    heads = columns("drive", "effort from", "effort to", "unit")
    efforts = run.forces.forces.efforts
    turning = run.forces.forces.turning
    rows = tuple((name, *_ends(effort), "N*m" if turning(name) else "N") for name, effort in efforts.items())
    shown = rows if len(rows) > 1 or run.machine.actuators else ()
    return Table("drives", "Efforts of the drives", heads, shown, brief=True)


def _transmission_table(found: Analysis) -> Table:
    heads = (
        *columns("pin", "least [deg]"),
        Column("at", "s" if found.run.by_time else found.run.unit),
        Column("greatest", "deg"),
    )
    rows = []
    for pin, angle in found.transmission.items():  # at a dead centre it is 0
        least, most = _ends(angle)
        moves = found.run.running is not None and np.isfinite(angle).any()
        rows.append((pin, least, float(found.run.abscissa[int(np.nanargmin(angle))]) if moves else "", most))
    return Table("transmission", "Transmission angles", heads, tuple(rows), brief=True)


def _slides_table(run: MechanismRun) -> Table:
    heads = columns("slide", "from [mm]", "to [mm]", "speed up to [m/s]", "acceleration up to [m/s^2]")
    rows = []
    for joint in run.plan.mechanism.joints:
        if isinstance(joint, Slide):
            moved = output_history(run.motion, Travel(joint.name))
            rows.append((joint.name, *_ends(moved.value), greatest(moved.rate), greatest(moved.second_rate)))
    return Table("slides", "Slides, along their guides", heads, tuple(rows), brief=True)


def _points_table(run: MechanismRun) -> Table:
    heads = columns("point", "x from [mm]", "x to [mm]", "y from [mm]", "y to [mm]", "speed up to [m/s]")
    heads = (*heads, Column("acceleration up to", "m/s^2"))
    rows: list[Row] = []
    open_samples = run.motion.status != Status.OK
    for body, point in moving_points(run.plan.mechanism):
        moved = run.motion.point(body, point)
        fields = (moved.position, moved.velocity, moved.acceleration)
        at, velocity, acceleration = (np.where(open_samples, np.nan, field) for field in fields)
        level = ROUNDING * greatest(at)
        ends = (*_ends(at.real, level), *_ends(at.imag, level))
        rows.append((f"{point} of {body}", *ends, greatest(velocity), greatest(acceleration)))
    return Table("points", "Points that move", heads, tuple(rows), brief=True)


def _bodies_table(run: MechanismRun) -> Table:
    heads = columns("body", "angle from [deg]", "angle to [deg]", "speed up to [rad/s]")
    heads = (*heads, Column("acceleration up to", "rad/s^2"))
    motion, open_samples = run.motion, run.motion.status != Status.OK
    rows = []
    for body in run.plan.mechanism.moving:
        fields = (motion.angle(body), motion.omega(body), motion.alpha(body))
        angle, omega, alpha = (np.where(open_samples, np.nan, field) for field in fields)
        rows.append((body, *_ends(angle), greatest(omega), greatest(alpha)))
    return Table("bodies", "Bodies", heads, tuple(rows), brief=True)


def _ends(values: np.ndarray, rounding: float = 0.0) -> tuple[float, float]:
    """Least and greatest of the finite samples, 0 where they are below the rounding; NaN without any."""
    usable = values[np.isfinite(values)]
    ends = (float(usable.min()), float(usable.max())) if usable.size else (float("nan"), float("nan"))
    least, most = (0.0 if abs(end) <= rounding else end for end in ends)
    return least, most
