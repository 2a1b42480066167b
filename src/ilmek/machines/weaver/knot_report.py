"""What the head says of the knot: which is tied, the yarn that it takes, and the grippers' room."""

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.grippers import clearance_min, taut_max
from ilmek.machines.weaver.knot import told
from ilmek.report import Check, Result, at_least, at_most
from ilmek.units import format_quantity, um

SAME = 1 * um
"""A difference of yarn that is none."""


def knot_results(weaver: Weaver) -> tuple[Result, ...]:
    """The knot, the yarn and the grippers' dimensions."""
    by, params = weaver.grippers, weaver.params
    return (
        Result(
            "knot_tied", weaver.knot_tied, "", "the knot that the grippers' motion ties on the pair of warps, proved"
        ),
        Result("knot_why", told(weaver.tied), "", "what the proof says"),
        Result("yarn_drawn", weaver.drawn, "mm", "pile yarn drawn for a knot"),
        Result("yarn_billed", params.billed, "mm", "pile yarn of a knot by the yarn bill, what is shorn off included"),
        Result("yarn_in_knot", weaver.in_knot, "mm", "pile yarn that stays in the carpet for a knot"),
        Result("cut_waste", weaver.drawn - weaver.in_knot, "mm", "pile yarn cut off for a knot"),
        Result("yarn_taut_max", taut_max(by), "mm", "most yarn needed between the side grippers on their way"),
        Result("yarn_held", by.apart, "mm", "yarn between the side grippers"),
        Result("handler_radius", weaver.handler_radius, "mm", "radius at which the handler draws that yarn"),
        Result("crossing", by.crossing, "mm", "side grippers along the screw"),
        Result("crossing_turn", by.turn, "deg", "what the screw turns them by"),
        Result("screw_lead", weaver.screw_lead, "mm", "advance of the side grippers' screw for a turn"),
        Result("gripper_axis", by.axis, "mm", "a side gripper's rod from the middle of the pair"),
        Result("gripper_arm", by.arm, "mm", "a side gripper's arm, from its rod to the yarn"),
        Result("pair_opened", by.pair, "mm", "distance of the pair of warps in the opener's slots"),
        Result("opener_width", 2 * abs(by.warps[-1].real), "mm", "within which the opener holds all other warps away"),
        Result("centre_depth", by.depth, "mm", "centre gripper's tip behind the warps"),
        Result("centre_height", by.height, "mm", "centre gripper above the side grippers' rods, along the warps"),
        Result("gripper_clearance", clearance_min(by), "mm", "least room between a side gripper and its warp"),
    )


def knot_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The knot asked for is tied; the yarn is long enough, for the knot and between the grippers; they have room."""
    by, params = weaver.grippers, weaver.params
    tied = float(weaver.knot_tied == params.knot)
    return (
        at_least(f"{params.knot} knot tied", tied, 1.0, "", f"proof: {told(weaver.tied)}"),
        at_most("yarn needed between the grippers", taut_max(by), by.apart + SAME, "mm", "yarn held between them"),
        at_least("yarn drawn", weaver.drawn + SAME, params.billed, "mm", "yarn bill: carpet.pile, of this knot"),
        at_least("room of the side grippers", clearance_min(by) + SAME, params.clearance, "mm", "parameter clearance"),
    )


def knot_warnings(weaver: Weaver) -> tuple[str, ...]:
    """Where another knot is asked for than the thesis' mechanism ties, and where more yarn is drawn than billed."""
    params, said = weaver.params, []
    if weaver.knot_tied != params.knot:
        said.append(_other_knot(weaver))
    more = weaver.drawn - params.billed
    if more > SAME:
        shown = [format_quantity(size, "mm", 3) for size in (more, weaver.drawn, params.billed)]
        said.append(
            f"{shown[0]} more yarn than the bill's is drawn for every knot, {shown[1]} for {shown[2]}: the grippers "
            "reach round the pair with no less"
        )
    return tuple(said)


def _other_knot(weaver: Weaver) -> str:
    asked = weaver.params.knot
    if asked == "asymmetric":
        return (
            "the thesis' head ties no asymmetric knot, whatever its dimensions: both ends go round the outside of "
            "their warps and both come out between them; the machine knotting-dyad ties it"
        )
    return f"the {asked} knot is not tied, {told(weaver.tied)}"
