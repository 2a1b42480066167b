"""The report of the head's cams: results, checks, table, figures, plates, cam tables."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ilmek.machines.electronic_cam import cam_table
from ilmek.machines.plates import round_bore, zero_mark
from ilmek.machines.weaver.cams import PRESSURE_LIMIT, STEEL, HeadCam, stack_width
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.limits import HeadLimits
from ilmek.machines.weaver.params import WeaverParams
from ilmek.records import Computed, computed, record
from ilmek.report import Axis, CamTable, Check, Drawing, Plate, Plot, Series, Stroke, Table, at_most, columns
from ilmek.units import format_quantity, turn

OUTLINE = 4
"""Every n-th sample of a cam's contour is a point of its drawing."""


def _each(unit: str, meaning: str, value: Callable[[HeadCam], float]) -> Computed[Any]:
    """A value of each cam, by its name."""
    return computed(unit, meaning, lambda it: {cam.name: value(cam) for cam in it.cams}, shown=False)


@record
class CamResults:
    """The results of the cams."""

    params: WeaverParams
    cams: tuple[HeadCam, ...]

    cam_lift = _each("mm", "lift of each cam's follower", lambda cam: cam.lift)
    cam_prime_radius = _each("mm", "prime radius", lambda cam: cam.cam.prime_radius)
    cam_radius = _each("mm", "largest radius of each cam", lambda cam: cam.radius)
    cam_pressure_angle_max = _each("deg", "largest pressure angle", lambda cam: cam.pressure_angle)
    cam_convex_radius_min = _each("mm", "least convex radius of the pitch curve", lambda cam: cam.convex_radius)
    cam_area = _each("mm^2", "area of the face, bore included", lambda cam: cam.area)
    cam_mass = _each("kg", "mass of each cam", lambda cam: cam.mass)
    cam_force_max = _each("N", "greatest force of roller on cam", lambda cam: cam.contact_max)
    cam_hertz_max = _each("MPa", "greatest Hertz pressure", lambda cam: cam.pressure_max)
    spring_rate = _each("N/m", "rates of the return springs; 0: none", lambda cam: cam.rate)
    spring_preload = _each("N", "preloads of the return springs", lambda cam: cam.preload)
    cam_stack_width = computed(
        "mm", "width of the five cams on their shaft", lambda it: stack_width(it.params, it.cams)
    )


def cam_checks(weaver: Weaver, limits: HeadLimits) -> tuple[Check, ...]:
    """Cams within their limits and the head, the cutter within its time."""
    params, cams = weaver.params, weaver.cams
    worst, widest = max(cams, key=lambda cam: cam.pressure_max), max(cams, key=lambda cam: cam.radius)
    sharpest, steep = min(cams, key=lambda cam: cam.convex_radius), max(cams, key=lambda cam: cam.pressure_angle)
    angle = rounded(steep.pressure_angle, 9)
    found = (
        at_most(f"pressure angle, {steep.name}", angle, params.pressure_angle_limit, "deg", "limit"),
        at_most(f"roller, {sharpest.name}", params.roller_radius, sharpest.convex_radius, "mm", "no undercut"),
        at_most(f"Hertz pressure, {worst.name}", worst.pressure_max, PRESSURE_LIMIT, "MPa", STEEL.name),
        at_most("cams beside each other", stack_width(params, cams), params.head_width, "mm", "head_width"),
        at_most(f"diameter, {widest.name}", 2 * widest.radius, params.cam_room, "mm", "cam_room"),
        at_most("cutter", limits.cutting_time, limits.cutting_window, "s", "draw to presenting"),
    )
    if params.closure == "groove":
        hollow = min(cams, key=lambda cam: cam.concave_radius)
        outer = at_most(f"roller in the groove, {hollow.name}", params.roller_radius, hollow.concave_radius, "mm", "")
        return (*found, outer)
    loose = min(cams, key=lambda cam: cam.lift_off)
    speed = weaver.cyclogram.speed
    return (*found, at_most(f"speed before lift-off, {loose.name}", speed, loose.lift_off, "rpm", "return springs"))


def rounded(value: float, digits: int) -> float:
    """The value in significant digits, for a check of what was made for exactly its limit."""
    return float(f"{value:.{digits}g}")


def cams_table(weaver: Weaver) -> Table:
    """The cams one by one."""
    heads = columns(
        "cam",
        "driven by",
        "lift [mm]",
        "prime radius [mm]",
        "largest radius [mm]",
        "pressure angle [deg]",
        "least convex radius [mm]",
        "mass [kg]",
        "spring [N/m]",
        "preload [N]",
        "greatest force [N]",
        "Hertz pressure [MPa]",
        "torque [Nm]",
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
            cam.contact_max,
            cam.pressure_max,
            float(np.abs(cam.torque).max()),
        )
        for cam in weaver.cams
    )
    return Table("cams", "Cams of the head", heads, rows)


def cams_drawing(weaver: Weaver) -> Drawing:
    """All cams side by side, to scale, the zero of the cam angle to the right."""
    room = 2.15 * max(cam.radius for cam in weaver.cams)
    strokes: list[Stroke] = []
    for number, cam in enumerate(weaver.cams):
        at = room * complex(number % 3, -1.15 * (number // 3))
        surface = cam.trace.surface[::OUTLINE]
        ring = np.exp(1j * np.linspace(0.0, turn, 73))
        strokes += [
            Stroke(at + surface, "outline", closed=True, filled=True),
            # A speck below each cam bears its name, which would otherwise stand among the neighbours.
            Stroke(at - 0.56j * room + np.linspace(-0.38, -0.379, 2) * room, "construction", cam.name),
            Stroke(at + cam.trace.pitch[::OUTLINE], "path", closed=True),
            Stroke(at + weaver.params.shaft / 2 * ring, "outline", closed=True),
            Stroke(at + cam.cam.prime_radius + weaver.params.roller_radius * ring + cam.motion.s[0], "construction"),
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
    note = "inertia, springs and the handler's brake, without friction"
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
