"""The report of the knotting head: results of its cams, checks, tables, figures, warnings, cam tables."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ilmek.cams.loaded_plate_cam import CamShaftDrive, LoadedPlateCam, torque_at
from ilmek.machines.electronic_cam import cam_table
from ilmek.machines.weaver.checks import head_checks
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.grippers import YARN_TOLERANCE, Grippers
from ilmek.machines.weaver.limits import HeadLimits, head_limits
from ilmek.machines.weaver.magazine import Magazine
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.opener import Opener
from ilmek.machines.weaver.opener_figures import opener_figures
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.plan_view import animation, plan_view
from ilmek.machines.weaver.tree import cam_masses
from ilmek.machines.weaver.widths import stack_width
from ilmek.records import Computed, computed, group, record
from ilmek.report import Axis, CamTable, Check, Drawing, Figure, Plot, Series, Stroke, Table, Timing, columns
from ilmek.timing.figures import draw
from ilmek.timing.track import sample
from ilmek.units import format_quantity, turn

OUTLINE = 4
"""Every n-th sample of a cam's contour is a point of its drawing."""


def _each(unit: str, meaning: str, value: Callable[[LoadedPlateCam], float]) -> Computed[Any]:
    """A value of each cam, by its name."""
    return computed(unit, meaning, lambda it: {cam.name: value(cam) for cam in it.cams}, shown=False)


@record
class CamResults:
    """The results of the cams; masses: of their plates, by name [kg]."""

    params: WeaverParams
    cams: tuple[LoadedPlateCam, ...]
    masses: Mapping[str, float]

    cam_lift = _each("mm", "lift of each cam's follower", lambda cam: cam.lift)
    cam_prime_radius = _each("mm", "prime radius", lambda cam: cam.cam.prime_radius)
    cam_radius = _each("mm", "largest radius of each cam", lambda cam: cam.radius)
    cam_pressure_angle_max = _each("deg", "largest pressure angle", lambda cam: cam.pressure_angle)
    cam_convex_radius_min = _each("mm", "least convex radius of the pitch curve", lambda cam: cam.convex_radius)
    cam_area = _each("mm^2", "area of the face, bore included", lambda cam: cam.area)
    cam_mass = computed("kg", "mass of each cam", lambda it: it.masses, shown=False)
    cam_force_max = _each("N", "greatest force of roller on cam", lambda cam: cam.contact_max)
    cam_hertz_max = _each("MPa", "greatest Hertz pressure", lambda cam: cam.pressure_max)
    spring_rate = _each("N/m", "rates of the return springs; 0: none", lambda cam: cam.rate)
    spring_preload = _each("N", "preloads of the return springs", lambda cam: cam.preload)
    cam_stack_width = computed("mm", "width of the cams on their shaft", lambda it: stack_width(it.params), least=0.0)


@record
class WeaverAnalysis:
    """A head, its grippers, cams and drive, and its limits."""

    weaver: Weaver = group()
    grippers: Grippers | None = group()
    opener: Opener = group()
    magazine: Magazine = group()
    cams: CamResults = group()
    drive: CamShaftDrive = group()
    limits: HeadLimits = group()


def analyse(weaver: Weaver) -> WeaverAnalysis:
    """The results of a head."""
    cams = CamResults(weaver.params, weaver.cams, cam_masses(weaver))
    grippers = None if weaver.params.with_arms else weaver.grippers
    return WeaverAnalysis(weaver, grippers, weaver.opener, weaver.magazine, cams, weaver.drive, head_limits(weaver))


def checks(analysis: WeaverAnalysis) -> tuple[Check, ...]:
    """The checks of a head."""
    return head_checks(analysis.weaver, analysis.limits)


def warnings(analysis: WeaverAnalysis) -> tuple[str, ...]:
    """A knot that the thesis' mechanism does not tie; more yarn drawn than billed."""
    weaver = analysis.weaver
    params, warned = weaver.params, []
    if weaver.knot_tied != params.knot and not params.with_arms:
        warned.append(
            "the thesis' head ties no asymmetric knot, whatever its dimensions: both ends go round the outside of "
            "their warps and both come out between them; the machine knotting-dyad ties it"
            if params.knot == "asymmetric"
            else f"the {params.knot} knot is not tied, {weaver.knot_why}"
        )
    more = weaver.drawn - params.billed
    if more > YARN_TOLERANCE:
        shown = [format_quantity(size, "mm", 3) for size in (more, weaver.drawn, params.billed)]
        warned.append(
            f"{shown[0]} more yarn than the bill's is drawn for every knot, {shown[1]} for {shown[2]}: the grippers "
            "reach round the pair with no less"
        )
    return tuple(warned)


def tables(analysis: WeaverAnalysis) -> tuple[Table, ...]:
    """Greatest values of the tracks, cams, motions."""
    weaver = analysis.weaver
    tracks = weaver.tools
    heads = columns(
        "track", "driven by", "stroke [mm]", "largest speed [m/s]", "largest acceleration [m/s^2]", "shortest cycle [s]"
    )
    rows = tuple(
        (track.name, track.actuator, peak.stroke, peak.speed, peak.acceleration, peak.shortest)
        for track in tracks
        for peak in (weaver.peaks[track.name],)
    )
    peaks = Table("tracks", "Tracks of the head; the handler at its tip", heads, rows)
    motions = Table(
        "motions",
        "Motions over the cam angle",
        columns("track", "motion", "from [deg]", "to [deg]", "law"),
        tuple(
            (track.name, part.name, part.start, part.end, part.law.name)
            for track in weaver.cyclogram.tracks
            for part in track.segments
        ),
    )
    return peaks, cams_table(weaver), motions, _room_table(weaver)


def _room_table(weaver: Weaver) -> Table:
    rows = tuple(sorted(weaver.needs.items(), key=lambda one: one[1], reverse=True))
    return Table("head-width", "Width of the head by its contents", columns("content", "width [mm]"), rows)


def figures(analysis: WeaverAnalysis) -> tuple[Figure, ...]:
    """Cyclogram, grippers in plan view and in motion, cams, accelerations, torque."""
    weaver = analysis.weaver
    return (
        timing(weaver),
        *(() if weaver.params.with_arms else (plan_view(weaver), animation(weaver))),
        *opener_figures(weaver),
        cams_drawing(weaver),
        _accelerations(weaver),
        torque_plot(weaver),
    )


def timing(weaver: Weaver) -> Timing:
    """The head's cyclogram as a figure."""
    note = "Order of the motions: thesis, 2.2.3; the angles are assumed by this project, the thesis prints none."
    tied_by = "the arms, and the cams of the head" if weaver.params.with_arms else "the cams of the head"
    return draw(weaver.cyclogram, f"One knot: {tied_by}", note, drive=Axis("cam angle", "deg"))


def _accelerations(weaver: Weaver) -> Plot:
    angle, w = np.linspace(0, turn, 721), weaver.cyclogram.speed
    arms = {HANDLER: weaver.handler_radius}
    series = tuple(
        Series(track.name, angle, sample(track, angle).bend * w**2 * arms.get(track.name, 1.0))
        for track in weaver.tools
    )
    axes = Axis("cam angle", "deg"), Axis("acceleration", "m/s^2")
    note = f"at {60 / weaver.cycle:.3g} knots a minute; the handler at its tip"
    return Plot("acceleration", "Acceleration of the tools", *axes, series, note=note)


def cams_table(weaver: Weaver) -> Table:
    """The cams one by one."""
    heads = columns(
        "cam | driven by | lift [mm] | prime radius [mm] | largest radius [mm] | pressure angle [deg]",
        "least convex radius [mm] | mass [kg] | spring [N/m] | preload [N] | greatest force [N]",
        "Hertz pressure [MPa] | load of the work [N] | torque [Nm]",
    )
    masses = cam_masses(weaver)
    rows = tuple(
        (
            cam.name,
            cam.actuator,
            cam.lift,
            cam.cam.prime_radius,
            cam.radius,
            cam.pressure_angle,
            cam.convex_radius,
            masses[cam.name],
            cam.rate,
            cam.preload,
            cam.contact_max,
            cam.pressure_max,
            float(np.abs(cam.load).max()),
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
    total = Series("all", angle, torque_at(weaver.cams, angle))
    axes = Axis("cam angle", "deg"), Axis("torque", "Nm")
    note = "inertia, springs, the handler's brake, and the tools' work"
    return Plot("cam-torque", "Torque on the head's cam shaft", *axes, (total, *series), note=note)


def cam_tables(weaver: Weaver) -> tuple[CamTable, ...]:
    """The tracks' motions, for a head whose tools have axes of their own."""
    return tuple(
        cam_table(track, track.name.replace(" ", "-"), f"{track.name} over the cam angle", weaver.cycle)
        for track in weaver.tools
    )
