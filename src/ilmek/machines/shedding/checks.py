"""The checks of shedding cams. Of checks that every shaft has, the one of the shaft that keeps it worst counts."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

from ilmek.cams.limits import convex_radius_min, pressure_angle_max
from ilmek.cams.programme import TURN
from ilmek.elements.reducers import reducer_check
from ilmek.elements.shoulders import LEAST_SAFETY
from ilmek.machines.shedding.analysis import SheddingAnalysis, lengthening_of, strain_of
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.phases import required_window
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.stack_choice import buckling_check, height_check, line_check, plate_checks
from ilmek.machines.shedding.tree import reed
from ilmek.machines.shedding.warp import nose_radius, shed_warp
from ilmek.report import Check, at_least, at_most
from ilmek.report.verdict import weight
from ilmek.units import format_quantity

THESIS = "thesis, 3.2"
STRONGER = "set more spans, a lower tension, or more shafts"


def checks(analysis: SheddingAnalysis) -> tuple[Check, ...]:
    """Cams, plates, shed, shafts, bearings, motors and warps."""
    design = analysis.design
    params, shares = design.params, design.first.stack.shares

    def of(checks_of: Callable[[CamShaft], Iterator[Check]], *names: str) -> Iterator[Check]:
        """The worst of the shafts' checks, which concern these parts of every shaft."""
        parts = tuple(part_id(name, index) for name in names for index in range(len(design.shafts)))
        return (replace(check, parts=parts) for check in worst([tuple(checks_of(shaft)) for shaft in design.shafts]))

    return (
        *of(_cam_checks, "shedding-cam"),
        *(
            replace(check, parts=(part_id("shedding-cam"), part_id("guide-cam")))
            for check in plate_checks(params, shares)
        ),
        *of(_nose_checks, "shedding-cam"),
        *_shed_checks(analysis),
        *of(_shaft_checks, "cam-shaft"),
        *of(_bearing_checks, "bearing"),
        *of(_key_checks, "key", "cam-shaft"),
        *of(_motor_checks, "motor", "reducer"),
        *_reed_checks(design),
        *worst([tuple(_warp_checks(shaft)) for shaft in design.shafts]),
    )


def _reed_checks(design: SheddingDesign) -> Iterator[Check]:
    """Deflections of the reeds."""
    reeds = [reed(design, index) for index in range(len(design.shafts))]
    parts = tuple(part_id("reed-baulk", index) for index in range(len(reeds)))
    return (replace(check, parts=parts) for check in worst([tuple(own.checks()) for own in reeds if own is not None]))


def worst(of_shafts: list[tuple[Check, ...]]) -> tuple[Check, ...]:
    """Of the checks with one name the one that fails most, or that is nearest to its limit."""
    return tuple(max(alike, key=_severity) for alike in zip(*of_shafts, strict=True))


def _severity(check: Check) -> tuple[bool, float]:
    if not check.ok:
        return True, weight(check)
    return False, -weight(check)


def _cam_checks(shaft: CamShaft) -> Iterator[Check]:
    params, cam = shaft.params, shaft.cam
    buckling, norton = f"{THESIS}: a thin cam must not buckle", "Norton, Cam Design and Manufacturing, 7"
    larger = "set a larger prime_radius"
    mu = pressure_angle_max(cam).value
    yield at_most("pressure angle", mu, params.pressure_angle_limit, "deg", buckling).with_cure(larger)
    title, value = "convex radius of the pitch curve (no undercut)", convex_radius_min(cam).value
    yield at_least(title, value, cam.roller_radius, "mm", f"{norton}: rho > roller radius").with_cure(larger)
    bore = shaft.prime_radius_for_bore
    yield at_least("prime radius round the bore", cam.prime_radius, bore, "mm", "bore_wall").with_cure(larger)


def _nose_checks(one: CamShaft) -> Iterator[Check]:
    """Buckling of the nose, and its stress under the warp: T / rho along its edge, over the thickness."""
    force, critical = one.buckling()
    yield buckling_check(one.params.buckling_safety * force, critical)
    warp, radius = shed_warp(one.params), nose_radius(one.cam)
    if warp is not None and radius > 0:
        stress = float(warp.tension_at(one.params.lift)) / (radius * one.stack.thickness)
        source = "yield strength; T / (rho t) of the warp round the nose"
        yield at_most("stress at the nose", stress, one.params.strength, "MPa", source).with_cure("set a lower tension")


def _shed_checks(analysis: SheddingAnalysis) -> Iterator[Check]:
    design, params = analysis.design, analysis.design.params
    higher = "set a larger lift, or a lower shuttle_height"
    yield at_least(
        "shed for the shuttle", design.shed_opening, params.shuttle_height, "mm", "shuttle_height"
    ).with_cure(higher)
    yield from _window_checks(analysis)
    yield at_most(
        "one parity down while the other is up", params.lifted_angle, TURN / 2, "deg", f"{THESIS}, Fig. 3.19"
    ).with_cure("set a shorter rise, dwell or fall")
    if params.guideway:
        source = "Fig. 3.18 of the thesis; assumed by this project: parameter guideway_tolerance"
        yield at_most(
            "step of the shuttle's guideway on the tips", design.guideway.step, params.guideway_tolerance, "mm", source
        ).with_cure("set phase=together and more spans, or guideway=no where the shuttle has a guide of its own")
    yield from _span_checks(design)
    yield from _neighbour_checks(design)


def _window_checks(analysis: SheddingAnalysis) -> Iterator[Check]:
    """The shuttle's window against the required one, if any."""
    design, required = analysis.design, analysis.design.params.shuttle_angle
    if required is None and design.params.phase == "flattest":
        first, last = analysis.together.window()
        required = required_window(design.params, last - first)
    if required is not None:
        wider = "set a larger lift or dwell, or a lower shuttle_height"
        yield at_least(
            "window of the shuttle", design.shuttle_window_angle, required, "deg", "shuttle_angle"
        ).with_cure(wider)


def _span_checks(design: SheddingDesign) -> Iterator[Check]:
    """The guides against the holds of the warps at both ends, and the shed lines of the shafts against each other."""
    first, last = design.first, design.shafts[-1]
    spans = design.params.spans_of_warp
    if spans is None:
        return
    ends = (("front", first, spans[0], "front_span"), ("back", last, spans[1], "back_span"))
    for name, shaft, span, parameter in ends:
        yield at_most(
            f"guides and cams clear of the {name} hold", shaft.reach, span, "mm", f"{parameter} or half_span; shaft_gap"
        ).with_cure(f"set a longer {parameter}, or a lower lift")
    if len(design.shafts) > 1:
        yield line_check([one.params.lift for one in design.shafts], [spans[0] + one.beyond for one in design.shafts])


def _neighbour_checks(design: SheddingDesign) -> Iterator[Check]:
    """Several shafts: room for all of them; their guides are shaft_gap from each other by the layout."""
    if len(design.shafts) > 1:
        yield height_check(design.params, design.shafts[-1].beyond)


def _shaft_checks(one: CamShaft) -> Iterator[Check]:
    params, shaft = one.params, one.shaft
    width = sum(one.numbers) * one.stack.shares.pitch
    room = shaft.length + one.stack.shares.pitch - params.cloth.warp_pitch
    longer = "set a longer shaft_length"
    deflection = f"{THESIS} and eq. 3.4, 1 mm"
    yield at_most("width of the cams on the shaft", width, room, "mm", "shaft_length").with_cure(longer)
    yield at_most("slope of the shaft", shaft.slope, params.slope_limit, "rad", f"{THESIS} and eq. 3.5").with_cure(
        STRONGER
    )
    yield at_most("deflection of the shaft", shaft.deflection, params.deflection_limit, "mm", deflection).with_cure(
        STRONGER
    )
    lag, steel = "twist_limit: lag of the far cams", "yield strength, von Mises"
    lower = "set a lower tension, or more shafts"
    yield at_most("twist of the shaft", shaft.twist, params.twist_limit, "deg", lag).with_cure(lower)
    yield at_most("stress of the shaft", shaft.stress, params.strength, "MPa", steel).with_cure(STRONGER)
    yield at_least("fatigue of the shaft", shaft.endurance, 1.0, "1", "Goodman, hot rolled, 99 %").with_cure(STRONGER)
    half = "half of its critical speed"
    yield at_most("speed of the shaft", params.speed, shaft.critical / 2, "rpm", half).with_cure("set more spans")


def _bearing_checks(shaft: CamShaft) -> Iterator[Check]:
    params, seat, bar = shaft.params, shaft.shaft.seat, shaft.shaft.bar
    life, stronger = params.bearing_life, "set more spans, or another bearing"
    yield at_least("life of the bearings", seat.life, life, "h", "ISO 281, bearing_life").with_cure(stronger)
    bore, torsion = seat.bearing.bore, "torsion, von Mises"
    yield at_least("bore of the bearing for the torque", bore, seat.journal, "mm", torsion).with_cure(stronger)
    larger = "set another bearing, more spans, or a lower tension"
    shoulder, source = (
        seat.shoulder,
        f"yield strength over 1.2, von Mises; {format_quantity(bar, 'mm')} to {format_quantity(bore, 'mm')}",
    )
    yield at_most(
        "stress of the driven journal", shoulder.stress, params.strength / LEAST_SAFETY, "MPa", source
    ).with_cure(larger)
    source = f"Goodman, DIN 743-2, fillet of {format_quantity(shoulder.fillet, 'mm')}"
    yield at_least(
        "fatigue of the driven journal at its shoulder", shoulder.safety, LEAST_SAFETY, "1", source
    ).with_cure(larger)
    yield at_most("bore of the bearing in the bar", bore, bar, "mm", "journal of the bar").with_cure(stronger)
    source, thicker = shaft.nut.designation, "set a thicker shaft_bar, or a smaller bearing"
    yield at_least("nut of the cams over the journal", shaft.nut.core, bore, "mm", source).with_cure(thicker)
    source = f"{source} at {format_quantity(shaft.nut.torque, 'Nm', 3)}; friction of oiled sheets"
    torque, held = shaft.cam_torque(), shaft.friction_torque
    yield at_most("torque of a cam on its clamped sheets", torque, held, "Nm", source).with_cure("set a lower tension")


def _key_checks(shaft: CamShaft) -> Iterator[Check]:
    yield shaft.driven_end.check("cam shaft", "set another bearing, or more shafts", ())


def _motor_checks(shaft: CamShaft) -> Iterator[Check]:
    drive = shaft.drive
    continuous, other = "continuous torque of the motor", "set another ratio, or more shafts"
    yield at_most("motor torque", drive.motor_torque, drive.motor_limit, "Nm", continuous).with_cure(other)
    given, load = drive.motor.torque if drive.motor else 0.0, shaft.shaft.torque
    yield reducer_check("reducer of the cam shaft", drive.reducer, given, load, part_id("reducer"))


def _warp_checks(shaft: CamShaft) -> Iterator[Check]:
    """Strain and tension of a lifted warp; nothing where only its force is given."""
    params, warp = shaft.params, shed_warp(shaft.params)
    if warp is None:
        return
    looser = "set a longer warp_length, more compensation, or a lower lift"
    tension = float(warp.tension_at(params.lift))
    breaking = "breaking force of the warp over breaking_safety (assumed by this project)"
    yield at_most("tension of a lifted warp", tension, params.strongest_tension, "N", breaking).with_cure(looser)
    strain = strain_of(params, lengthening_of(params))
    if strain is not None and math.isfinite(strain):
        yield at_most("strain of a lifted warp", strain, params.strain_limit, "%", "strain_limit").with_cure(looser)
