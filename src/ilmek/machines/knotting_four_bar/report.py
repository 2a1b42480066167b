"""Analysis, checks, tables and warnings of a knotting four-bar."""

import numpy as np

from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.links import MACHINE_NAME, SHAFT, made_parts
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.knotting_four_bar.posed import PosedFourBar
from ilmek.machines.knotting_four_bar.sides import SidesAnalysis, analyse_sides
from ilmek.machines.linkage_strength import LinkageStrength, equilibrium_test, strength_checks
from ilmek.machines.strength_tables import strength_table
from ilmek.records import group, record
from ilmek.report import Check, Table, at_least, at_most, columns, must
from ilmek.units import deg, format_quantity, turn

BALANCE = 1e-9
TRANSMISSION, DISTANCE = 40 * deg, 5 * deg
RULE = "rule of thumb for rockers"
GEAR, MOTOR = f"{MACHINE_NAME}/gear", (f"{MACHINE_NAME}/motor",)
STRONGER = "set a larger width or thickness, or a smaller grip_force"

MET = 1e-9
"""Error of a position, of the extent of the poses, and of an angle [rad], that is rounding."""


@record
class KnottingFourBarAnalysis:
    """A design, the strength of its links, clearances and knot of both sides; `sides` is None where there is one."""

    design: KnottingFourBar = group()
    strength: LinkageStrength = group()
    sides: SidesAnalysis | None = group()


def analyse(design: KnottingFourBar) -> KnottingFourBarAnalysis:
    """The design with the analysis of both sides."""
    sides = None if design.sides is None else analyse_sides(design.params, design.sides, design.onward)
    return KnottingFourBarAnalysis(design, design.strength, sides)


def checks(analysis: KnottingFourBarAnalysis) -> tuple[Check, ...]:
    """Dead point and transmission angle, servo; both sides, and the knot that they tie."""
    design = analysis.design
    distance = design.dead_point_distance
    parts = {**made_parts(design.params, design.hole).ids, "O1": SHAFT}
    dead_point = at_least("crank's distance from its dead point", distance, DISTANCE, "deg", "rule of thumb")
    return (
        *((dead_point,) if design.range else ()),
        at_least("transmission angle", design.transmission_angle, TRANSMISSION, "deg", RULE),
        *strength_checks(analysis.strength, stronger=STRONGER, parts=parts),
        _servo_check(design),
        *(() if analysis.sides is None else _side_checks(design, analysis.sides)),
    )


def self_tests(analysis: KnottingFourBarAnalysis) -> tuple[Check, ...]:
    """The power balances, the poses in a forward simulation, both sides against each alone."""
    design, sides = analysis.design, analysis.sides
    one = at_most("power balance of the forces", design.at.forces.power_error, BALANCE, "1", "virtual power")
    posed = () if design.posed is None else _pose_tests(design.posed)
    return (one, equilibrium_test(analysis.strength), *posed, *(() if sides is None else _side_tests(sides)))


def _pose_tests(posed: PosedFourBar) -> tuple[Check, ...]:
    distances, angles = posed.errors
    points = posed.synthesis.poses.points
    extent = float(np.max(np.abs(points - points[0])))
    source = "forward simulation"
    return (
        at_most("hand at the poses, missed, of their extent", float(np.max(distances)) / extent, MET, "1", source),
        at_most("coupler at the poses, missed", float(np.max(angles)), MET, "deg", source),
    )


def _side_checks(design: KnottingFourBar, found: SidesAnalysis) -> tuple[Check, ...]:
    params, sides = design.params, found.sides
    bending = sides.gears.bending(sides.tooth)
    return (
        at_least("clearance of the two sides", found.side_clearance_min, params.side_clearance, "mm", "side_clearance"),
        at_most("bending of the gears' teeth", bending, params.gear_stress, "MPa", "gear_stress; Lewis").with_cure(
            "", GEAR
        ),
        _knot_check(params, found),
    )


def _servo_check(design: KnottingFourBar) -> Check:
    drive = design.drive
    torque, speed = format_quantity(drive.torque, "N*m"), format_quantity(drive.speed, "rad/s")
    cure = f"set a lower speed, or poses farther from a dead point: {torque} at {speed} are required"
    return must("a servo turns the crank", drive.servo is not None, "servo table, gears of stock").with_cure(
        cure, *MOTOR
    )


def _knot_check(params: KnottingFourBarParams, analysis: SidesAnalysis) -> Check:
    """The hands tie a knot on the two warps between the sides; the cure names the warps on which they tie one."""
    cure = "set other poses: on no distance of the warps is a knot tied"
    if analysis.knot_pitches is not None:
        least, most = (format_quantity(end, "mm") for end in analysis.knot_pitches)
        cure = f"set warp_pitch to {least} to {most}: there the hands tie a {analysis.wider}; or set other poses"
    title = "knots tied on the two warps"
    source = f"{format_quantity(params.warp_pitch, 'mm')} apart; crossings of the yarn: {analysis.proof.why}"
    return at_least(title, float(analysis.proof.tied is not None), 1.0, "1", source).with_cure(cure)


def _side_tests(analysis: SidesAnalysis) -> tuple[Check, ...]:
    sides = analysis.sides
    error = max(one.torque_error for one in (sides.moving, sides.standing))
    return (
        at_most("torque of both sides coupled, against each alone", error, BALANCE, "1", "mirror image"),
        at_most("power balance of both sides", sides.moving.forces.power_error, BALANCE, "1", "virtual power"),
    )


def warnings(analysis: KnottingFourBarAnalysis) -> tuple[str, ...]:
    """What to do about a dead point that is near."""
    design = analysis.design
    if design.dead_point_distance >= DISTANCE:
        return ()
    distance, angle = (format_quantity(value, "deg") for value in (design.dead_point_distance, design.crank_angle))
    if design.instead is None:
        return (f"in its motion through the poses the crank comes within {distance} of a dead point",)
    params = design.instead.params
    links = {"r0": params.ground, "r1": params.crank, "r2": params.coupler, "r3": params.rocker}
    lengths = ", ".join(f"{alias} {format_quantity(length, 'mm')}" for alias, length in links.items())
    torque, greatest = (format_quantity(state.torque_max, "N*m") for state in (design.at, design.instead.state))
    wrong = f"at {angle} the crank is {distance} from its dead point: {torque} move it, coupler and rocker are in line"
    return (f"{wrong}; use the four-bar of both arms instead: {lengths}, at most {greatest} at the report's poses",)


def tables(analysis: KnottingFourBarAnalysis) -> tuple[Table, ...]:
    """Arms, four-bars and poses; gears; forces, masses, and the four-bar to use instead."""
    design = analysis.design
    return (
        *(() if design.posed is None else _pose_tables(design.posed)),
        *(() if analysis.sides is None else (_gear_table(analysis.sides),)),
        _force_table(design),
        *strength_table(analysis.strength, "knotting-four-bar"),
        _part_table(design),
        *(() if design.instead is None else (_instead_table(design.instead),)),
    )


def _pose_tables(posed: PosedFourBar) -> tuple[Table, ...]:
    found, best = posed.synthesis, posed.synthesis.best.candidate
    angles = (f"θ1 at pose {at} [deg] 7" for at in (1, 2, 3))
    lengths = ("ground a0 [mm] 7", "first link a1 [mm] 7", "second link a2 [mm] 7", "pivot x [mm] 7", "pivot y [mm] 7")
    arms = tuple(
        (
            at,
            *(arm.ground, arm.first, arm.second, arm.pivot.real, arm.pivot.imag),
            *arm.first_angles(found.poses.points, found.poses.angles).tolist(),
        )
        for at, arm in enumerate(found.dyads, 1)
    )
    title = "Arms through the poses with their pivots on the ground ray"
    arm_table = Table("knotting-arms", title, columns("arm", *lengths, *angles), arms, brief=True)

    heads = columns(
        *("driven arm", "ground [mm] 7", "crank [mm] 7", "coupler [mm] 7", "rocker [mm] 7", "class"),
        *("least transmission angle [deg]", "verdict"),
    )
    four_bars = tuple(
        (
            choice.crank + 1,
            *choice.candidate.four_bar.lengths,
            choice.candidate.grashof.kind,
            choice.candidate.least_transmission,
            "to build" if choice is found.best else "; ".join(choice.defects.values()) or "no defect",
        )
        for choice in found.choices
    )
    four_bar_table = Table("knotting-four-bars", "The arms joined as one four-bar", heads, four_bars, brief=True)

    heads = columns(
        *("pose", "crank angle [deg] 7", "met as number", "branch", "error of the hand [mm]"),
        *("error of the coupler [deg]", "drive torque [N*m]"),
    )
    values = zip(posed.crank_angles, best.positions, *posed.errors, posed.state.torque, strict=True)
    poses = tuple(
        (at, float(angle), best.order.index(at) + 1, met.branch, float(distance), float(turned), float(torque))
        for at, (angle, met, distance, turned, torque) in enumerate(values, 1)
    )
    pose_table = Table("knotting-poses", "The poses, from the four-bar's motion", heads, poses, brief=True)
    return arm_table, four_bar_table, pose_table


def _gear_table(analysis: SidesAnalysis) -> Table:
    gears, tooth = analysis.sides.gears, analysis.sides.tooth
    heads = columns(
        *("distance of axes [mm] 7", "module [mm]", "teeth of each", "width [mm]", "pressure angle [deg]"),
        *("sum of profile shifts", "greatest tooth force [N]", "separating force [N]", "bending [MPa]"),
    )
    row = (
        *(gears.distance, gears.module, gears.teeth, gears.width, gears.pressure_angle, gears.profile_shift),
        *(tooth, gears.separating(tooth), gears.bending(tooth)),
    )
    return Table("knotting-gears", "Gears that couple both cranks", heads, (row,), brief=True)


def _force_table(design: KnottingFourBar) -> Table:
    rows: list[tuple[str, float, float, float]] = []
    for pin, force in (("O2'", "F32"), ("O2", "F12")):
        static, unit, at = (complex(state.pins[pin][0]) for state in (design.static, design.unit, design.at))
        rows += [
            (f"{force}x, on the coupler in {pin} [N]", static.real, unit.real - static.real, at.real),
            (f"{force}y, on the coupler in {pin} [N]", static.imag, unit.imag - static.imag, at.imag),
        ]
    torques = design.drive_torque_static, design.drive_torque_dynamic, float(design.at.torque[0])
    # The quantities have no common unit: it stands beside each.
    heads = columns("quantity", "at rest [] 7", "for each (rad/s)² [] 7", "at speed")
    title = "Forces at the crank angle: at rest + speed² times the dynamic part"
    return Table("knotting-forces", title, heads, (*rows, ("M1, on the crank [N·m]", *torques)))


def _part_table(design: KnottingFourBar) -> Table:
    heads = columns("part", "mass [g]", "centre from first pin [mm]", "J about it [g*mm^2]")
    made, hand = design.inertias, "coupler with holder and gripper"
    links = {name: made[name] for name in ("crank", "rocker")} if design.params.link_mass == "made" else design.parts
    named = {**links, hand: made["coupler"]}
    rows = tuple((name, inertia.mass, complex(inertia.centre).real, inertia.moment) for name, inertia in named.items())
    return Table("knotting-parts", "Masses and moments of inertia", heads, rows)


def _instead_table(posed: PosedFourBar) -> Table:
    motion = posed.state.motion
    coupler, rocker = (np.mod(motion.angle(body), turn) for body in ("coupler", "rocker"))
    heads = columns(
        *("pose", "crank angle [deg]", "coupler angle, O2 to O2' [deg]", "rocker angle [deg]", "drive torque [N*m]")
    )
    values = zip(posed.crank_angles, coupler, rocker, posed.state.torque, strict=True)
    rows = tuple((at, *(float(one) for one in row)) for at, row in enumerate(values, 1))
    return Table("knotting-instead", "The four-bar of both arms at the report's poses", heads, rows)
