"""What a needle mechanism's design says: results, checks, tables and figures."""

from collections.abc import Mapping

import numpy as np

from ilmek.machines.plates import link_plates
from ilmek.machines.tufting.design import Tufting
from ilmek.machines.tufting.figures import figures
from ilmek.machines.tufting.model import PINS, TuftingState, inertias
from ilmek.num.piecewise import Extremum
from ilmek.report import Check, Column, Json, Plate, Report, Result, Table, at_least, at_most, snap_to_limit
from ilmek.units import deg, format_quantity, mm, turn

PAPER = "Xu et al., needle multi-linkage mechanism"
BALANCE = 1e-9
LEVELS = 0.5 * mm
"""Greatest difference of the needle's height at entry and exit: there is one backing."""

TRANSMISSION, PRESSURE = 40 * deg, 30 * deg
JOINTS = (*PINS, "guide")
SIDES = {-1: "just before", 0: "", 1: "just after"}


def report(design: Tufting) -> Report:
    """Everything that the design says."""
    return Report(
        machine="tufting",
        title="Tufting needle mechanism",
        parameters=design.params.as_dict(),
        results=(*_motion(design), *_loads(design), *_work(design), *_shaft(design), *_at(design)),
        checks=_checks(design),
        tables=(_link_table(design), _peak_table(design)),
        figures=figures(design),
        warnings=_warnings(design),
        plates=_plates(design),
    )


def _plates(design: Tufting) -> tuple[Plate, ...]:
    """The five links; the needle bar is turned, not cut."""
    p = design.params
    links = {
        "crank": (("O", 0j), ("A", complex(p.crank))),
        "coupler": (("A", 0j), ("B", complex(p.coupler))),
        "rocker": (("C", 0j), ("B", complex(p.rocker))),
        "arm": (("C", 0j), ("D", complex(p.arm))),
        "rod": (("D", 0j), ("E", complex(p.rod))),
    }
    return link_plates(links, width=p.link_width, thickness=p.link_thickness, material="steel", number=p.bars)


def _motion(design: Tufting) -> tuple[Result, ...]:
    said = {
        "theta2": "least and greatest angle of the coupler, A to B",
        "theta3": "least and greatest angle of the rocker, C to B",
        "theta4": "least and greatest angle of the arm, C to D: theta3 + beta1 - 360 deg (Eq 15)",
        "theta5": "least and greatest angle of the rod, D to E",
    }
    return (
        *(Result(f"{name}_range", list(design.ranges[name]), "deg", meaning) for name, meaning in said.items()),
        Result("stroke", design.stroke, "mm", "way of the needle from its highest to its lowest place"),
        Result("lowest_crank_angle", design.lowest, "deg", "crank angle at which the needle is lowest"),
        Result("highest_crank_angle", design.highest, "deg", "crank angle at which the needle is highest"),
        Result("entry_height", design.height(design.params.entry), "mm", "needle above its lowest place at entry"),
        Result("exit_height", design.height(design.params.exit), "mm", "needle above its lowest place at exit"),
        Result("transmission_angle_min", design.transmission, "deg", "least acute angle of coupler and rocker"),
        Result("pressure_angle_max", design.pressure_angle, "deg", "greatest angle of the rod to the needle's line"),
        Result("needle_velocity_max", design.peaks["needle_velocity"].value, "m/s", "greatest speed of the needle"),
        Result(
            "needle_acceleration_max",
            design.peaks["needle_acceleration"].value,
            "m/s^2",
            "greatest acceleration of the needle",
        ),
    )


def _loads(design: Tufting) -> tuple[Result, ...]:
    peaks = design.peaks
    driven = {name: peaks[f"C on {name}"].value for name in ("rocker", "arm")}
    return (
        Result("main_shaft_torque_max", peaks["main_torque"].value, "N*m", "greatest size of the torque on the crank"),
        Result("main_shaft_torque_range", list(design.extremes["main_torque"]), "N*m", "least and greatest, with sign"),
        Result(
            "main_shaft_torque_rms", design.rms("main_torque"), "N*m", "root mean square of the torque on the crank"
        ),
        Result(
            "driven_shaft_torque_max",
            peaks["driven_torque"].value,
            "N*m",
            "greatest size of the torque that the driven shaft takes from rocker to arm; a limit where friction jumps",
        ),
        Result(
            "driven_shaft_torque_range", list(design.extremes["driven_torque"]), "N*m", "least and greatest, with sign"
        ),
        Result("driven_shaft_torque_rms", design.rms("driven_torque"), "N*m", "root mean square of the same"),
        Result(
            "pin_force_max",
            {name: peaks[name].value for name in JOINTS},
            "N",
            "greatest force in each joint; C is the whole load of the driven shaft's bearing",
        ),
        Result("driven_shaft_force_max", driven, "N", "greatest force of the driven shaft on rocker and arm each"),
    )


def _work(design: Tufting) -> tuple[Result, ...]:
    return (
        Result("energy_per_revolution", design.work["drive"], "J", "work of the drive in a turn of the crank"),
        Result("friction_work_per_revolution", design.work["friction"], "J", "of that, what the backing takes"),
        Result("main_shaft_torque_mean", design.work["drive"] / turn, "N*m", "mean torque on the crank"),
        Result("power_mean", design.work["drive"] / turn * design.params.speed, "W", "mean power of the drive"),
    )


def _shaft(design: Tufting) -> tuple[Result, ...]:
    bars, peaks = design.params.bars, design.peaks
    return (
        Result("total_torque_max", peaks["total_torque"].value, "N*m", "greatest torque of all bars on the main shaft"),
        Result("total_energy_per_revolution", bars * design.work["drive"], "J", "work of the drive for all bars"),
        Result(
            "shaft_bearing_force_max", peaks["bearing"].value, "N", "greatest force of its bearings on the main shaft"
        ),
    )


def _at(design: Tufting) -> tuple[Result, ...]:
    if design.at is None:
        return ()
    meaning = "the same at crank_angle, just after it where they jump; torques counter-clockwise, needle downward"
    return (Result("at", _instant(design.at), "", meaning),)


def _instant(state: TuftingState) -> dict[str, Json]:
    return {
        "main_shaft_torque": float(state.main_torque[0]),
        "driven_shaft_torque": float(state.driven_torque[0]),
        "pin_forces": {name: float(np.abs(state.joints[name][0])) for name in JOINTS},
        "needle_velocity": float(state.velocity[0]),
        "needle_acceleration": float(state.acceleration[0]),
    }


def _checks(design: Tufting) -> tuple[Check, ...]:
    params, work = design.params, design.work
    scale = max(abs(work["drive"]), design.peaks["main_torque"].value)
    unbalanced = abs(work["drive"] - work["friction"]) / scale if scale else 0.0
    levels = abs(design.height(params.entry) - design.height(params.exit))
    stroke = snap_to_limit(design.stroke, params.stroke)
    return (
        at_least("stroke of the needle", stroke, params.stroke, "mm", f"wanted; {PAPER}: about 33 mm"),
        at_most("needle's height at entry against exit", levels, LEVELS, "mm", "one backing: both at its level"),
        at_least("transmission angle of rocker", design.transmission, TRANSMISSION, "deg", "rule of thumb for rockers"),
        at_most("pressure angle of the rod", design.pressure_angle, PRESSURE, "deg", "rule of thumb for sliders"),
        at_most("work of drive against friction, over a turn", unbalanced, BALANCE, "1", "energy balance"),
        at_most("power balance of the forces", design.state.forces.power_error, BALANCE, "1", "virtual power"),
    )


def _warnings(design: Tufting) -> tuple[str, ...]:
    params = design.params
    if params.friction == "always" or design.lowest_within:
        return ()
    lowest = format_quantity(design.lowest, "deg")
    return (f"the needle is lowest at {lowest}, not between entry and exit: check entry, exit and the turning sense",)


def _link_table(design: Tufting) -> Table:
    params, moving = design.params, inertias(design.params)
    columns = (
        Column("link"),
        Column("length", "mm"),
        Column("mass", "kg"),
        Column("J", "kg*m^2"),
        Column("least angle", "deg"),
        Column("greatest angle", "deg"),
    )
    swings: Mapping[str, str] = {"coupler": "theta2", "rocker": "theta3", "arm": "theta4", "rod": "theta5"}
    rows = tuple(
        (name, getattr(params, name), moving[name].mass, moving[name].moment, *design.ranges[theta])
        for name, theta in swings.items()
    )
    crank = ("crank", params.crank, params.crank_mass, params.crank_inertia, 0.0, turn)
    return Table("tufting-links", "Links, and the range of their angles", columns, (crank, *rows))


def _peak_table(design: Tufting) -> Table:
    named = {
        "main_torque": ("torque on the main shaft", "N*m"),
        "driven_torque": ("torque through the driven shaft", "N*m"),
        **{name: (f"force in {'the guide' if name == 'guide' else f'pin {name}'}", "N") for name in JOINTS},
        "C on rocker": ("force of the driven shaft on the rocker", "N"),
        "C on arm": ("force of the driven shaft on the arm", "N"),
        "total_torque": ("torque of all bars on the main shaft", "N*m"),
        "bearing": ("force of its bearings on the main shaft", "N"),
    }
    rows = tuple((said, *_peak(design.peaks[name], unit)) for name, (said, unit) in named.items())
    columns = (Column("quantity"), Column("greatest size"), Column("at crank angle", "deg"), Column("limit from"))
    return Table("tufting-peaks", "Greatest values over a turn", columns, rows)


def _peak(peak: Extremum, unit: str) -> tuple[str, float, str]:
    return format_quantity(peak.value, unit), peak.at, SIDES[peak.side]
