"""What the head says of its cams, their drive, the cutter and the colour selector: results, checks, table, figures."""

from collections.abc import Callable

import numpy as np

from ilmek.machines.electronic_cam import cam_table
from ilmek.machines.plates import round_bore, zero_mark
from ilmek.machines.weaver import limits
from ilmek.machines.weaver.cams import PRESSURE_LIMIT, STEEL, HeadCam, stack_width
from ilmek.machines.weaver.design import Weaver
from ilmek.report import Axis, CamTable, Check, Column, Drawing, Plate, Plot, Result, Series, Stroke, Table, at_most
from ilmek.units import format_quantity, turn

OUTLINE = 4
"""Every so manieth sample of a cam's contour is a point of its drawing."""


def cam_results(weaver: Weaver) -> tuple[Result, ...]:
    """Cams, drive, cutter, selector, limits of the cycle, masses."""
    drive, params, masses = weaver.drive, weaver.params, limits.mass_of(weaver)
    shortest, selector = limits.cycle_limits(weaver), limits.selector_of(weaver)
    return (
        *_of_cams(weaver),
        Result("cam_stack_width", stack_width(params, weaver.cams), "mm", "width of the five cams on their shaft"),
        Result("cam_torque_max", drive.torque_max, "Nm", "greatest torque of all cams on their shaft"),
        Result("cam_torque_rms", drive.torque_rms, "Nm", "root mean square of the same"),
        Result("cam_power_max", drive.power_max, "W", "greatest power of the same, to and fro"),
        Result("cam_power_mean", drive.power_mean, "W", "mean power, of the handler's brake"),
        Result("cam_inertia", drive.inertia, "kg*m^2", "moment of inertia of the cams"),
        Result("motor", drive.motor.name if drive.motor else None, "", "class of motor of the cam shaft"),
        Result("ratio", drive.reducer.ratio if drive.reducer else None, "1", "ratio of its reducer"),
        Result("motor_torque_peak", drive.duty.peak if drive.duty else None, "Nm", "greatest torque of the motor"),
        Result("motor_torque_rms", drive.duty.rms if drive.duty else None, "Nm", "root mean square of the same"),
        Result(
            "motor_inertia_ratio",
            drive.duty.inertia_ratio if drive.duty else None,
            "1",
            "inertia of the cams at the motor over its rotor's",
        ),
        Result("cycle_limits", shortest, "s", "the shortest cycle that each limit allows"),
        Result("cycle_time_possible", max(shortest.values()), "s", "the shortest cycle that all of them allow"),
        Result("cycle_time_possible_set_by", max(shortest, key=lambda name: shortest[name]), "", "which sets it"),
        Result("cutting_force", limits.cutting_force(weaver), "N", "force that cuts all fibres of the yarn at once"),
        Result("cutting_time", weaver.params.cutting_time, "s", "time of the cutter's blade across the yarn"),
        Result(
            "cutting_window",
            limits.cut_share(weaver) * weaver.cycle,
            "s",
            "from draw to presenting",
        ),
        Result("selector_motor", selector.motor.name if selector.motor else None, "", "stepper that moves the tubes"),
        Result("selector_torque", selector.torque, "Nm", "torque that it must give"),
        Result("selector_step", selector.step, "mm", "way of the tubes for a step of it"),
        Result("mass", sum(masses.values()), "kg", "mass of the head's cams, shaft, tools, tubes and motors"),
        Result("masses", masses, "kg", "the same one by one"),
    )


def cam_checks(weaver: Weaver) -> tuple[Check, ...]:
    """Cams within their limits and the head, the cutter within its time, the selector's way within a knot."""
    params, cams = weaver.params, weaver.cams
    worst = max(cams, key=lambda cam: float(cam.pressure.max()))
    widest = max(cams, key=lambda cam: cam.radius)
    sharpest = min(cams, key=lambda cam: cam.convex_radius)
    steep = max(cams, key=lambda cam: cam.pressure_angle)
    found = (
        at_most(
            f"pressure angle, {steep.name}", _whole(steep.pressure_angle), params.pressure_angle_limit, "deg", "limit"
        ),
        at_most(f"roller, {sharpest.name}", params.roller_radius, sharpest.convex_radius, "mm", "no undercut"),
        at_most(f"Hertz pressure, {worst.name}", float(worst.pressure.max()), PRESSURE_LIMIT, "MPa", STEEL.name),
        at_most("cams beside each other", stack_width(params, cams), params.head_width, "mm", "head_width"),
        at_most(f"diameter, {widest.name}", 2 * widest.radius, params.cam_room, "mm", "cam_room"),
        at_most(
            "cutter", weaver.params.cutting_time, limits.cut_share(weaver) * weaver.cycle, "s", "draw to presenting"
        ),
    )
    if params.closure == "groove":
        hollow = min(cams, key=lambda cam: cam.concave_radius)
        outer = at_most(f"roller in the groove, {hollow.name}", params.roller_radius, hollow.concave_radius, "mm", "")
        return (*found, outer)
    loose = min(cams, key=lambda cam: cam.lift_off)
    speed = weaver.cyclogram.speed
    return (*found, at_most(f"speed before lift-off, {loose.name}", speed, loose.lift_off, "rpm", "return springs"))


def cams_table(weaver: Weaver) -> Table:
    """The cams one by one."""
    columns = (
        Column("cam"),
        Column("driven by"),
        Column("lift", "mm"),
        Column("prime radius", "mm"),
        Column("largest radius", "mm"),
        Column("pressure angle", "deg"),
        Column("least convex radius", "mm"),
        Column("mass", "kg"),
        Column("spring", "N/m"),
        Column("preload", "N"),
        Column("greatest force", "N"),
        Column("Hertz pressure", "MPa"),
        Column("torque", "Nm"),
    )
    rows = tuple(
        (
            cam.name,
            cam.actuator,
            cam.lift,
            cam.cam.prime_radius,
            cam.radius,
            cam.pressure_angle,
            cam.convex_radius,
            cam.mass,
            cam.rate,
            cam.preload,
            float(cam.contact.max()),
            float(cam.pressure.max()),
            float(np.abs(cam.torque).max()),
        )
        for cam in weaver.cams
    )
    return Table("cams", "Cams of the head", columns, rows)


def cams_drawing(weaver: Weaver) -> Drawing:
    """All cams side by side, to scale, the zero of the cam angle to the right."""
    room = 2.15 * max(cam.radius for cam in weaver.cams)
    strokes: list[Stroke] = []
    for place, cam in enumerate(weaver.cams):
        at = room * complex(place % 3, -1.15 * (place // 3))
        surface = cam.trace.surface[::OUTLINE]
        ring = np.exp(1j * np.linspace(0.0, turn, 73))
        strokes += [
            Stroke(at + surface, "outline", closed=True, filled=True),
            # A speck below each cam bears its name, which would otherwise stand among the neighbours.
            Stroke(at - 0.56j * room + np.linspace(-0.38, -0.379, 2) * room, "construction", cam.name),
            Stroke(at + cam.trace.pitch[::OUTLINE], "path", closed=True),
            Stroke(at + weaver.params.shaft / 2 * ring, "outline", closed=True),
            Stroke(at + cam.cam.prime_radius + weaver.params.roller_radius * ring + cam.course.s[0], "construction"),
        ]
    note = "seen along the shaft, turning counter-clockwise, at the cam angle 0; thin: pitch curves; dashed: rollers"
    return Drawing("weaver-cams", "Cams of the head, to scale", tuple(strokes), note=note)


def torque_plot(weaver: Weaver) -> Plot:
    """Torque of every cam and of all together over the turn."""
    angle = np.linspace(0, turn, 721)
    each = [np.interp(angle, cam.angle, cam.torque) for cam in weaver.cams]
    series = tuple(Series(cam.name, angle, torque, dashed=True) for cam, torque in zip(weaver.cams, each, strict=True))
    total = Series("all", angle, np.sum(each, axis=0))
    axes = Axis("cam angle", "deg"), Axis("torque", "Nm")
    note = "inertia, springs and the handler's brake; friction comes on top"
    return Plot("cam-torque", "Torque on the head's cam shaft", *axes, (total, *series), note=note)


def plates(weaver: Weaver) -> tuple[Plate, ...]:
    """The cams as plates, none where no surface can guide its roller."""
    return tuple(_plate(weaver, cam) for cam in weaver.cams if not cam.undercut)


def cam_tables(weaver: Weaver) -> tuple[CamTable, ...]:
    """The tracks' motions, for a head whose tools have axes of their own."""
    return tuple(
        cam_table(track, track.name.replace(" ", "-"), f"{track.name} over the cam angle", weaver.cycle)
        for track in weaver.cyclogram.tracks
    )


def _of_cams(weaver: Weaver) -> tuple[Result, ...]:
    def each(value: Callable[[HeadCam], float]) -> dict[str, float]:
        return {cam.name: value(cam) for cam in weaver.cams}

    return (
        Result("cam_lift", each(lambda cam: cam.lift), "mm", "lift of each cam's follower", shown=False),
        Result("cam_prime_radius", each(lambda cam: cam.cam.prime_radius), "mm", "prime radius", shown=False),
        Result("cam_radius", each(lambda cam: cam.radius), "mm", "largest radius of each cam", shown=False),
        Result("cam_pressure_angle_max", each(lambda cam: cam.pressure_angle), "deg", "pressure angle", shown=False),
        Result("cam_convex_radius_min", each(lambda cam: cam.convex_radius), "mm", "pitch curve", shown=False),
        Result("cam_area", each(lambda cam: cam.area), "mm^2", "area of the face, bore among it", shown=False),
        Result("cam_mass", each(lambda cam: cam.mass), "kg", "mass of each cam", shown=False),
        Result("cam_force_max", each(lambda cam: float(cam.contact.max())), "N", "roller on cam", shown=False),
        Result("cam_hertz_max", each(lambda cam: float(cam.pressure.max())), "MPa", "Hertz pressure", shown=False),
        Result("spring_rate", each(lambda cam: cam.rate), "N/m", "return springs; 0: none", shown=False),
        Result("spring_preload", each(lambda cam: cam.preload), "N", "their preload", shown=False),
    )


def _plate(weaver: Weaver, cam: HeadCam) -> Plate:
    shaft, surface = weaver.params.shaft, cam.trace.surface[::-1]
    bore = round_bore(shaft)
    lift = format_quantity(cam.lift, "mm")
    return Plate(
        cam.name.replace(" ", "-"),
        f"{cam.name}, {cam.actuator}, lift {lift}",
        surface[:-1],
        cam.thickness,
        STEEL.name,
        bore.holes,
        bore.cutouts,
        paths={"pitch curve": cam.trace.pitch[::-1], "cutter path": cam.trace.pitch[::-1]},
        marks=zero_mark(float(np.abs(surface[-1]))),
        area=cam.area,
        notes=(*bore.notes, f"cutter of {format_quantity(2 * cam.cam.roller_radius, 'mm')}"),
    )


def _whole(angle: float) -> float:
    """A pressure angle that the limit set exceeds it by rounding only."""
    return float(f"{angle:.9g}")
