"""Checks of the hand shed, and its figure."""

import math

from ilmek.elements.columns import STEEL
from ilmek.machines.hand_shed.design import LOCK_PIN, PLATE, HandShed
from ilmek.machines.hand_shed.tree import layout, part_id
from ilmek.report import Check, at_least, at_most
from ilmek.units import turn

STAYS = 1.5
"""Friction that holds the rod up over what draws it down, at least; assumed by this project."""

_SHORTER = "set a smaller opening, a lower tension, or a narrower carpet"


def checks(shed: HandShed) -> tuple[Check, ...]:
    """Openings, hands, bending, strings, lock, and the room of the heddle bar."""
    params, limit = shed.params, STEEL.strength / shed.params.safety
    rod, bar, lever = (part_id("rod"),), (part_id("heddle-bar"),), (part_id("lever"),)
    hands = "EN 1005-3, table 1: parameter hands."
    return (
        at_least("opening, the rod pulled down", shed.opening_low, params.opening, "mm", "parameter opening").with_cure(
            "set a larger rod_sag", *rod
        ),
        at_least("opening, the strings pulled", shed.opening_high, params.opening, "mm", "parameter opening").with_cure(
            "set a larger bar_sag or rod_sag", *bar
        ),
        at_most(
            "force of a hand on its lever", shed.lever_force, params.hand_limit, "N", f"{hands}pull, lift"
        ).with_cure(f"set a larger lever_limit, a smaller arm, or {_SHORTER[4:]}", *lever),
        at_most("force of a hand on the rod", shed.rod_force, params.hands.lift, "N", f"{hands}lift").with_cure(
            _SHORTER, *rod
        ),
        at_least("rod stays up", shed.hold / shed.rod_weight, STAYS, "1", "friction over weight; assumed").with_cure(
            "set a larger opening, or a lighter rod", *rod
        ),
        at_most("sag of the rod", shed.rod_deflection, params.rod_sag, "mm", "on the warps: rod_sag").with_cure(
            _SHORTER, *rod
        ),
        at_most(
            "sag of the heddle bar", shed.bar_deflection, shed.bar_limit, "mm", "5 F l³/384 E I: bar_sag"
        ).with_cure(_SHORTER, *bar),
        at_most("stress of the heddle bar", shed.bar_stress, limit, "MPa", "yield of S235 over safety").with_cure(
            _SHORTER, *bar
        ),
        at_most("stress of the rod", shed.rod_stress, limit, "MPa", "yield of S235 over safety").with_cure(
            _SHORTER, *rod
        ),
        at_most(
            "stress of a lever", lever_stress(shed), limit, "MPa", "bending at its pivot, yield over safety"
        ).with_cure(_SHORTER, *lever),
        at_most("force of a string", shed.string_force, params.string_strength / params.safety, "N", "string_strength"),
        at_most(
            "tension of a pulled warp", shed.rear.tension, _breaking(shed), "N", "breaking force of a warp"
        ).with_cure("set a smaller opening, or a longer free_length"),
        at_most("shear of a lock's pin", lock_shear(shed), limit / math.sqrt(3), "MPa", "yield over safety, von Mises"),
        at_most(
            "stroke over twice the arm", shed.stroke / 2 / shed.arm, math.sin(turn / 8), "1", "sine of 45 deg"
        ).with_cure("set a larger arm", *lever),
        at_least(
            "heddle bar before the warps", layout(shed).bar_room, params.clearance, "mm", "parameter clearance"
        ).with_cure("set a larger free_length", *bar),
    )


def lever_stress(shed: HandShed) -> float:
    """Stress of a lever at its pivot [Pa]: half of the bar's moment in a plate with the pivot's bore.

    sigma = M h / 2 / I,   I = t (h³ - b³) / 12
    """
    made = layout(shed)
    high, bore = 2 * made.hub, made.journal
    moment = float(shed.heddle_force) / 2 * shed.arm
    return moment * high / 2 / (PLATE * (high**3 - bore**3) / 12)


def lock_shear(shed: HandShed) -> float:
    """Shear stress of the pin that locks a lever [Pa]: 4/3 of the mean in a round section."""
    return 4 / 3 * float(shed.lock_force) / (math.pi * LOCK_PIN**2 / 4)


def _breaking(shed: HandShed) -> float:
    return shed.params.cloth.carpet_yarns.warp.breaking_force
