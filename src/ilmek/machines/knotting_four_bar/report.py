"""What a knotting four-bar's design says: results, checks, tables and figures."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_four_bar import poses_report
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.drive import GearedServo, drive_for
from ilmek.machines.knotting_four_bar.figures import figures
from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.machines.knotting_four_bar.replacement import Replacement
from ilmek.machines.knotting_four_bar.sides_report import said
from ilmek.report import Check, Column, Json, Report, Result, Table, at_least, at_most
from ilmek.units import deg, format_quantity, turn

BALANCE = 1e-9
TRANSMISSION, DISTANCE = 40 * deg, 5 * deg
RULE = "rule of thumb for rockers"


def report(design: KnottingFourBar) -> Report:
    """Everything that the design says."""
    both = said(design)
    return Report(
        machine="knotting-four-bar",
        title="Knotting four-bar",
        parameters=_parameters(design),
        results=(
            *poses_report.results(design),
            *_place(design),
            _at(design),
            *_split(design),
            *_drive(design),
            _mass(design),
            *_instead(design),
            *both.results,
        ),
        checks=(*_checks(design), *poses_report.checks(design), *both.checks),
        tables=(
            *poses_report.tables(design),
            *both.tables,
            _force_table(design),
            _part_table(design),
            *_instead_table(design),
        ),
        figures=figures(design),
        warnings=(*_warnings(design), *both.warnings),
    )


def _parameters(design: KnottingFourBar) -> dict[str, Json]:
    """As asked; the links that follow from poses as they are."""
    found = design.synthesis
    poses: dict[str, Json] = {} if found is None else {"poses": found.poses.text, "ground_angle": found.ground_angle}
    return {**design.params.as_dict(), **poses}


def _place(design: KnottingFourBar) -> tuple[Result, ...]:
    closes = None if design.range is None else list(design.range)
    distance = design.dead_point_distance if design.range else None
    place, least = ("its way", "least on the way") if design.working else ("crank_angle", "there")
    return (
        Result("ground_angle", design.ground_angle, "deg", "direction of the ground link, O1 to O1'"),
        Result("grashof", design.grashof.kind, "", "class of the four-bar"),
        Result("crank_range", closes, "deg", "crank angles between its dead points; none where it turns fully"),
        Result("dead_point_distance", distance, "deg", f"crank's turn from {place} to the nearer dead point"),
        Result("transmission_angle", design.transmission_angle, "deg", f"acute angle of coupler and rocker {least}"),
    )


def _at(design: KnottingFourBar) -> Result:
    motion = design.at.motion
    answer: dict[str, Json] = {
        "theta2": _direction(motion.angle("coupler")),
        "theta3": _direction(motion.angle("rocker")),
        "omega2": _only(motion.omega("coupler")),
        "omega3": _only(motion.omega("rocker")),
        "alpha2": _only(motion.alpha("coupler")),
        "alpha3": _only(motion.alpha("rocker")),
        "drive_torque": _only(design.at.torque),
        "pin_forces": {pin: float(np.abs(force[0])) for pin, force in design.at.pins.items()},
        "pin_force_vectors": _vectors(design.at),
    }
    meaning = (
        "motion of coupler and rocker at crank_angle, torque on the crank, forces in the pins as sizes and as x, y"
    )
    return Result("at", answer, "", f"{meaning} (O1 on the crank, O2 and O2' on the coupler, O1' on the rocker)")


def _only(values: FloatArray) -> float:
    return float(values[0])


def _direction(values: FloatArray) -> float:
    return float(values[0]) % turn


def _vectors(state: KnottingState) -> dict[str, Json]:
    return {pin: [float(force[0].real), float(force[0].imag)] for pin, force in state.pins.items()}


def _split(design: KnottingFourBar) -> tuple[Result, ...]:
    static, dynamic = _torques(design)
    return (
        Result("drive_torque_static", static, "N*m", "torque on the crank at rest, from weight and the yarn's force"),
        Result("drive_torque_dynamic", dynamic, "N*m*s^2", "what each (rad/s)² of the crank's speed adds to it"),
    )


def _torques(design: KnottingFourBar) -> tuple[float, float]:
    static = _only(design.static.torque)
    return static, _only(design.unit.torque) - static


def _drive(design: KnottingFourBar) -> tuple[Result, ...]:
    drive, where = design.drive, "on the way through the poses" if design.working else "at crank_angle"
    if design.sides:
        where = "over all the way, for both sides"
    return (
        Result("servo_torque", drive.torque, "N*m", f"torque of the servo {where}, moving or at rest"),
        Result("servo_speed", drive.speed, "rad/s", "speed of the servo"),
        Result("gear_ratio", drive.reducer.ratio, "", "turns of the servo for one of the crank"),
        Result("servo", _servo(drive), "", "smallest servo that gives both"),
    )


def _servo(drive: GearedServo) -> str:
    return drive.servo.name if drive.servo else "none of the catalogue is enough"


def _mass(design: KnottingFourBar) -> Result:
    answer: dict[str, Json] = {
        name: {"mass": inertia.mass, "centre": complex(inertia.centre).real, "moment": inertia.moment}
        for name, inertia in design.inertias.items()
    }
    meaning = "of each link, SI: mass, mass centre from its first pin, moment of inertia about it; hand on the coupler"
    return Result("masses", answer, "", meaning)


def _instead(design: KnottingFourBar) -> tuple[Result, ...]:
    made = design.instead
    if made is None:
        return ()
    params, drive = made.params, _drive_instead(made)
    answer: dict[str, Json] = {
        "ground": params.ground,
        "crank": params.crank,
        "coupler": params.coupler,
        "rocker": params.rocker,
        "hand": params.hand,
        "ground_angle": params.ground_angle,
        "branch": params.branch,
        "crank_angles": made.crank_angles.tolist(),
        "drive_torques": made.state.torque.tolist(),
        "transmission_angle_min": _least_transmission(made),
        "gear_ratio": drive.reducer.ratio,
        "servo": _servo(drive),
    }
    meaning = (
        "four-bar whose coupler takes the report's three poses: parameters to set; crank and torque at the poses, "
        "gears and servo for the greatest; SI"
    )
    return (Result("instead", answer, "", meaning),)


def _drive_instead(made: Replacement) -> GearedServo:
    """The drive for the greatest torque of the four-bar to use instead at the report's poses."""
    return drive_for(made.params, float(np.max(np.abs(made.state.torque))))


def _least_transmission(made: Replacement) -> float:
    motion = made.state.motion
    return float(np.min(np.arcsin(np.abs(np.sin(motion.angle("coupler") - motion.angle("rocker"))))))


def _checks(design: KnottingFourBar) -> tuple[Check, ...]:
    return (
        at_least("crank's distance from its dead point", design.dead_point_distance, DISTANCE, "deg", "rule of thumb"),
        at_least("transmission angle", design.transmission_angle, TRANSMISSION, "deg", RULE),
        at_most("power balance of the forces", design.at.forces.power_error, BALANCE, "1", "virtual power"),
    )


def _warnings(design: KnottingFourBar) -> tuple[str, ...]:
    return (*_near_dead_point(design), *_too_weak(design))


def _too_weak(design: KnottingFourBar) -> tuple[str, ...]:
    drive = design.drive
    if drive.servo:
        return ()
    torque, speed = format_quantity(drive.torque, "N*m"), format_quantity(drive.speed, "rad/s")
    return (f"no servo of the catalogue gives {torque} at {speed}, behind any of the gears",)


def _near_dead_point(design: KnottingFourBar) -> tuple[str, ...]:
    if design.dead_point_distance >= DISTANCE:
        return ()
    distance = format_quantity(design.dead_point_distance, "deg")
    asked, torque = (
        format_quantity(design.crank_angle, "deg"),
        format_quantity(abs(_only(design.at.torque)), "N*m"),
    )
    instead = design.instead
    if instead is None:
        return (f"on its way through the poses the crank comes within {distance} of a dead point",)
    params = instead.params
    lengths = ", ".join(
        f"{alias} {format_quantity(length, 'mm')}"
        for alias, length in (
            ("r0", params.ground),
            ("r1", params.crank),
            ("r2", params.coupler),
            ("r3", params.rocker),
        )
    )
    greatest = format_quantity(float(np.max(np.abs(instead.state.torque))), "N*m")
    wrong = f"at {asked} the crank is {distance} from its dead point: {torque} move it, coupler and rocker are in line"
    return (f"{wrong}; use the four-bar of both arms instead: {lengths}, at most {greatest} at the report's poses",)


def _force_table(design: KnottingFourBar) -> Table:
    columns = (
        Column("quantity"),
        Column("at rest", digits=7),
        Column("for each (rad/s)²", digits=7),
        Column("as asked"),
    )
    rows: list[tuple[str, float, float, float]] = []
    for pin, force in (("O2'", "F32"), ("O2", "F12")):
        static, moved, asked = (complex(state.pins[pin][0]) for state in (design.static, design.unit, design.at))
        rows += [
            (f"{force}x, on the coupler in {pin} [N]", static.real, moved.real - static.real, asked.real),
            (f"{force}y, on the coupler in {pin} [N]", static.imag, moved.imag - static.imag, asked.imag),
        ]
    rows.append(("M1, on the crank [N·m]", *_torques(design), _only(design.at.torque)))
    return Table(
        "knotting-forces", "Forces at the crank angle: at rest + speed² times the dynamic part", columns, tuple(rows)
    )


def _part_table(design: KnottingFourBar) -> Table:
    columns = (Column("part"), Column("mass", "g"), Column("centre from first pin", "mm"), Column("J about it [g·mm²]"))
    named = {**design.parts, "coupler with holder and gripper": design.inertias["coupler"]}
    rows = tuple(
        (name, inertia.mass, complex(inertia.centre).real, inertia.moment * 1e9) for name, inertia in named.items()
    )
    return Table("knotting-parts", "Masses and moments of inertia", columns, rows)


def _instead_table(design: KnottingFourBar) -> tuple[Table, ...]:
    if design.instead is None:
        return ()
    state = design.instead.state
    columns = (
        Column("pose"),
        Column("crank angle", "deg"),
        Column("coupler angle, O2 to O2'", "deg"),
        Column("rocker angle", "deg"),
        Column("drive torque", "N*m"),
    )
    coupler, rocker = (np.mod(state.motion.angle(body), turn) for body in ("coupler", "rocker"))
    rows = tuple(
        (at + 1, float(state.angle[at]), float(coupler[at]), float(rocker[at]), float(state.torque[at]))
        for at in range(3)
    )
    return (Table("knotting-instead", "The four-bar of both arms at the report's poses", columns, rows),)
