"""Parameters of a head's opener, of the forces on its tools, and of arms that tie in place of its grippers."""

from dataclasses import dataclass

from ilmek.params import Params, kind
from ilmek.units import mm


@dataclass(frozen=True, slots=True)
class OpenerParams(Params):
    """The warp opener, two plates with slots, and the warps as strings between the holds below it and above it."""

    front_span: float = kind.length(
        25 * mm, at_least=1e-3, at_most=5.0, doc="from the fell to the opener's lower plate: above it knots are tied"
    )
    height: float = kind.length(
        20 * mm, at_least=1e-3, at_most=0.5, doc="from its lower to its upper plate: between them the tools work"
    )
    plate: float = kind.length(4 * mm, at_least=1e-4, at_most=0.05, doc="thickness of a plate, along the warps")
    back_span: float = kind.length(
        125 * mm, at_least=1e-3, at_most=20.0, doc="from its upper plate to the next hold of the warps"
    )
    warp_length: float = kind.length(1.5, unit="m", at_least=0.05, at_most=100.0, doc="warp from cylinder to cylinder")
    strength_used: float = kind.ratio(
        0.5, above=0.0, at_most=1.0, doc="tension of a displaced warp over its breaking force, at most"
    )
    tip: float = kind.length(
        0.09 * mm, at_least=0.0, at_most=0.05, doc="thickness of the points that enter between two warps"
    )
    placing: float = kind.length(
        0.04 * mm, at_least=0.0, at_most=0.05, doc="error of the head's position against the warps"
    )
    wall: float | None = kind.length(
        None, at_least=1e-4, at_most=0.05, doc="width of the teeth that hold warps away; default: as bend_limit needs"
    )
    crowd_limit: float = kind.length(
        0.3, at_least=0.01, at_most=5.0, doc="width of the displaced warps for which a head is made wider, at most"
    )
    bend_limit: float = kind.length(0.5 * mm, above=0.0, at_most=0.05, doc="allowed deflection of a tooth's end")


@dataclass(frozen=True, slots=True)
class ToolForces(Params):
    """What the tools' work takes; assumed by this project where the yarn does not give it."""

    yarn_pull: float = kind.force(0.5, at_least=0.0, at_most=1e3, doc="pull of an end of the pile that is led or drawn")
    grip_safety: float = kind.ratio(1.5, at_least=1.0, at_most=10.0, doc="grip of the jaws over the yarn's pull")
    tightening: float = kind.force(
        2.5, at_least=0.0, at_most=1e3, doc="pull on each end of a knot that tightens it about its warps"
    )
    tightening_travel: float = kind.length(
        5 * mm, above=0.0, at_most=0.3, doc="last part of the centre gripper's return, which tightens the knot"
    )
    sley: float = kind.force(10.0, at_least=0.0, at_most=1e4, doc="force of the sley that pushes a knot down")
    sley_travel: float = kind.length(5 * mm, above=0.0, at_most=0.3, doc="last part of its stroke, against the knot")


@dataclass(frozen=True, slots=True)
class ArmsInHead(Params):
    """Arms that tie the knot in place of the side and centre grippers, as the machine knotting-dyad states them."""

    time: float | None = kind.time(
        None, at_least=1e-3, at_most=3600.0, doc="their time of a knot; default: none, the grippers tie it"
    )
    yarn: float = kind.length(30 * mm, at_least=0.0, at_most=0.5, doc="pile yarn that they need for a knot")
    pair: float | None = kind.length(
        None, above=0.0, at_most=0.1, doc="the pair of warps in the opener's slots; default: as they stand"
    )
    outer: float | None = kind.length(
        None, above=0.0, at_most=0.1, doc="from a warp of the pair to the next warp; default: the pitch"
    )
    width: float = kind.length(40 * mm, at_least=0.0, at_most=5.0, doc="width of the head that they take")
    depth: float = kind.length(10 * mm, at_least=0.0, at_most=0.5, doc="reach of the opener's teeth past the warps")
    mass: float = kind.mass(0.0, at_least=0.0, at_most=500.0, doc="mass of their links, servos and gears")
    rest: float = kind.length(10 * mm, at_least=0.0, at_most=0.5, doc="their tips above the warps at rest")
    stroke: float = kind.length(25 * mm, at_least=0.0, at_most=1.0, doc="longest travel of their tips past the warps")
    breadth: float = kind.length(2 * mm, at_least=0.0, at_most=0.5, doc="breadth of their needles, along the warps")
    back: float = kind.length(36 * mm, at_least=0.0, at_most=1.0, doc="from the warps to the face behind them")
    beside: float = kind.length(0.0, at_least=0.0, at_most=0.5, doc="from the pair to the outside of their pivots")
    grip: float = kind.length(4 * mm, at_least=0.0, at_most=0.1, doc="half the size of the grippers with their room")
    aside: float = kind.length(5 * mm, at_least=0.0, at_most=0.5, doc="their tips at rest from the middle of the pair")
    bar_width: float = kind.length(4 * mm, at_least=0.0, at_most=0.1, doc="width of their centre gripper's bar")
    bar_height: float = kind.length(3 * mm, at_least=0.0, at_most=0.1, doc="height of the same, along the warps")
    servo_aside: float = kind.length(23 * mm, at_least=0.0, at_most=1.0, doc="from the pair to their servos' shafts")
    servo_depth: float = kind.length(
        0.0, at_least=0.0, at_most=2.0, doc="from the warps to the first of these; 0: none"
    )
    servo_pitch: float = kind.length(26 * mm, at_least=0.0, at_most=1.0, doc="from the first to the second ones")
    belts_end: float = kind.length(0.0, at_least=0.0, at_most=2.0, doc="from the warps to the end of their belts")
    belts_over: float = kind.length(0.0, at_least=0.0, at_most=0.5, doc="height of their belts over the case")
    servo_shaft: float = kind.length(5 * mm, at_least=0.0, at_most=0.1, doc="diameter of these shafts")
