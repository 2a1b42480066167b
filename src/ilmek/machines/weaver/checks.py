"""The checks of a knotting head: tools, knot, cams, opener, magazine, drive."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from ilmek.cams.loaded_plate_cam import PRESSURE_LIMIT, STEEL
from ilmek.elements.belts import MESHING
from ilmek.elements.duty import MARGIN
from ilmek.machines.weaver.bracket_strength import bracket_checks
from ilmek.machines.weaver.cam_belt import PROFILE
from ilmek.machines.weaver.design import Weaver, head_relations
from ilmek.machines.weaver.drive_parts import CAM_BELT as CAM_BELT_PART
from ilmek.machines.weaver.followers import FOLLOWER_STEEL, FORK_STRESS, follower_id, fork_stress
from ilmek.machines.weaver.grippers import YARN_TOLERANCE
from ilmek.machines.weaver.hub_keys import key_checks
from ilmek.machines.weaver.knife import KNIFE, knife_checks
from ilmek.machines.weaver.lever_parts import LEVER_STRESS, lever_id, lever_stress
from ilmek.machines.weaver.limits import HeadLimits
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.moved import moved_mass
from ilmek.machines.weaver.opener_checks import opener_checks, room_checks
from ilmek.machines.weaver.parts import BEARING, LEAST_LIP, MOTOR, SHAFT, bearing_of, cam_id, case_plates, lip_of
from ilmek.machines.weaver.return_springs import spring_id, stress_of
from ilmek.machines.weaver.rods import ROD_STRESS, ROD_TIME, rod_bend, rod_stress, rod_time_ratio
from ilmek.machines.weaver.stations import sheet
from ilmek.machines.weaver.tool_parts import CENTRE_GRIPPER, OPENER_PLATE, PILE_HANDLER, SIDE_GRIPPER, SLEY_BAR
from ilmek.machines.weaver.widths import case_width
from ilmek.report import Check, at_least, at_most, must
from ilmek.timing.cyclogram import Relation, check_all
from ilmek.units import format_quantity

LONGER = "set a longer knot_cycle"
SAME = 1e-9
"""Relative difference of times that is rounding."""

HAND_KNOT = 2.4
"""Time of the best hand weaver per knot [s]: 25 knots a minute."""


def head_checks(weaver: Weaver, limits: HeadLimits) -> tuple[Check, ...]:
    """All checks of a head."""
    return (
        *_tool_checks(weaver),
        *_order_checks(weaver),
        *(() if weaver.params.with_arms else _knot_checks(weaver)),
        *cam_checks(weaver),
        *_drive_checks(weaver, limits),
        *opener_checks(weaver),
        *room_checks(weaver),
        *(bracket_checks(weaver) if sheet(weaver) > 0 else ()),
    )


def _tool_checks(weaver: Weaver) -> tuple[Check, ...]:
    """Limits of every track, the carriage's step, the hand weaver's time."""
    params = weaver.params
    checks: list[Check] = []
    for name, peak in weaver.peaks.items():
        speed, acceleration = (rounded(value, 12) for value in (peak.speed, peak.acceleration))
        source, moved = ("parameter speed_limit", "acceleration_limit"), _moved(name)
        checks += [
            at_most(f"{name}: speed", speed, params.speed_limit, "m/s", source[0]).with_cure(LONGER, *moved),
            at_most(f"{name}: acceleration", acceleration, params.acceleration_limit, "m/s^2", source[1]).with_cure(
                LONGER, *moved
            ),
        ]
    longer = "set a longer cycle (knot_cycle of a loom), or higher limits of speed and acceleration"
    case = case_plates(weaver)
    step, hand = "set a longer knot_cycle, or a faster carriage", "set a shorter knot_cycle, or higher limits"
    return (
        *checks,
        at_most(
            "carriage: step to the next knot", weaver.carriage_step, weaver.carriage_window, "s", "tools out"
        ).with_cure(step, *case),
        at_most("knot cycle", weaver.cycle, HAND_KNOT, "s", "best hand weaver: 25 knots a minute").with_cure(
            hand, *case
        ),
        at_most("knot cycle, as required", weaver.cycle, weaver.params.cycle, "s", _cycle_source(weaver)).with_cure(
            longer, *case
        ),
    )


def _cycle_source(weaver: Weaver) -> str:
    """The parameter, and what lets a knot take longer than it."""
    if weaver.cycle <= weaver.params.cycle:
        return "parameter cycle"
    limited = weaver.shortest >= weaver.cycle * (1 - SAME)
    return f"parameter cycle; {f'limits of the {weaver.limiting}' if limited else 'time of the arms'} allow no less"


def _order_checks(weaver: Weaver) -> tuple[Check, ...]:
    cure = "leave the tools' angles to the steps of the turn, or set a longer knot_cycle"

    def moved(relation: Relation) -> tuple[str, ...]:
        tracks = (track for track in (relation.first.track, relation.then.track) if track in weaver.peaks)
        return tuple(dict.fromkeys(part for track in tracks for part in _moved(track)))

    return tuple(
        replace(check, cure=cure, parts=moved(relation))
        for relation in head_relations(weaver)
        for check in check_all(weaver.cyclogram, [relation])
    )


def _rod_checks(weaver: Weaver) -> Iterator[Check]:
    """The side grippers' rods bear the yarn's pull, and their motion leaves little vibration."""
    by, params = weaver.grippers, weaver.params
    pull = "pull of the yarn assumed by this project: parameter forces.yarn_pull"
    source = f"parameter clearance; {pull}"
    yield at_most("bend of a side gripper by the yarn", rod_bend(params, by), params.clearance, "mm", source).with_cure(
        "set a thicker weaver.finger", SIDE_GRIPPER
    )
    source = f"capillary tube, fatigue limit over 1.5; {pull}"
    yield at_most("stress of a side gripper's rod", rod_stress(params, by), ROD_STRESS, "MPa", source).with_cure(
        "set a thicker weaver.finger", SIDE_GRIPPER
    )
    title = "time of the side grippers' motion, over their rods' natural period"
    value = rod_time_ratio(params, by, weaver.cyclogram)
    yield at_least(title, value, ROD_TIME, "1", "residual vibration of about 1 %; assumed by this project").with_cure(
        "set a thicker weaver.finger, or a longer cycle", SIDE_GRIPPER
    )


def _knot_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The required knot is tied; the yarn is long enough, for the knot and between the grippers; they have room."""
    by, params, yarn, grippers = weaver.grippers, weaver.params, YARN_TOLERANCE, (SIDE_GRIPPER, CENTRE_GRIPPER)
    tied = float(weaver.knot_tied == params.knot)
    asymmetric = "set knotting=arms: arms tie it; or knot=symmetric"
    cure = asymmetric if params.knot == "asymmetric" else "leave the grippers' dimensions to the design"
    return (
        at_least(f"{params.knot} knot tied", tied, 1.0, "", f"proof: {weaver.knot_why}").with_cure(cure, *grippers),
        at_most(
            "yarn needed between the grippers", by.yarn_taut_max, by.apart + yarn, "mm", "yarn held between them"
        ).with_cure("set a longer knot_yarn", SIDE_GRIPPER),
        at_least(
            "yarn drawn", weaver.drawn + yarn, params.billed, "mm", "yarn bill: carpet.pile, of this knot"
        ).with_cure("leave knot_yarn to the bill", PILE_HANDLER),
        at_least(
            "room of the side grippers", by.gripper_clearance + yarn, params.clearance, "mm", "parameter clearance"
        ).with_cure("leave crossing_turn to the design, or set thinner fingers", *grippers),
        *_rod_checks(weaver),
    )


def cam_checks(weaver: Weaver) -> Iterator[Check]:
    """Cams within their limits and the head."""
    params, cams = weaver.params, weaver.cams
    worst, widest = max(cams, key=lambda cam: cam.pressure_max), max(cams, key=lambda cam: cam.radius)
    sharpest, steep = min(cams, key=lambda cam: cam.convex_radius), max(cams, key=lambda cam: cam.pressure_angle)
    larger = "set a larger weaver.cam_room, shorter strokes, or a larger weaver.lever"
    title, value, limit = f"pressure angle, {steep.name}", rounded(steep.pressure_angle, 9), params.pressure_angle_limit
    yield at_most(title, value, limit, "deg", "limit").with_cure("shorter strokes", cam_id(steep.name))
    yield at_most(
        f"roller, {sharpest.name}", params.roller_radius, sharpest.convex_radius, "mm", "no undercut"
    ).with_cure("set a smaller weaver.roller_radius", cam_id(sharpest.name))
    yield at_most(f"Hertz pressure, {worst.name}", worst.pressure_max, PRESSURE_LIMIT, "MPa", STEEL.name).with_cure(
        "set a larger weaver.cam_thickness, or lighter tools", cam_id(worst.name)
    )
    yield _case_check(weaver)
    yield at_most(f"diameter, {widest.name}", 2 * widest.radius, params.cam_room, "mm", "cam_room").with_cure(
        larger, cam_id(widest.name)
    )
    yield _mass_check(weaver)
    yield _fork_check(weaver)
    yield _lever_check(weaver)
    yield _spring_check(weaver)
    yield _closure_check(weaver)


def _fork_check(weaver: Weaver) -> Check:
    """The most loaded fork of a follower bears its roller's force."""
    worst = max(weaver.cams, key=lambda cam: cam.contact_max)
    source = f"{FOLLOWER_STEEL.name}, fatigue limit over 2; assumed by this project"
    return at_most(
        f"stress of the follower, {worst.name}", fork_stress(weaver, worst), FORK_STRESS, "MPa", source
    ).with_cure("set a larger weaver.cam_gap, or lighter tools", follower_id(worst.name))


def _mass_check(weaver: Weaver) -> Check:
    """No cam moves more than the mass for which it is designed, at its tool."""
    tools = weaver.tool_bodies
    masses = {cam.name: moved_mass(weaver, cam.name) for cam in weaver.cams}
    most = max(masses, key=lambda track: masses[track] / tools.moved(track))
    return at_most(
        f"mass that a cam moves, {most}", masses[most], tools.moved(most), "kg", "parameter tool_mass"
    ).with_cure("set a larger weaver.tool_mass", *_moved(most))


def _lever_check(weaver: Weaver) -> Check:
    """The most loaded lever bears its cam's force at its axle."""
    worst = max(weaver.shape.levers, key=lambda track: lever_stress(weaver, weaver.cam(track)))
    source = f"{STEEL.name}, fatigue limit over 2; assumed by this project"
    return at_most(
        f"stress of the lever, {worst}", lever_stress(weaver, weaver.cam(worst)), LEVER_STRESS, "MPa", source
    ).with_cure("set a larger weaver.cam_thickness, or a lower tension of the warps", lever_id(worst))


def _spring_check(weaver: Weaver) -> Check:
    """A return spring for each cam, but of cams with a groove, whose wire bears its solid length."""
    tracks = [cam.name for cam in weaver.cams] if weaver.params.closure == "spring" else []
    stresses = {track: stress for track in tracks if (stress := stress_of(weaver, track)) is not None}
    none = [track for track in tracks if track not in stresses]
    source = f"EN 13906-1, in the room of the head{': none for ' + ', '.join(none) if none else ''}"
    if stresses:
        worst = max(stresses, key=lambda track: stresses[track][0] / stresses[track][1])
        value, limit = (format_quantity(stress, "MPa", 3) for stress in stresses[worst])
        source += f"; {worst}: {value} at its solid length, allowed {limit}"
    cure = "set a smaller weaver.contact_force, a larger weaver.pinion, or weaver.closure=groove"
    parts = tuple(follower_id(track) for track in none) or tuple(spring_id(track) for track in stresses)
    return must("return springs", not none, source).with_cure(cure, *(parts or (follower_id(weaver.cams[0].name),)))


def _belt_check(weaver: Weaver) -> Check:
    """The belt of the cam shaft bears the torque."""
    cure = "set a wider weaver.cam_belt, lighter tools, a longer knot_cycle, or a lower tension"
    pull, allowed = MARGIN * weaver.belt.pull, weaver.belt.allowed
    source = f"{PROFILE.name}, {MESHING} teeth in mesh, margin {MARGIN:g}"
    return at_most("pull of the cam shaft's belt", pull, allowed, "N", source).with_cure(cure, CAM_BELT_PART)


def _case_check(weaver: Weaver) -> Check:
    """The case within the head's width."""
    wide, parts = case_width(weaver.params), (*case_plates(weaver), SHAFT)
    cure = "leave head_width to the design, or set thinner cams"
    return at_most("cams beside each other", wide, weaver.width, "mm", "head_width").with_cure(cure, *parts)


def _closure_check(weaver: Weaver) -> Check:
    """What holds the followers to their cams: room in the groove, or springs up to the speed."""
    params, cams = weaver.params, weaver.cams
    if params.closure == "groove":
        hollow = min(cams, key=lambda cam: cam.concave_radius)
        name, roller = f"roller in the groove, {hollow.name}", params.roller_radius
        cure, parts = "set a smaller weaver.roller_radius", (cam_id(hollow.name),)
        return at_most(name, roller, hollow.concave_radius, "mm", "").with_cure(cure, *parts)
    loose = min(cams, key=lambda cam: cam.lift_off)
    name, speed = f"speed before lift-off, {loose.name}", weaver.cyclogram.speed
    cure, parts = "set closure=groove, or lighter tools", (cam_id(loose.name),)
    return at_most(name, speed, loose.lift_off, "rpm", "return springs").with_cure(cure, *parts)


def _drive_checks(weaver: Weaver, limits: HeadLimits) -> tuple[Check, ...]:
    """The cutter within its time, a motor and bearings for the shaft."""
    return (
        at_most("cutter", limits.cutting_time, limits.cutting_window, "s", "draw to presenting").with_cure(
            LONGER, KNIFE
        ),
        *knife_checks(weaver),
        *key_checks(weaver),
        must(
            "motor of the cam shaft",
            weaver.drive.servo is not None,
            f"motors of the table; {weaver.drive.torque_max:.3g} Nm",
        ).with_cure("set lighter tools, a longer knot_cycle, or a lower tension", MOTOR, SHAFT),
        _belt_check(weaver),
        must(
            "bearings of the cam shaft",
            bearing_of(weaver) is not None,
            "bearing table, ISO 281; 100 million knots, assumed by this project",
        ).with_cure(
            "set a thicker weaver.shaft, or lighter tools", *((SHAFT, BEARING) if bearing_of(weaver) else (SHAFT,))
        ),
        *_lip_check(weaver),
    )


def _lip_check(weaver: Weaver) -> tuple[Check, ...]:
    """Side plates deep enough for the bearings and for a lip behind them, which holds the cam shaft along its axis."""
    if not case_plates(weaver):
        return ()
    lip = at_least("lip of a side plate behind its bearing", lip_of(weaver), LEAST_LIP, "mm", "assumed by this project")
    return (lip.with_cure("set a thicker weaver.side_plate", *case_plates(weaver)),)


def rounded(value: float, digits: int) -> float:
    """The value in significant digits, for a check of what was made for exactly its limit."""
    return float(f"{value:.{digits}g}")


def _moved(track: str) -> tuple[str, ...]:
    """Ids of the parts that a track moves, and of its follower."""
    return (*_MOVED[track], follower_id(track))


_MOVED: Mapping[str, tuple[str, ...]] = {
    SIDE_GRASP: (),
    SIDE_MOTION: (SIDE_GRIPPER, OPENER_PLATE),
    CENTRE_GRASP: (),
    CENTRE_MOTION: (CENTRE_GRIPPER,),
    HANDLER: (PILE_HANDLER,),
    SLEY: (SLEY_BAR,),
    OPENER: (OPENER_PLATE,),
}
"""Parts that a track moves, beside its follower."""
