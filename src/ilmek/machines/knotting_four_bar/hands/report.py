"""What is reported of hands that tie: checks, tables, self-test."""

import math

from ilmek.machines.knotting_four_bar.hands.beside import kinds_table
from ilmek.machines.knotting_four_bar.hands.design import TyingHands
from ilmek.machines.knotting_four_bar.hands.hand import TyingHand
from ilmek.machines.knotting_four_bar.hands.parts import NAME, SERVO, HandParts, hands_tree
from ilmek.machines.own_linkage.report import construction_checks
from ilmek.part.bill import bill
from ilmek.report import Check, Table, at_least, at_most, columns, must

BALANCE = 1e-9
FINGER, WIDER = f"{NAME}/finger", "set a wider task.cloth.warp_pitch, a finer finger, or more room"


def checks(hands: TyingHands) -> tuple[Check, ...]:
    """The knot, the fingers among the warps, the four-bar, room, servo; without hands, that none keeps the limits."""
    source = "crossings of the yarn" if hands.made else "search within the limits of the task"
    proved = at_least("knots tied, proved", float(hands.ties), 1.0, "1", source).with_cure(WIDER)
    if hands.made is None:
        return at_least("hands within all limits", hands.candidates, 1.0, "1", source).with_cure(WIDER), proved
    made = hands.made
    return (proved, *_finger_checks(made), *_link_checks(hands, made), *construction_checks(made.built))


def _finger_checks(made: HandParts) -> tuple[Check, ...]:
    hand, task = made.hand, made.hand.section.task
    gap = task.cloth.warp_pitch - task.warp
    aside = max(task.finger_thickness + task.cloth.carpet_yarns.pressed - gap, 0.0)
    return (
        at_least(
            "fingers clear of the warps, over the whole stroke", hand.clearance, task.clearance, "mm", "task.clearance"
        ).with_cure(WIDER, FINGER),
        at_least(
            "fingers of both hands apart",
            hand.section.apart - task.finger_thickness,
            task.clearance,
            "mm",
            "task.clearance; planes of the hands",
        ).with_cure("set a smaller task.clearance", FINGER),
        at_most(
            "finger bent aside in the gap by the yarn",
            hand.bent * hand.section.cosine,
            hand.clearance,
            "mm",
            "task.yarn_pull; clearance of the stroke",
        ).with_cure("set a larger task.finger_width or a smaller task.yarn_pull", FINGER),
        at_most(
            "gap spread by finger and pressed yarn together",
            aside,
            gap / 2,
            "mm",
            "half a gap, for the next warps to stay apart; assumed by this project",
        ).with_cure(WIDER, FINGER),
    )


def _link_checks(hands: TyingHands, made: HandParts) -> tuple[Check, ...]:
    hand, task = made.hand, hands.params
    roomier = "set a larger task.room_length or task.room_height"
    return (
        at_least(
            "transmission angle of a hand", hand.transmission, task.transmission_limit, "deg", "task.transmission_limit"
        ).with_cure("set a wider task.cloth.warp_pitch, or more room"),
        at_most("swing of a hand's crank", hand.swing, task.swing_limit, "deg", "task.swing_limit").with_cure(roomier),
        at_most("length of both hands", made.hands_length, task.room_length, "mm", "task.room_length").with_cure(
            roomier
        ),
        at_most("height of the hands", made.hands_height, task.room_height, "mm", "task.room_height").with_cure(
            roomier
        ),
        must("a servo swings a hand", hands.servo is not None, "micro servos; margin of torque 2").with_cure(
            "set a longer task.stroke_time, or a larger task.servo_mass", SERVO
        ),
    )


def self_tests(hands: TyingHands) -> tuple[Check, ...]:
    """The power balance of a hand."""
    if hands.loads is None:
        return ()
    error = hands.loads.power_error
    return (at_most("power balance of a hand", error, BALANCE, "1", "virtual power").with_cure("report this"),)


def tables(hands: TyingHands) -> tuple[Table, ...]:
    """Planes searched, and the hand."""
    heads = columns(
        "inclination [deg]", "four-bars tried", "within all limits but the clearance", "clear", "best clearance [mm]"
    )
    rows = tuple(
        (plane.inclination, plane.tried, plane.within, plane.candidates, math.nan if plane.best is None else plane.best)
        for plane in hands.planes
    )
    searched = Table("knotting-searched", "Planes searched", heads, rows)
    if hands.made is None:
        return (searched,)
    parts = bill(hands_tree(hands.made, hands.servo))
    return searched, _hand_table(hands.made.hand), kinds_table(hands.params, hands.made.knot_time, parts)


def _hand_table(hand: TyingHand) -> Table:
    links = hand.four_bar
    heads = columns("point", "u [mm] 7", "y [mm] 7")
    named = {"A0": links.a0, "B0": links.b0, "A": links.a, "B": links.b, "foot": links.tracer, "arc": hand.centre}
    rows = tuple((name, at.real, at.imag) for name, at in named.items() if at is not None)
    return Table("knotting-hand", "The left hand at the middle of its stroke, 0 the knot's middle", heads, rows)
