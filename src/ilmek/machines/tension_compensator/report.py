"""The report of the tension compensator: checks, choices, tables."""

from ilmek.elements.springs import choose_spring, least_stress_share
from ilmek.machines.tension_compensator.analysis import CompensatorAnalysis
from ilmek.machines.tension_compensator.design import CLEARANCE, TensionCompensator, swing_checks
from ilmek.machines.tension_compensator.members import (
    bar_checks,
    beam_checks,
    cross_check,
    lever_checks,
    part_id,
    pin_checks,
    saddle_checks,
    spring_pin_check,
)
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.machines.tension_compensator.struts import strut_checks
from ilmek.machines.tension_compensator.synthesis import SEATS, SPRINGS, SprungLever, shared, spring_room, wires
from ilmek.report import Alternative, Check, Choice, Table, at_least, at_most, choose, columns, must
from ilmek.units import deg, turn

STRAND_LEAST = 10 * deg
"""Least deflection of a strand at the bar: below it the warps would leave the rods; assumed by this project."""

SPRING_SOURCE = "stress at the solid length, fatigue, buckling and length [EN 13906-1]"

SHARE_TOLERANCE = 0.02
"""Share by which the rate of the synthesised linkage may miss that which is wished; assumed by this project."""


def checks(found: CompensatorAnalysis) -> tuple[Check, ...]:
    """Tensions over the turn, springs, stiffness, room and strength."""
    design, params = found.design, found.design.params
    members, loads = design.members, design.loads
    return (
        *swing_checks(params, found.tension_max, found.tension_min),
        spring_check(design),
        must("equilibrium over the turn", found.balanced, "linkage engine").with_cure("set a larger rate_share"),
        *_motion_checks(design),
        *bar_checks(params, members.tube, loads.line),
        *lever_checks(params, members.lever, members.pin, loads),
        *pin_checks(params, members.pin, loads),
        *saddle_checks(params, design.radius, members, loads),
        spring_pin_check(params, members.spring_pin, loads),
        *strut_checks(design.parts.supports),
        *beam_checks(params, members.beam, loads),
        cross_check(params, members.cross, loads),
    )


def spring_check(design: TensionCompensator) -> Check:
    """Whether there is a spring that is strong enough, lasts, and fits."""
    cure = "set a lower tension or a coarser quality, a longer spring_arm or strut, or more springs"
    return must("springs of the table", design.one.spring is not None, SPRING_SOURCE).with_cure(cure, part_id("spring"))


def _motion_checks(design: TensionCompensator) -> tuple[Check, ...]:
    """Natural frequency, deflection of the strands, room of the levers."""
    params = design.params
    shed = params.speed / params.lifted_angle
    assumed = "assumed by this project"
    return (
        at_least(
            *("natural frequency", design.frequency, params.frequency_ratio * shed, "Hz"),
            f"{assumed}: parameter frequency_ratio",
        ).with_cure("set a lower speed, or a larger rate_share", part_id("bar"), part_id("lever"), part_id("spring")),
        at_least(
            "deflection of the strands in the open shed", design.strand_angle_least, STRAND_LEAST, "deg", assumed
        ).with_cure("set a larger strand_angle or guide_span"),
        at_least(
            "room between lever and rod", design.one.clearance(design.members.lever), CLEARANCE, "mm", assumed
        ).with_cure("set a larger arm_angle or guide_span", part_id("lever"), part_id("rod")),
    )


def choices(design: TensionCompensator) -> tuple[Choice, ...]:
    """Number of bars, springs, tube, lever, pin and beam, as far as they were left open."""
    params = design.params
    bars = () if params.bars else (design.choice,)
    return (*bars, *(() if params.springs else (_spring_choice(design),)), *design.members.choices)


def _spring_choice(design: TensionCompensator) -> Choice:
    """The springs on a lever, and why fewer are not enough."""
    one, wound = design.one, design.one.spring
    wire = wires(design.params)[-1] if wound is None else wound.wire
    fewer = [shared(design.params, one, number, wire) for number in SPRINGS if number < one.springs]
    found = [Alternative(str(tried.springs), fewer_checks(design.params, tried, wire)) for tried in (*fewer, one)]
    return choose("springs", found)[1]


def fewer_checks(params: TensionCompensatorParams, one: SprungLever, wire: str) -> tuple[Check, ...]:
    """What a lever's springs of a wire fail: strength, or the lightest of those strong enough its fatigue or size."""
    if one.spring is not None:
        return (must("springs of the table", True, SPRING_SOURCE),)
    used = least_stress_share(one.rate, one.force / one.rate, wire)
    strong = choose_spring(one.rate, one.preload, (one.force - one.preload) / one.rate, wire=wire)
    if strong is None:
        named = at_most("stress of a spring over that allowed", used, 1.0, "1", SPRING_SOURCE)
        return (
            (must("springs with the strength required that do not buckle", False, SPRING_SOURCE),)
            if named.ok
            else (named,)
        )
    fatigue, length = strong.fatigue_safety(one.preload, one.force), strong.free_length - one.preload / one.rate
    found = (
        at_least("fatigue of a spring", fatigue, params.spring_fatigue, "1", "parameter spring_fatigue"),
        at_most("length of a spring at rest", length, params.strut - SEATS, "mm", "parameter strut"),
        at_most(
            "outer diameter of a spring",
            strong.diameter + strong.wire_diameter,
            spring_room(params, one.springs),
            "mm",
            "springs beside each other in a lever's share of the width",
        ),
    )
    failed = tuple(check for check in found if not check.ok)
    return failed or (must("springs of the table", False, SPRING_SOURCE),)


def tables(found: CompensatorAnalysis) -> tuple[Table, ...]:
    """Tensions with and without the compensator."""
    design = found.design
    rest, held = design.params.cloth.warp_tension, design.fixed_tension
    rows = (
        ("fixed rods", held, rest, held / rest),
        (
            f"{design.bars} sprung bar{'s' if design.bars > 1 else ''}",
            *(design.tension_open, design.tension_low, design.tension_open / rest),
        ),
    )
    heads = columns("back rest", "lifted warp [N]", "other warp [N]", "lifted over rest")
    return (Table("tension-compensator-swing", "Tension in the open shed", heads, rows),)


def warnings(found: CompensatorAnalysis) -> tuple[str, ...]:
    """A linkage that cannot give as much warp as the shed lengthens it."""
    design = found.design
    wished = design.one.task.open_tension(design.params.rate_share)
    mean = (design.tension_open + (design.tension_low if design.bars == 1 else design.tension_open)) / 2
    if mean > wished * (1 + SHARE_TOLERANCE):
        return (f"a lever turns by {design.one.angle / turn * 360:.3g} deg at most: it gives less warp than it should",)
    return ()
