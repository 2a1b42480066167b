"""The report of the warp tension: checks against the thesis' limits, warnings, tables."""

from collections.abc import Iterator

from ilmek.elements.beam import uniform
from ilmek.elements.bearings import BEARINGS, bearings_for, slope_limit
from ilmek.elements.drive_parts import no_motor
from ilmek.elements.fillet_welds import STRENGTH
from ilmek.elements.reducers import reducer_check
from ilmek.elements.shoulders import LEAST_SAFETY
from ilmek.elements.tubes import TUBES
from ilmek.machines.warp_loads import WarpLoads
from ilmek.machines.warp_tension.analysis import WarpTensionAnalysis
from ilmek.machines.warp_tension.attachment import attachment_checks
from ilmek.machines.warp_tension.cylinders import LEAST_WALL, STUB, Cylinder, cylinders, part_id
from ilmek.machines.warp_tension.design import WarpTensionDesign, outer_radii_min, tubes_within_limits
from ilmek.report import Check, Table, at_least, at_most, columns
from ilmek.units import format_number, format_quantity, mm

THESIS = "thesis, 3.1"
LOCKING, SURE = 0.5, 0.45
"""Largest efficiency of a self-locking reducer, and the one up to which makers guarantee it (unsure up to 0.55)."""

STEP_SHARE = 0.05
"""Largest change of tension by a full step of the motor, over the tension."""

SHOWN_TUBES = 8


def checks(analysis: WarpTensionAnalysis) -> tuple[Check, ...]:
    """Cylinder and drive, spacer, bearings, shaft ends, slots and the warp's strength."""
    return (*_design_checks(analysis.design), *_cylinder_checks(analysis))


TUBE_CURE = "set a larger tube, a lower tension, or a narrower loom"
SPACER_CURE = "set a larger spacer_tube, a lower tension, or a narrower loom"
SLOT_CURE = "set a larger warp pitch, or thinner warps"

_CYLINDER, _SPACER = (part_id("cylinder"),), (part_id("spacer"),)


def _design_checks(design: WarpTensionDesign) -> tuple[Check, ...]:
    params, locking = design.params, f"makers ensure it up to {SURE:g}; in theory 2 - 1/efficiency <= 0, {LOCKING:g}"
    worst = f"worst case: {design.loads.worst_case}; own weight included"
    slope, sag = f"{THESIS}, eq. 3.5 and 3.7; {worst}", f"{THESIS}, eq. 3.4; {worst}"
    locks = at_most("efficiency, to lock itself", params.efficiency, SURE, "1", locking).with_cure(
        "set a lower efficiency, or self_locking=no with a brake", part_id("reducer")
    )
    return (
        at_most("slope in the bearings", design.slope_loaded, params.slope_limit, "rad", slope).with_cure(
            TUBE_CURE, *_CYLINDER
        ),
        at_most("deflection", design.deflection_loaded, params.deflection_limit, "mm", sag).with_cure(
            TUBE_CURE, *_CYLINDER
        ),
        at_most("bending stress", design.stress, params.strength, "MPa", f"yield of the tube; {worst}").with_cure(
            TUBE_CURE, *_CYLINDER
        ),
        *((locks,) if params.self_locking else ()),
        _torque_check(design),
        reducer_check(
            *("reducer of a cylinder", design.reducer, design.motor.torque if design.motor else 0.0),
            *(design.holding_torque, part_id("reducer")),
        ),
    )


def _torque_check(design: WarpTensionDesign) -> Check:
    """The torque at the reducer against that of what turns it."""
    given = design.motor_torque, design.motor_limit, "Nm"
    if design.params.by_hand:
        source, cure = "hands.pull at the crank; thesis, eq. 3.8", "set a larger ratio or crank, or a narrower loom"
        return at_most("torque of a hand wheel", *given, source).with_cure(cure, part_id("hand-wheel"))
    return at_most("motor torque", *given, f"{THESIS}, eq. 3.8").with_cure(
        "set a larger ratio or a longer take_up_time", part_id("motor"), part_id("reducer")
    )


def _cylinder_checks(analysis: WarpTensionAnalysis) -> tuple[Check, ...]:
    params, spacer, case = analysis.design.params, analysis.spacer, f"worst case: {analysis.design.loads.worst_case}"
    under = f"under the slots; {case}"
    return (
        at_most("slope of the spacer", spacer.slope, params.slope_limit, "rad", under).with_cure(SPACER_CURE, *_SPACER),
        at_most("deflection of the spacer", spacer.deflection, params.deflection_limit, "mm", under).with_cure(
            SPACER_CURE, *_SPACER
        ),
        *_end_checks(analysis, case),
        *attachment_checks(params, cylinders(analysis.design)[:2]),
        *_warp_checks(analysis),
    )


def _slope_checks(analysis: WarpTensionAnalysis) -> tuple[Check, ...]:
    """Slopes of the cylinders within their limit, but more than the kinds of their bearings allow."""
    return tuple(
        at_most(
            f"slope of {cylinder.bearing.name}, {cylinder.name}",
            cylinder.slope,
            slope_limit(cylinder.bearing),
            "rad",
            "its kind",
        ).with_cure("set a stiffer tube", part_id(f"{cylinder.name}-bearing"))
        for cylinder in analysis.cylinders
        if slope_limit(cylinder.bearing) < cylinder.slope <= analysis.design.params.slope_limit
    )


def _end_checks(analysis: WarpTensionAnalysis, case: str) -> Iterator[Check]:
    """Bearings, shaft ends and keys of the cylinders."""
    params = analysis.design.params
    tired = min(analysis.cylinders, key=lambda one: one.static_safety)
    weak = min(analysis.cylinders, key=lambda one: one.stub_safety)
    notched = min(analysis.cylinders, key=lambda one: one.end.safety)
    larger = "set a larger bearing, or a lower tension"
    yield from _slope_checks(analysis)
    yield at_least(
        f"static safety, {tired.bearing.name}", tired.static_safety, params.static_safety, "1", f"ISO 76; {case}"
    ).with_cure(larger, part_id(f"{tired.name}-bearing"))
    yield at_least(
        *(f"shaft end of the {weak.name} cylinder", weak.stub_safety, params.stub_safety, "1"),
        f"yield of {STUB.name}; {case}",
    ).with_cure(f"{larger}, or a shorter stub", part_id(f"{weak.name}-end"))
    yield at_least(
        f"fatigue of the shaft end of the {notched.name} cylinder at its shoulder",
        notched.end.safety,
        LEAST_SAFETY,
        "1",
        f"Goodman, DIN 743-2, fillet of {format_quantity(notched.end.fillet, 'mm')}; {case}",
    ).with_cure(f"{larger}, or a shorter stub", part_id(f"{notched.name}-end"))
    welded = max(analysis.cylinders, key=lambda one: one.weld / one.throat)
    yield at_most(
        *(f"weld of the shaft end of the {welded.name} cylinder", welded.weld / welded.throat, STRENGTH, "MPa"),
        f"EN 1993-1-8, throat {format_quantity(welded.throat, 'mm')}; {case}",
    ).with_cure("set a thicker wall, or a lower tension", part_id(f"{welded.name}-end"))
    yield from (
        cylinder.driven_end.check(f"{cylinder.name} cylinder", larger, (part_id(f"{cylinder.name}-key"),))
        for cylinder in analysis.cylinders
        if cylinder.torque > 0
    )


def _warp_checks(analysis: WarpTensionAnalysis) -> tuple[Check, ...]:
    """The warps in their slots, and their strength."""
    params, slots, tension = analysis.design.params, analysis.slots, analysis.tension
    metal = analysis.spacer_wall - slots.depth
    breaks = "breaking force of the warp"
    step = STEP_SHARE * params.cloth.warp_tension
    return (
        at_most("warps beside each other", slots.warp, slots.pitch, "mm", "pitch of the warps").with_cure(SLOT_CURE),
        at_most("warp in its slot", slots.warp, slots.width, "mm", "slots of the spacer").with_cure(
            "set a wider slot_width"
        ),
        at_least("land between slots", slots.land, 0.0, "mm", "pitch of the warps").with_cure(SLOT_CURE, *_SPACER),
        at_least("metal under the slots", metal, LEAST_WALL, "mm", "assumed by this project").with_cure(
            "set a smaller slot_depth, or a spacer_tube with a thicker wall", *_SPACER
        ),
        at_most("tension with the shed open", tension.over.shed, tension.breaking, "N", breaks).with_cure(
            "set a lower tension or lift, or thicker warps"
        ),
        at_most("tension at the beat", analysis.design.loads.beat, tension.breaking, "N", breaks).with_cure(
            "set a lower tension, or thicker warps"
        ),
        at_most(
            f"tension of a {'hand wheel' if params.by_hand else 'motor'}'s step",
            tension.step,
            step,
            "N",
            "a twentieth of the tension",
        ).with_cure("set a larger ratio, or a longer warp"),
    )


def warnings(analysis: WarpTensionAnalysis) -> tuple[str, ...]:
    """Drives that do not hold the warps or are too weak."""
    design, warnings = analysis.design, []
    params, efficiency = design.params, format_number(design.params.efficiency)
    if params.self_locking and not design.reducer.self_locking:
        needed = format_quantity(design.torque_full / (design.reducer.ratio * LOCKING), "Nm")
        warnings.append(
            f"a reducer of efficiency {efficiency} does not lock itself: one that does (at most {LOCKING:g}) "
            f"requires {needed} or more of the motor; or set self_locking=no and hold the warps by a brake"
        )
    if not params.by_hand and params.motor_torque is None and design.motor is None:
        warnings.append(no_motor(design.motor_torque, design.motor_speed))
    return tuple(warnings)


def tables(analysis: WarpTensionAnalysis) -> tuple[Table, ...]:
    """The three cylinders, stock tubes, bearings, the thesis' tubes, reducers."""
    design = analysis.design
    stock, bearings = _stock_table(design), _bearing_table(design)
    loads = _loads_table(design.loads)
    return loads, _cylinder_table(analysis.cylinders), stock, bearings, _tube_table(design), _efficiency_table(design)


def _loads_table(loads: WarpLoads) -> Table:
    """The three cases of the warps' loads."""
    heads = columns("case", "mean tension of a warp [N]", "pull of all warps [kN]", "decides")
    rows = tuple(
        (case, mean, loads.pull(case), "yes" if case == loads.worst_case else "") for case, mean in loads.cases.items()
    )
    return Table("warp-tension-loads", "Pull of the warps in the three cases", heads, rows)


def _cylinder_table(three: tuple[Cylinder, ...]) -> Table:
    heads = columns(
        "cylinder | tube | load [kN/m] | slope [mrad] | deflection [mm] | reaction [kN] | torque [Nm] | mass [kg]",
        "bearing | static safety | life, turns | shaft end [MPa]",
    )
    rows = tuple(
        (
            *(
                cylinder.name,
                cylinder.tube_name,
                abs(cylinder.load),
                cylinder.slope,
                cylinder.deflection,
                cylinder.reaction,
                cylinder.torque,
                cylinder.mass,
            ),
            *(cylinder.bearing.name, cylinder.static_safety, cylinder.life, cylinder.stub_stress),
        )
        for cylinder in three
    )
    return Table("warp-tension-cylinders", "The three cylinders", heads, rows)


def _stock_table(design: WarpTensionDesign) -> Table:
    """The lightest stock tubes that keep slope and deflection of the upper cylinder."""
    lightest = tubes_within_limits(design.params, TUBES.values())[:SHOWN_TUBES]
    rows = tuple((tube.name, tube.standard, tube.mass(design.params.density), tube.inertia) for tube in lightest)
    heads = columns("tube", "standard", "mass [kg/m]", "second moment of area [cm^4]")
    return Table("warp-tension-stock", "The lightest stock tubes that carry these warps", heads, rows)


def _bearing_table(design: WarpTensionDesign) -> Table:
    heads, allow = columns("bearing", "largest slope [mrad]", "slope here [mrad]", "allowed"), design.slope_loaded
    kept = bearings_for(allow)
    rows = tuple((kind.name, kind.slope_limit, allow, "yes" if kind in kept else "no") for kind in BEARINGS)
    return Table("warp-tension-bearings", "Rolling bearings for the slope", heads, rows)


def _tube_table(design: WarpTensionDesign) -> Table:
    """The thesis' Table 3.1 for this loom: radii, and the factor 5 in its place."""
    params = design.params

    def row(inner: float) -> tuple[float, float, float, float]:
        inertia = uniform.tube_inertia(inner + 10 * mm, inner)
        sag = float(uniform.deflection_max(design.load, params.span, params.modulus, inertia))
        return (inner, *outer_radii_min(params, inner), sag)

    heads = columns(
        "inner radius [mm] | least outer radius, slope [mm] 6 | least outer radius, deflection [mm] 6",
        "deflection of a 10 mm wall [mm]",
    )
    rows = tuple(row(inner * mm) for inner in (50, 75, 100, 125, 150))
    return Table("warp-tension-tubes", "Tubes for this loom", heads, rows)


def _efficiency_table(design: WarpTensionDesign) -> Table:
    heads = columns("efficiency of the reducer", "motor torque [Nm]", "self-locking")
    rows = tuple(
        (eta, design.torque_full / (design.reducer.ratio * eta), "yes" if eta <= LOCKING else "no")
        for eta in (0.35, 0.45, 0.5, 0.7, 0.9, 1.0)
    )
    return Table("warp-tension-reducers", "Reducer: self-locking or efficient, not both", heads, rows)
