"""What may be asked of a knotting head. Phases, strokes and dimensions are choices of ours: the thesis prints none."""

import math
from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import COARSEST, FINEST, Quality
from ilmek.elements.knot_kinds import WRAPS
from ilmek.elements.yarns import WOOL, warp_diameter
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import deg, format_quantity, g, m, mm, turn

LEAST_STEP = 10 * deg
"""Least angle of a step of the turn."""

PAIR = 6 * mm
"""Usual distance of the pair of warps in the opener's slots."""


@dataclass(frozen=True, slots=True)
class WeaverParams(Params):
    """What may be asked of a knotting head."""

    cycle: float = param(
        2.0,
        unit="s",
        at_least=1e-3,
        at_most=3600.0,
        doc="time of a knot that is asked for; longer where limits demand it",
    )
    optimise: bool = param(False, doc="stretch and overlap the motions within their order for the least accelerations")
    law: str = param("modified-sine", choices=SMOOTH_LAWS, doc="law of all motions")
    prepare_end: float = param(104 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the pile is ready")
    open_end: float = param(180 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the warps are open")
    knot_end: float = param(250 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the knot is made")
    press_end: float = param(352 * deg, unit="deg", above=0.0, at_most=turn, doc="cam angle at which all are back")
    relation_gap: float = param(1 * deg, unit="deg", at_least=0.0, below=turn, doc="least gap of motions in sequence")
    knot: str = param("symmetric", choices=tuple(WRAPS), doc="kind of knot that is asked for")
    jaw: float = param(0.004, unit="mm", above=0.0, at_most=0.05, doc="opening of the grippers' jaws")
    pull_back: float = param(0.008, unit="mm", above=0.0, at_most=0.1, doc="side grippers back, to free the handler")
    opening: float = param(0.020, unit="mm", above=0.0, at_most=0.3, doc="side grippers and opener forward")
    crossing: float | None = param(
        None, unit="mm", above=0.0, at_most=0.3, doc="side grippers along the screw; none: room for the centre gripper"
    )
    crossing_turn: float | None = param(
        None, unit="deg", above=0.0, at_most=turn / 2, doc="what the screw turns them by; none: until the ends cross"
    )
    overlap: float = param(0.0015, unit="mm", at_least=5e-4, at_most=0.05, doc="ends past the middle when they cross")
    finger: float = param(0.002, unit="mm", above=0.0, at_most=0.05, doc="thickness of the grippers' rods and arms")
    clearance: float = param(0.0005, unit="mm", at_least=0.0, at_most=0.05, doc="least room between what moves")
    pair_opened: float | None = param(
        None, unit="mm", above=0.0, at_most=0.1, doc="the pair of warps in the opener's slots; none: 6 mm, or room"
    )
    tail: float = param(0.002, unit="mm", at_least=0.0, at_most=0.05, doc="yarn held in a side gripper, each end")
    centre_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="centre gripper forward")
    sley_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="sley down")
    knot_yarn: float | None = param(
        None,
        unit="mm",
        above=0.0,
        at_most=0.3,
        doc="pile yarn of a knot by its bill, waste included; none: as below",
    )
    pile_height: float = param(8 * mm, unit="mm", at_least=0.0, at_most=100 * mm, doc="pile above the knots, shorn")
    cut_waste: float = param(1 * mm, unit="mm", at_least=0.0, at_most=100 * mm, doc="shorn off each end of a knot")
    yarn_density: float = param(0.8 * g / m, unit="g/m", above=0.0, at_most=0.1, doc="mass per length of the pile yarn")
    warp_diameter: float | None = param(
        None, unit="mm", above=0.0, at_most=10 * mm, doc="diameter of a warp; none: of the usual wool warp"
    )
    speed_limit: float = param(
        1.0, unit="m/s", at_least=1e-3, at_most=100.0, doc="allowed speed of grippers, sley and handler's tip"
    )
    acceleration_limit: float = param(
        20.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="allowed acceleration of the same"
    )
    tool_mass: float = param(0.15, unit="kg", at_least=0.0, at_most=100.0, doc="mass that each cam moves")
    lever: float = param(2.0, above=0.05, at_most=20.0, doc="motion of a tool over its cam's follower")
    pinion: float = param(
        0.006, unit="mm", at_least=1e-3, at_most=0.1, doc="radius of the handler's pinion on the rack of its cam"
    )
    closure: str = param("spring", choices=("spring", "groove"), doc="what holds the followers to their cams")
    contact_force: float = param(5.0, unit="N", at_least=0.0, at_most=1e4, doc="least force of a sprung roller")
    pressure_angle_limit: float = param(
        30 * deg, unit="deg", at_least=5 * deg, at_most=60 * deg, doc="largest pressure angle of the cams"
    )
    roller_radius: float = param(0.0065, unit="mm", at_least=1e-3, at_most=0.05, doc="radius of the cams' rollers")
    cam_thickness: float = param(0.008, unit="mm", at_least=5e-4, at_most=0.05, doc="thickness of a cam")
    cam_gap: float = param(0.003, unit="mm", at_least=0.0, at_most=0.05, doc="gap between cams, and beside them")
    shaft: float = param(0.015, unit="mm", at_least=0.007, at_most=0.1, doc="diameter of the cam shaft")
    head_width: float = param(0.080, unit="mm", at_least=0.01, at_most=1.0, doc="width of the head, along the row")
    cam_room: float = param(0.250, unit="mm", at_least=0.02, at_most=2.0, doc="room for a cam's diameter in the head")
    knot_pitch: float = param(
        0.004, unit="mm", at_least=1 / FINEST, at_most=1 / COARSEST, doc="distance of neighbouring knots"
    )
    row_pitch: float | None = param(
        None, unit="mm", at_least=1 / FINEST, at_most=1 / COARSEST, doc="distance of rows; none: as of the knots"
    )
    carriage_speed: float = param(0.25, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the head along the row")
    carriage_acceleration: float = param(
        2.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the head along the row"
    )
    carriage_jerk: float = param(100.0, unit="m/s^3", at_least=1e-3, at_most=1e9, doc="jerk of the head along the row")
    cutter_acceleration: float = param(
        50.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the cutter's blade"
    )
    tubes: int = param(16, at_least=1, at_most=255, doc="yarn tubes, one for each colour")
    tube_pitch: float = param(0.012, unit="mm", at_least=1e-6, at_most=1.0, doc="distance of neighbouring tubes")
    selector_speed: float = param(0.2, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the colour selector")
    selector_acceleration: float = param(
        1.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the colour selector"
    )
    selector_jerk: float = param(50.0, unit="m/s^3", at_least=1e-3, at_most=1e9, doc="jerk of the colour selector")
    tube_mass: float = param(0.02, unit="kg", at_least=0.0, at_most=10.0, doc="a yarn tube with its share of the slide")
    selector_pulley: float = param(
        0.010, unit="mm", at_least=1e-3, at_most=0.2, doc="pitch radius of the pulley that draws the tubes"
    )

    def check_together(self) -> None:
        """The steps of the turn follow each other, each with angle enough; the opener makes room for a gripper."""
        ends = {"prepare_end": self.prepare_end, "open_end": self.open_end, "knot_end": self.knot_end}
        before, at = "the beginning of the turn", 0.0
        for name, end in (*ends.items(), ("press_end", self.press_end)):
            if end < at + LEAST_STEP:
                raise ParameterError(
                    f"{name}={format_quantity(end, 'deg')} leaves the step after {before} no room",
                    allowed=f"at least {format_quantity(at + LEAST_STEP, 'deg')}",
                )
            before, at = name, end
        _require_room(self)

    @property
    def quality(self) -> Quality:
        """The carpet's quality by the distances of its knots."""
        return Quality(1 / self.knot_pitch, 1 / (self.row_pitch or self.knot_pitch))

    @property
    def warp(self) -> float:
        """Diameter of a warp [m]."""
        return self.warp_diameter or warp_diameter(self.quality.warp_pitch)

    @property
    def yarn(self) -> float:
        """Diameter of the pile yarn [m]."""
        return WOOL.diameter(self.yarn_density)

    @property
    def billed(self) -> float:
        """Pile yarn of a knot by the yarn bill [m], what is shorn off included: as given, or by `carpet.pile`."""
        if self.knot_yarn is not None:
            return self.knot_yarn
        pile = PileParams(pile_height=self.pile_height, cut_waste=self.cut_waste, warp_diameter=self.warp_diameter)
        return knot_length(self.knot, self.quality, self.yarn_density, pile)

    @property
    def cutting_time(self) -> float:
        """Time of the cutter's blade [s] across two diameters of the yarn, from rest to rest."""
        return math.sqrt(4 * 2 * self.yarn / self.cutter_acceleration)

    @property
    def centre_room(self) -> float:
        """Least distance of the pair that lets the centre gripper between [m]."""
        return self.warp + self.finger + 2 * self.clearance

    @property
    def pair(self) -> float:
        """Distance of the pair of warps in the opener's slots [m]."""
        return self.pair_opened or max(PAIR, self.centre_room)


def _require_room(params: WeaverParams) -> None:
    """Raise ParameterError where the pair in the opener's slots leaves the centre gripper no way."""
    if params.pair_opened is not None and params.pair_opened < params.centre_room:
        shown, room = (format_quantity(size, "mm") for size in (params.pair_opened, params.centre_room))
        raise ParameterError(
            f"pair_opened={shown} leaves the centre gripper no way between the warps",
            allowed=f"at least {room}: a warp, the gripper's finger and its clearances",
            do="open the pair wider, or take a thinner finger",
        )
