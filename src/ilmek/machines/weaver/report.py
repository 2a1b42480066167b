"""The report of the knotting head: checks, tables, figures and warnings."""

import numpy as np

from ilmek.machines.weaver.cam_report import CamResults, cam_checks, cams_drawing, cams_table, rounded, torque_plot
from ilmek.machines.weaver.cams import CamShaftDrive
from ilmek.machines.weaver.cyclogram import relations
from ilmek.machines.weaver.design import HAND_KNOT, Weaver
from ilmek.machines.weaver.grippers import YARN_TOLERANCE, Grippers
from ilmek.machines.weaver.limits import HeadLimits, head_limits
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.plan_view import animation, plan_view
from ilmek.records import group, record
from ilmek.report import Axis, Check, Figure, Plot, Series, Table, Timing, at_least, at_most, columns
from ilmek.timing.cyclogram import check_all
from ilmek.timing.figures import draw
from ilmek.timing.track import sample
from ilmek.units import format_quantity, rpm, turn


@record
class WeaverAnalysis:
    """A head, its grippers, cams and drive, and its limits."""

    weaver: Weaver = group()
    grippers: Grippers = group()
    cams: CamResults = group()
    drive: CamShaftDrive = group()
    limits: HeadLimits = group()


def analyse(weaver: Weaver) -> WeaverAnalysis:
    """The results of a head."""
    cams = CamResults(weaver.params, weaver.cams)
    return WeaverAnalysis(weaver, weaver.grippers, cams, weaver.drive, head_limits(weaver))


def checks(found: WeaverAnalysis) -> tuple[Check, ...]:
    """Limits of every track, order of the motions, the carriage's step, the hand weaver's time, the knot, the cams."""
    weaver, params = found.weaver, found.weaver.params
    limits: list[Check] = []
    for name, peak in weaver.peaks.items():
        speed, acceleration = (rounded(value, 12) for value in (peak.speed, peak.acceleration))
        limits += [
            at_most(f"{name}: speed", speed, params.speed_limit, "m/s", "parameter speed_limit"),
            at_most(f"{name}: acceleration", acceleration, params.acceleration_limit, "m/s^2", "acceleration_limit"),
        ]
    return (
        *limits,
        *check_all(weaver.cyclogram, relations(params.relation_gap)),
        at_most("carriage: step to the next knot", weaver.carriage_step, weaver.carriage_window, "s", "tools out"),
        at_most("knot cycle", weaver.cycle, HAND_KNOT, "s", "best hand weaver: 25 knots a minute"),
        *_knot_checks(weaver),
        *cam_checks(weaver, found.limits),
    )


def _knot_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The required knot is tied; the yarn is long enough, for the knot and between the grippers; they have room."""
    by, params, yarn = weaver.grippers, weaver.params, YARN_TOLERANCE
    tied = float(weaver.knot_tied == params.knot)
    return (
        at_least(f"{params.knot} knot tied", tied, 1.0, "", f"proof: {weaver.knot_why}"),
        at_most("yarn needed between the grippers", by.yarn_taut_max, by.apart + yarn, "mm", "yarn held between them"),
        at_least("yarn drawn", weaver.drawn + yarn, params.billed, "mm", "yarn bill: carpet.pile, of this knot"),
        at_least(
            "room of the side grippers", by.gripper_clearance + yarn, params.clearance, "mm", "parameter clearance"
        ),
    )


def warnings(found: WeaverAnalysis) -> tuple[str, ...]:
    """Another knot or more yarn than required, a longer cycle than required, no motor."""
    weaver = found.weaver
    warned, required, drive = list(_knot_warnings(weaver)), weaver.params.cycle, weaver.drive
    if weaver.cycle > required:
        longer = f"a knot takes {weaver.cycle:.4g} s, not the required {required:.4g} s"
        warned.append(f"{longer}: the limits of the {weaver.limiting} allow no less")
    if drive.servo is None:
        needed = f"{drive.torque_max:.3g} Nm at {weaver.cyclogram.speed / rpm:.3g} rpm"
        warned.append(f"no motor of the table gives {needed} of the cam shaft: lighter tools or a longer cycle")
    return tuple(warned)


def _knot_warnings(weaver: Weaver) -> tuple[str, ...]:
    """A knot that the thesis' mechanism does not tie; more yarn drawn than billed."""
    params, warned = weaver.params, []
    if weaver.knot_tied != params.knot:
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


def tables(found: WeaverAnalysis) -> tuple[Table, ...]:
    """Greatest values of the tracks, cams, motions."""
    weaver = found.weaver
    tracks = weaver.cyclogram.tracks
    peaks = Table(
        "tracks",
        "Tracks of the head; the handler at its tip",
        columns(
            "track",
            "driven by",
            "stroke [mm]",
            "largest speed [m/s]",
            "largest acceleration [m/s^2]",
            "shortest cycle [s]",
        ),
        tuple(
            (track.name, track.actuator, peak.stroke, peak.speed, peak.acceleration, peak.shortest)
            for track, peak in zip(tracks, weaver.peaks.values(), strict=True)
        ),
    )
    motions = Table(
        "motions",
        "Motions over the cam angle",
        columns("track", "motion", "from [deg]", "to [deg]", "law"),
        tuple(
            (track.name, part.name, part.start, part.end, part.law.name) for track in tracks for part in track.segments
        ),
    )
    return peaks, cams_table(weaver), motions


def figures(found: WeaverAnalysis) -> tuple[Figure, ...]:
    """Cyclogram, grippers in plan view and in motion, cams, accelerations, torque."""
    weaver = found.weaver
    return (
        timing(weaver),
        plan_view(weaver),
        animation(weaver),
        cams_drawing(weaver),
        _accelerations(weaver),
        torque_plot(weaver),
    )


def timing(weaver: Weaver) -> Timing:
    """The head's cyclogram as a figure."""
    note = "Order of the motions: thesis, 2.2.3; the angles are assumed by this project, the thesis prints none."
    return draw(weaver.cyclogram, "One knot: the five cams of the head", note)


def _accelerations(weaver: Weaver) -> Plot:
    angle, w = np.linspace(0, turn, 721), weaver.cyclogram.speed
    arms = {HANDLER: weaver.handler_radius}
    series = tuple(
        Series(track.name, angle, sample(track, angle).bend * w**2 * arms.get(track.name, 1.0))
        for track in weaver.cyclogram.tracks
    )
    axes = Axis("cam angle", "deg"), Axis("acceleration", "m/s^2")
    note = f"at {60 / weaver.cycle:.3g} knots a minute; the handler at its tip"
    return Plot("acceleration", "Acceleration of the tools", *axes, series, note=note)
