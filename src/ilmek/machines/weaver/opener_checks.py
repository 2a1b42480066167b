"""The checks of the opener and of what has room in a head: tools between its plates, tubes, arms."""

from collections.abc import Iterator

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.drive_parts import COLOUR_MOTOR
from ilmek.machines.weaver.grippers import YARN_TOLERANCE
from ilmek.machines.weaver.magazine import TUBE_BORE
from ilmek.machines.weaver.magazine_parts import INDEX_SENSOR
from ilmek.machines.weaver.opener import LEAST_ROOM
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.selector import selector_of
from ilmek.machines.weaver.tool_parts import OPENER_PLATE, PILE_HANDLER, SLEY_BAR
from ilmek.report import Check, at_least, at_most

FINER = "set a coarser quality, or thinner warps"


def points_room(weaver: Weaver) -> float:
    """Gap between two warps, into which the opener's points go [m]."""
    return weaver.opener.pitch - weaver.params.warp


def opener_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The opener enters between two warps, does not overload them, pushes no warp of a neighbour's, and holds."""
    params, own, opener = weaver.params, weaver.params.opener, weaver.opener
    strength = params.cloth.carpet_yarns.warp.breaking_force
    return (
        at_most(
            "opener: points between two warps",
            own.tip + 2 * own.placing,
            points_room(weaver),
            "mm",
            "gap of the warps; assumed by this project: parameters opener.tip, opener.placing",
        ).with_cure(FINER, OPENER_PLATE),
        at_most(
            "opener: tension of a displaced warp",
            opener.tension,
            own.strength_used * strength,
            "N",
            "breaking force of the warp; share assumed by this project: parameter opener.strength_used",
        ).with_cure("set a lower tension, stronger warps, or longer spans of the warps", OPENER_PLATE),
        at_most(
            "opener: wedge against friction",
            opener.wedge,
            1 - LEAST_ROOM,
            "1",
            "no self-locking: slope of its walls times the friction",
        ).with_cure("set a longer weaver.opening", OPENER_PLATE),
        at_most(
            "opener: bend of its teeth",
            opener.bend,
            own.bend_limit,
            "mm",
            "assumed by this project: parameter opener.bend_limit",
        ).with_cure("set a wider weaver.opener.wall, or a lower tension", OPENER_PLATE),
        *_opener_room_checks(weaver),
    )


def _opener_room_checks(weaver: Weaver) -> Iterator[Check]:
    """The tools fit between the opener's plates, the sley reaches the fell, the neighbouring head's warps stand."""
    params, own, opener = weaver.params, weaver.params.opener, weaver.opener
    title, limit = "opener: teeth in the gap beside the pair", opener.aside - opener.pair / 2 - opener.diameter
    yield at_most(title, opener.wall, limit, "mm", "from the pair's warps to their neighbours").with_cure(
        "set a larger opening of the arms, or a smaller weaver.opener.wall", OPENER_PLATE
    )
    title = "opener: room of the tools between its plates"
    yield at_least(
        title, own.height, tools_height(weaver), "mm", "height of the grippers, or of a needle, with their clearances"
    ).with_cure("set a larger weaver.opener.height", OPENER_PLATE)
    title = "sley: stroke from above the opener to the fell"
    yield at_least(
        title, params.sley_stroke, own.front_span + own.height + own.plate, "mm", "opener.front_span, height and plate"
    ).with_cure("set a longer weaver.sley_stroke", SLEY_BAR, OPENER_PLATE)
    title = "opener: width of the warps that it displaces"
    yield at_most(
        title, opener.crowd, weaver.width, "mm", "head_width: the neighbouring head's warps stay where they are"
    ).with_cure("leave head_width to the design, or set thinner warps", OPENER_PLATE)


def tools_height(weaver: Weaver) -> float:
    """Height along the warps that the tools take between the opener's plates [m]."""
    params, by = weaver.params, weaver.grippers
    if params.with_arms:
        return params.arms.breadth + 2 * params.clearance
    return by.height + by.lift + 2 * params.finger + 2 * params.clearance


def room_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The magazine within the head; the arms too."""
    params, magazine = weaver.params, weaver.magazine
    fewer = "set fewer colours, more weaver.tube_tiers, or leave head_width to the design"
    room_checks = (
        at_most("tubes on the head", magazine.width, weaver.width, "mm", "head_width").with_cure(fewer, TUBE),
        at_most("tiers of the tubes", magazine.height, params.magazine_room, "mm", "parameter magazine_room").with_cure(
            "set a larger weaver.magazine_room, or fewer colours", TUBE
        ),
        at_most(
            "position of a tube",
            selector_of(params, magazine).error,
            (TUBE_BORE * magazine.pitch - params.yarn) / 2,
            "mm",
            "the yarn within the tube's bore; full steps of the selector's motor, and its index sensor",
        ).with_cure("set a larger weaver.tube_pitch", TUBE, COLOUR_MOTOR, INDEX_SENSOR),
    )
    if not params.with_arms:
        return room_checks
    cure = "leave head_width to the design"
    return (
        *room_checks,
        at_most("arms on the head", params.arms.width, weaver.width, "mm", "head_width").with_cure(cure),
        at_least(
            "yarn drawn",
            weaver.drawn + YARN_TOLERANCE,
            max(params.billed, params.arms.yarn),
            "mm",
            "yarn bill, and need of the arms",
        ).with_cure("set a longer knot_yarn", PILE_HANDLER),
    )
