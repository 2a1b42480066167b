"""What a beat-up design says: results, checks against the paper's criteria, tables and figures."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.beat_up.design import PINS, BeatUp
from ilmek.machines.beat_up.family_figures import family_figures
from ilmek.machines.beat_up.family_report import family_results, front_table, limit_checks
from ilmek.machines.beat_up.figures import figures
from ilmek.machines.beat_up.running import Running
from ilmek.machines.beat_up.running_report import (
    running_checks,
    running_results,
    running_warnings,
    shaking_results,
)
from ilmek.machines.plates import link_plates
from ilmek.report import Check, Column, Json, Plate, Report, Result, Table, at_least, at_most
from ilmek.report.limits import snap_to_limit
from ilmek.synthesis.crank_rocker.dead_centres import grashof_margin
from ilmek.synthesis.crank_rocker.selection import DEVIATIONS, RATIO_LIMIT
from ilmek.units import format_quantity, minute, turn

PAPER = "Topalbekiroglu and Celik, beat-up mechanism"
LINKS = ("crank", "coupler", "rocker")
POWER_LIMIT = 1e-9


def report(design: BeatUp) -> Report:
    """Everything that the design says, its run by the motor and its family among it."""
    running, family = design.run(), design.family()
    return Report(
        machine="beat-up",
        title="Beat-up",
        parameters=design.params.as_dict(),
        results=(
            *_geometry(design),
            *_motion(design),
            *_loads(design, running),
            *shaking_results(design),
            *running_results(running),
            *family_results(design, family),
            *_at(design),
        ),
        checks=(*_checks(design), *running_checks(design.params, running), *limit_checks(design, family)),
        tables=(_link_table(design), _dead_centre_table(design), _peak_table(design), front_table(family)),
        figures=(*figures(design, running), *family_figures(family)),
        warnings=(*_warnings(design), *running_warnings(running)),
        plates=_plates(design),
    )


def _plates(design: BeatUp) -> tuple[Plate, ...]:
    """Crank, coupler and rocker, which carries the beater, by their width and thickness."""
    params, lengths = design.params, {name: complex(length) for name, length in design.lengths.items()}
    links = {
        "crank": (("D", 0j), ("C", lengths["crank"])),
        "coupler": (("C", 0j), ("B", lengths["coupler"])),
        "rocker": (("A", 0j), ("B", lengths["rocker"]), ("E", lengths["beater"])),
    }
    material = f"of density {format_quantity(params.density, 'kg/m^3')}"
    return link_plates(links, width=params.width, thickness=params.thickness, material=material)


def _geometry(design: BeatUp) -> tuple[Result, ...]:
    links, dead = design.links, design.dead_centres
    return (
        Result("crank", float(links.crank), "1", "crank over ground (paper, Eq 1)"),
        Result("coupler", float(links.coupler), "1", "coupler over ground (paper, Eq 1)"),
        Result("rocker", float(links.rocker), "1", "rocker over ground (paper, Eq 3)"),
        Result("crank_coupler_ratio", float(links.crank / links.coupler), "1", "crank over coupler, r/l"),
        Result("transmission_angle_min", design.transmission_angle_min, "deg", "least acute transmission angle"),
        Result("swing", float(dead.swing), "deg", "swing of the rocker between its dead centres"),
        Result(
            "crank_rotation", float(dead.rotation), "deg", "turn of the crank from the beat to the other dead centre"
        ),
        Result("beta", float(dead.beta), "deg", "crank angle of the beat, the extended dead centre"),
        Result(
            "lengths", dict(design.lengths), "mm", "lengths of the links, and of the beater from the rocker's pivot"
        ),
        Result("masses", dict(design.masses), "kg", "masses of the bars; the rocker's reaches to the beater"),
        Result("inertias", dict(design.inertias), "kg*m^2", "moments of inertia of the bars about their centres"),
    )


def _motion(design: BeatUp) -> tuple[Result, ...]:
    peaks = design.peaks
    period = turn / design.params.speed
    return (
        Result("period", period, "s", "time of one beat, a turn of the crank"),
        Result("beats_per_minute", minute / period, "1", "beats a minute"),
        Result("beater_stroke", _stroke(design), "mm", "chord of the beater's path between the dead centres"),
        Result("beater_velocity_max", peaks["beater_velocity"].value, "m/s", "greatest speed of the beater"),
        Result(
            "beater_acceleration_max",
            peaks["beater_acceleration"].value,
            "m/s^2",
            "greatest acceleration of the beater, along and across its path together",
        ),
        Result(
            "beater_acceleration_angle",
            peaks["beater_acceleration"].at,
            "deg",
            "crank angle of the greatest acceleration, near the beat",
        ),
    )


def _loads(design: BeatUp, running: Running) -> tuple[Result, ...]:
    peaks = design.peaks
    return (
        Result(
            "beater_force_max",
            peaks["beater_force"].value,
            "N",
            "greatest force between rocker and beater: beater mass times acceleration, less its weight",
        ),
        Result("pin_force_max", {pin: peaks[pin].value for pin in PINS}, "N", "greatest force in each pin"),
        Result("drive_torque_max", peaks["drive_torque"].value, "N*m", "greatest size of the torque on the crank"),
        Result("drive_torque_rms", running.duty.rms, "N*m", "root mean square of the torque"),
        Result(
            "drive_power_max",
            peaks["drive_torque"].value * design.params.speed,
            "W",
            "greatest power to and from the drive, at constant speed",
        ),
    )


def _at(design: BeatUp) -> tuple[Result, ...]:
    if design.at is None:
        return ()
    state = design.at
    answer: dict[str, Json] = {
        "drive_torque": _only(state.torque),
        "pin_forces": {pin: _only(force) for pin, force in state.pins.items()},
        "beater_acceleration": _only(np.abs(state.beater.acceleration)),
        "beater_velocity": _only(np.abs(state.beater.velocity)),
        "beater_force": _only(np.abs(state.beater_force)),
    }
    return (Result("at", answer, "", "the same at crank_angle: torque with its sign, the others as sizes"),)


def _only(values: FloatArray) -> float:
    return float(values[0])


def _stroke(design: BeatUp) -> float:
    return 2 * design.lengths["beater"] * math.sin(float(design.dead_centres.swing) / 2)


def _checks(design: BeatUp) -> tuple[Check, ...]:
    wanted, tolerated = (math.pi / 2 - deviation for deviation in DEVIATIONS)
    angle, ratio = design.transmission_angle_min, float(design.links.crank / design.links.coupler)
    margin, force = float(grashof_margin(design.links)), design.peaks["beater_force"].value
    return (
        at_least("transmission angle, to run at all", angle, tolerated, "deg", f"{PAPER}, criterion i: 90° - µ < 50°"),
        at_least("transmission angle, to run well", angle, wanted, "deg", f"{PAPER}, criterion i: 90° - µ < 40°"),
        at_most("crank/coupler ratio", snap_to_limit(ratio, RATIO_LIMIT), RATIO_LIMIT, "1", f"{PAPER}, criterion ii"),
        at_least("Grashof margin, in ground links", margin, 0.0, "1", f"{PAPER}, criterion iii"),
        at_least("force on the beater", force, design.params.beat_force, "N", f"{PAPER}, abstract: over 60 N"),
        at_most("power balance of the forces", design.state.forces.power_error, POWER_LIMIT, "1", "virtual power"),
    )


def _warnings(design: BeatUp) -> tuple[str, ...]:
    force, wanted = design.peaks["beater_force"].value, design.params.beat_force
    if force >= wanted or design.params.gravity > 0 or force == 0:
        return ()
    # Without weight every force grows with the square of the speed.
    speed = format_quantity(design.params.speed * math.sqrt(wanted / force), "rad/s")
    reached, asked = format_quantity(force, "N"), format_quantity(wanted, "N")
    return (f"the beater is pushed with {reached} where {asked} are wanted: turn the crank at {speed}",)


def _link_table(design: BeatUp) -> Table:
    columns = (
        Column("link"),
        Column("over ground"),
        Column("length", "mm"),
        Column("mass", "kg"),
        Column("J", "kg*m^2"),
    )
    rows = tuple(
        (name, design.lengths[name] / design.lengths["ground"], design.lengths[name], design.masses[name], moment)
        for name, moment in design.inertias.items()
    )
    return Table("beat-up-links", "Links, with mass and moment of inertia of their bars", columns, rows)


def _dead_centre_table(design: BeatUp) -> Table:
    at_beat, back = design.rocker_angles
    columns = (Column("dead centre"), Column("crank angle", "deg"), Column("rocker angle", "deg"), Column("time", "s"))
    rows = (
        ("extended: the beat", design.beat_angle, at_beat, design.beat_angle / design.params.speed),
        ("folded: farthest back", design.back_angle, back, design.back_angle / design.params.speed),
    )
    return Table("beat-up-dead-centres", "Dead centres", columns, rows)


def _peak_table(design: BeatUp) -> Table:
    named = {
        "beater_velocity": ("speed of the beater", "m/s"),
        "beater_acceleration": ("acceleration of the beater", "m/s^2"),
        "beater_force": ("force on the beater", "N"),
        "drive_torque": ("drive torque", "N*m"),
        **{pin: (f"force in pin {pin}", "N") for pin in PINS},
    }
    rows = tuple(
        (said, format_quantity(design.peaks[name].value, unit), design.peaks[name].at)
        for name, (said, unit) in named.items()
    )
    columns = (Column("quantity"), Column("greatest value"), Column("at crank angle", "deg"))
    return Table("beat-up-peaks", "Greatest values over a turn", columns, rows)
