"""Parameters of a knotting head; phases, strokes and dimensions are assumed by this project: the thesis prints none."""

from dataclasses import dataclass
from typing import Any

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import Quality
from ilmek.elements.knot_kinds import WRAPS
from ilmek.errors import ParameterError
from ilmek.machines.weaver.cutter import CROSSED
from ilmek.machines.weaver.magazine import DRUM, SLIDE
from ilmek.machines.weaver.motions import (
    CENTRE_GRASP,
    CENTRE_MOTION,
    HANDLER,
    OPENER,
    SIDE_GRASP,
    SIDE_MOTION,
    SLEY,
    CycleSteps,
    ToolAngles,
    motion_angles,
    require_order,
)
from ilmek.machines.weaver.tool_params import ArmsInHead, OpenerParams, ToolForces
from ilmek.params import Params, kind, nested
from ilmek.timing.s_curve import AxisLimits
from ilmek.units import deg, format_quantity, mm, turn
from ilmek.weaving.cloth import Cloth

LEAST_STEP = 10 * deg
"""Least angle of a step of the turn."""

LEAST_FRICTION = 0.01
"""Least friction with which jaws hold a yarn."""

PAIR = 6 * mm
"""Usual distance of the pair of warps in the opener's slots."""

TOOLS = {
    SIDE_GRASP: "side_jaws",
    SIDE_MOTION: "side_grippers",
    CENTRE_GRASP: "centre_jaws",
    CENTRE_MOTION: "centre_gripper",
    HANDLER: "pile_handler",
    SLEY: "sley",
    OPENER: "side_grippers",
}
"""Of each track the parameters of its tool."""

WITH_ARMS = (OPENER, HANDLER, SLEY)
"""Tracks of a head whose knots arms tie."""


def _speed(default: float, doc: str) -> Any:
    return kind.speed(default, at_least=1e-3, at_most=100.0, doc=doc)


def _acceleration(default: float, doc: str) -> Any:
    return kind.acceleration(default, at_least=1e-3, at_most=1e5, doc=doc)


def _jerk(default: float, doc: str) -> Any:
    return kind.jerk(default, at_least=1e-3, at_most=1e9, doc=doc)


@dataclass(frozen=True, slots=True)
class WeaverParams(Params):
    """The knot, the head's timing and dimensions, and the limits of its motions."""

    cycle: float = kind.time(
        2.0, at_least=1e-3, at_most=3600.0, doc="required time of a knot; fails where limits allow no less"
    )
    optimise: bool = kind.flag(False, doc="stretch and overlap the motions within their order for least accelerations")
    law: str = kind.choice("modified-sine", SMOOTH_LAWS, doc="law of all motions")
    prepare_end: float = kind.angle(104 * deg, above=0.0, below=turn, doc="cam angle at which the pile is ready")
    open_end: float = kind.angle(180 * deg, above=0.0, below=turn, doc="cam angle at which the warps are open")
    knot_end: float = kind.angle(250 * deg, above=0.0, below=turn, doc="cam angle at which the knot is made")
    press_end: float = kind.angle(352 * deg, above=0.0, at_most=turn, doc="cam angle at which all tools are back")
    side_jaws: ToolAngles = nested(ToolAngles, doc="jaws of the side grippers: close; open")
    side_grippers: ToolAngles = nested(ToolAngles, doc="side grippers: pull back, open warps, cross; turn back, return")
    centre_jaws: ToolAngles = nested(ToolAngles, doc="jaws of the centre gripper: close; open")
    centre_gripper: ToolAngles = nested(ToolAngles, doc="centre gripper: forward; return")
    pile_handler: ToolAngles = nested(ToolAngles, doc="pile handler: to the tube, draw, present; home")
    sley: ToolAngles = nested(ToolAngles, doc="sley: down; up")
    relation_gap: float = kind.angle(1 * deg, at_least=0.0, below=turn, doc="least gap of motions in sequence")
    cloth: Cloth = nested(Cloth, doc="warps, their tension, the pile yarn, distances of knots and rows")
    knot: str = kind.choice("symmetric", tuple(WRAPS), doc="required kind of knot")
    jaw: float = kind.length(4 * mm, above=0.0, at_most=0.05, doc="opening of the grippers' jaws")
    pull_back: float = kind.length(8 * mm, above=0.0, at_most=0.1, doc="side grippers back, to free the handler")
    opening: float = kind.length(20 * mm, above=0.0, at_most=0.3, doc="side grippers and opener forward")
    crossing: float | None = kind.length(
        None, above=0.0, at_most=0.3, doc="side grippers along the screw; default: room for the centre gripper"
    )
    crossing_turn: float | None = kind.angle(
        None, above=0.0, at_most=turn / 2, doc="their rotation by the screw; default: until the ends cross"
    )
    overlap: float = kind.length(4 * mm, at_least=5e-4, at_most=0.05, doc="ends past the middle when they cross")
    finger: float = kind.length(2 * mm, above=0.0, at_most=0.05, doc="thickness of the grippers' rods and arms")
    clearance: float = kind.length(0.5 * mm, at_least=0.0, at_most=0.05, doc="least room between moving parts")
    standoff: float = kind.length(
        3 * mm,
        at_least=0.0,
        at_most=0.2,
        doc="opener and sley at rest from the warps, and the case from the drawn yarn",
    )
    pair_opened: float | None = kind.length(
        None, above=0.0, at_most=0.1, doc="the pair of warps in the opener's slots; default: 6 mm, or more for room"
    )
    tail: float = kind.length(2 * mm, at_least=0.0, at_most=0.05, doc="yarn held in a side gripper, each end")
    centre_stroke: float = kind.length(25 * mm, above=0.0, at_most=0.3, doc="centre gripper forward")
    sley_stroke: float = kind.length(50 * mm, above=0.0, at_most=0.3, doc="sley down")
    knot_yarn: float | None = kind.length(
        None, above=0.0, at_most=0.3, doc="pile yarn of a knot by its bill, waste included; default: by the pile"
    )
    pile_height: float = kind.length(8 * mm, at_least=0.0, at_most=100 * mm, doc="pile above the knots, shorn")
    cut_waste: float = kind.length(1 * mm, at_least=0.0, at_most=100 * mm, doc="shorn off each end of a knot")
    opener: OpenerParams = nested(OpenerParams, doc="warp opener, and the warps that it displaces")
    forces: ToolForces = nested(ToolForces, doc="forces of the tools' work")
    arms: ArmsInHead = nested(ArmsInHead, doc="arms in place of the side and centre grippers")
    speed_limit: float = _speed(1.0, "allowed speed of grippers, sley and handler's tip")
    acceleration_limit: float = _acceleration(20.0, "allowed acceleration of the same")
    tool_mass: float = kind.mass(0.25, at_least=0.0, at_most=100.0, doc="mass that each cam may move, at its tool")
    lever: float = kind.ratio(2.0, above=0.05, at_most=20.0, doc="motion of a tool over its cam's follower")
    sley_lever: float = kind.ratio(4.0, above=0.05, at_most=20.0, doc="motion of the sley over its cam's follower")
    pinion: float = kind.length(
        6 * mm, at_least=1e-3, at_most=0.1, doc="radius of the handler's pinion on its cam's rack"
    )
    closure: str = kind.choice("spring", ("spring", "groove"), doc="what holds the followers to their cams")
    contact_force: float = kind.force(5.0, at_least=0.0, at_most=1e4, doc="least force of a sprung roller")
    pressure_angle_limit: float = kind.angle(
        30 * deg, at_least=5 * deg, at_most=60 * deg, doc="largest pressure angle of the cams"
    )
    roller_radius: float = kind.length(0.0065, at_least=1e-3, at_most=0.05, doc="radius of the cams' rollers")
    cam_thickness: float = kind.length(8 * mm, at_least=5e-4, at_most=0.05, doc="thickness of a cam")
    cam_gap: float = kind.length(1.7 * mm, at_least=0.0, at_most=0.05, doc="gap between cams, and beside them")
    cam_belt: float = kind.length(
        10 * mm, at_least=5e-3, at_most=0.05, doc="width of the belt that drives the cam shaft"
    )
    shaft: float = kind.length(15 * mm, at_least=0.007, at_most=0.1, doc="diameter of the cam shaft")
    side_plate: float = kind.length(8 * mm, at_least=0.0, at_most=0.1, doc="side plates with the shaft's bearings")
    head_width: float | None = kind.length(
        None, at_least=0.01, at_most=1.0, doc="width of the head, along the row; default: what its contents need"
    )
    head_mass: float | None = kind.mass(
        None, at_least=0.1, at_most=500.0, doc="mass of the head on its carriage; default: as designed"
    )
    cam_room: float = kind.length(250 * mm, at_least=0.02, at_most=2.0, doc="room for a cam's diameter in the head")
    carriage_speed: float = _speed(0.25, "speed of the head along the row")
    carriage_acceleration: float = _acceleration(1.0, "acceleration of the head along the row")
    carriage_jerk: float = _jerk(100.0, "jerk of the head along the row")
    cutter_turn: float = kind.time(
        40e-3, at_least=1e-3, at_most=1.0, doc="time of half a turn of the cutter's eccentric, which makes the cut"
    )
    tubes: int = kind.count(16, at_least=1, at_most=255, doc="yarn tubes, one for each colour")
    magazine: str = kind.choice(DRUM, (DRUM, SLIDE), doc="tubes on a drum, or on slides")
    tube_tiers: int | None = kind.count(
        None, at_least=1, at_most=255, doc="tiers of tubes; default: the fewest that are no wider than the rest"
    )
    magazine_room: float = kind.length(0.25, at_least=1e-3, at_most=5.0, doc="room for the height of all tiers")
    tube_pitch: float = kind.length(12 * mm, at_least=1e-6, at_most=1.0, doc="distance of neighbouring tubes")
    selector_speed: float = _speed(0.2, "speed of the colour selector")
    selector_acceleration: float = _acceleration(1.0, "acceleration of the colour selector")
    selector_jerk: float = _jerk(50.0, "jerk of the colour selector")
    tube_mass: float = kind.mass(0.02, at_least=0.0, at_most=10.0, doc="a yarn tube with its share of the slide")
    selector_pulley: float = kind.length(10 * mm, at_least=1e-3, at_most=0.2, doc="pitch radius of a slide's pulley")

    def check_together(self) -> None:
        """The steps of the turn and the motions of a tool follow each other; the opener makes room for a gripper."""
        ends = {"prepare_end": self.prepare_end, "open_end": self.open_end, "knot_end": self.knot_end}
        before, at = "the beginning of the turn", 0.0
        for name, end in (*ends.items(), ("press_end", self.press_end)):
            if end < at + LEAST_STEP:
                given = f"{name}={format_quantity(end, 'deg')} leaves the step after {before} no room"
                raise ParameterError(given, allowed=f"at least {format_quantity(at + LEAST_STEP, 'deg')}")
            before, at = name, end
        self._check_tools()
        if not self.with_arms and self.pair_opened is not None and self.pair_opened < self.centre_room:
            shown, room = (format_quantity(size, "mm") for size in (self.pair_opened, self.centre_room))
            given = f"pair_opened={shown} leaves the centre gripper no path between the warps"
            allowed = f"at least {room}: a warp, the gripper's finger and its clearances"
            raise ParameterError(given, allowed=allowed, do="open the pair wider, or take a thinner finger")

    @property
    def tool_angles(self) -> tuple[ToolAngles, ...]:
        """The angles of each tool that moves."""
        tracks = WITH_ARMS if self.with_arms else tuple(track for track in TOOLS if track != OPENER)
        return tuple(getattr(self, TOOLS[track]) for track in tracks)

    def _check_tools(self) -> None:
        tracks = WITH_ARMS if self.with_arms else tuple(track for track in TOOLS if track != OPENER)
        for track in tracks:
            tool = TOOLS[track]
            angles: ToolAngles = getattr(self, tool)
            if self.optimise and angles.given:
                given = f"optimise chooses the cam angles of all motions, but {tool}.{next(iter(angles.given))} is set"
                raise ParameterError(given, do="leave one of the two out")
            require_order(tool, track, self.steps, angles)

    @property
    def steps(self) -> CycleSteps:
        """Ends of the four steps of the turn."""
        return CycleSteps(self.prepare_end, self.open_end, self.knot_end, self.press_end)

    def motions(self, track: str) -> dict[str, tuple[float, float]]:
        """Begin and end of each motion of a track [rad], by name."""
        return motion_angles(track, self.steps, getattr(self, TOOLS[track]))

    @property
    def quality(self) -> Quality:
        """The carpet's quality by the distances of its knots."""
        return Quality(1 / self.cloth.knot_pitch, 1 / self.cloth.row_distance)

    @property
    def warp(self) -> float:
        """Diameter of a warp [m]."""
        return self.cloth.carpet_yarns.warp.diameter

    @property
    def yarn(self) -> float:
        """Diameter of the pile yarn [m]."""
        return self.cloth.carpet_yarns.pile.diameter

    @property
    def pressed(self) -> float:
        """Thickness of the pile yarn pressed between jaws [m]."""
        return self.cloth.carpet_yarns.pressed

    @property
    def strength(self) -> float:
        """Breaking force of all fibres of the pile yarn together [N]."""
        return self.cloth.carpet_yarns.pile.breaking_force

    @property
    def friction(self) -> float:
        """Friction coefficient of yarn on the tools."""
        return max(self.cloth.yarns.friction, LEAST_FRICTION)

    @property
    def with_arms(self) -> bool:
        """Whether arms tie in place of the side and centre grippers."""
        return self.arms.time is not None

    @property
    def billed(self) -> float:
        """Pile yarn of a knot by the yarn bill [m], what is shorn off included: as given, or by `carpet.pile`."""
        if self.knot_yarn is not None:
            return self.knot_yarn
        pile = PileParams(pile_height=self.pile_height, cut_waste=self.cut_waste, warp_diameter=self.warp)
        return knot_length(self.knot, self.quality, self.cloth.carpet_yarns.pile.linear_density, pile)

    @property
    def carriage(self) -> AxisLimits:
        """Limits of the carriage along the row."""
        return AxisLimits(self.carriage_speed, self.carriage_acceleration, self.carriage_jerk)

    @property
    def selector(self) -> AxisLimits:
        """Limits of the colour selector."""
        return AxisLimits(self.selector_speed, self.selector_acceleration, self.selector_jerk)

    @property
    def cutting_time(self) -> float:
        """Time in which the cutter's blade crosses the yarn [s]."""
        return CROSSED * self.cutter_turn

    @property
    def centre_room(self) -> float:
        """Least distance of the pair that lets the centre gripper pass [m]."""
        return self.warp + self.finger + 2 * self.clearance

    @property
    def pair(self) -> float:
        """Distance of the pair of warps in the opener's slots [m]."""
        if self.with_arms:
            return self.arms.pair or self.cloth.warp_pitch
        return self.pair_opened or max(PAIR, self.centre_room)
