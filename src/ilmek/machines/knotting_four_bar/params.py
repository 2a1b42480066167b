"""Parameters of the knotting four-bar."""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from ilmek.errors import ParameterError
from ilmek.machines.knotting_four_bar.hands.task import HandsTask
from ilmek.machines.strength_params import LINK_MATERIALS, StrengthParams
from ilmek.params import Params, Setting, declared, kind, nested
from ilmek.params.text_lists import read_poses
from ilmek.synthesis.burmester.constant_distance import require_task
from ilmek.synthesis.three_poses import ThreePoses, ThreePoseSynthesis
from ilmek.units import MPa, deg, mm, turn
from ilmek.weaving.cloth import warp_pitch_of

SMALL, LARGE = 1e-4, 5.0
"""Bounds of plausible lengths [m]."""

OTHERS = {
    1: "one leaves nearly everything free: give three",
    2: "two leave a family for every ground angle: give three",
    4: "for 4 poses: motion-four-bar",
    5: "for 5 poses: motion-four-bar",
}
"""What to do with other numbers of poses."""

SYNTHESISED = ("ground", "crank", "coupler", "rocker", "branch", "hand")
"""Parameters that follow from poses."""

_length = partial(kind.length, at_least=SMALL, at_most=LARGE)
_direction = partial(kind.angle, at_least=-turn, at_most=turn)


@dataclass(frozen=True, slots=True)
class AcetalStrengthParams(StrengthParams):
    """What links of acetal and their steel pins bear."""

    material: str = kind.choice("POM", LINK_MATERIALS, doc="material of the links, for their strength")


@dataclass(frozen=True, slots=True)
class KnottingFourBarParams(Params):
    """Parameters of a knotting four-bar; the defaults are the report's, the aliases its symbols.

    With `poses` the links, the hand and the branch follow from them, and may not be given.
    """

    poses: str | None = kind.text(
        None, doc="three poses of the hand and the coupler, like (0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
    )
    ground: float = _length(78.105 * mm, doc="distance of the pivots O1 and O1'", symbol="r0", alias="r0")
    crank: float = _length(82.345 * mm, doc="driven link, O1 to O2", symbol="r1", alias="r1")
    coupler: float = _length(15.688 * mm, doc="coupler between its pins, O2 to O2'", symbol="r2", alias="r2")
    rocker: float = _length(65.426 * mm, doc="link O1' to O2'", symbol="r3", alias="r3")
    ground_angle: float | None = _direction(
        None,
        doc="direction from O1 to O1'; default: the one with which the loop closes at the stated pose. With poses, of "
        "the ray from their origin that both pivots lie on; default: the best",
        symbol="θg",
    )
    stated_crank_angle: float = _direction(135 * deg, doc="crank angle of the stated pose")
    stated_coupler_angle: float = _direction(10 * deg, doc="coupler angle of the stated pose")
    branch: int = kind.count(
        -1, at_least=-1, at_most=1, doc="+1: pin O2' on the left of the line O2-O1', -1: on the right"
    )
    crank_angle: float | None = kind.angle(
        None,
        at_least=-2 * turn,
        at_most=2 * turn,
        doc="crank angle to report; default: 135°, with poses that of the first",
        symbol="θ1",
    )
    speed: float = kind.angular_speed(
        1.0, unit="rad/s", at_least=-1e4, at_most=1e4, doc="speed of the crank", symbol="ω1"
    )
    acceleration: float = kind.angular_acceleration(
        0.0, at_least=-1e7, at_most=1e7, doc="angular acceleration of the crank", symbol="α1"
    )
    hand: float = kind.length(
        32.637 * mm,
        at_least=-LARGE,
        at_most=LARGE,
        doc="gripping point on the coupler, from O2 towards O2'; below 0: on the other side of O2",
        symbol="a2",
        alias="a2",
    )
    grip_force: float = kind.force(15.0, at_least=0.0, at_most=1e5, doc="force of the yarn on the gripping point")
    grip_angle: float = _direction(90 * deg, doc="direction of the force of the yarn, from x")
    density: float = kind.density(1415.9, above=0.0, at_most=1e5, doc="density of all parts; acetal", symbol="ρ")
    width: float = _length(6 * mm, doc="width of the links, in the plane of motion")
    thickness: float = _length(5 * mm, doc="thickness of links, holder and gripper")
    holder_length: float = _length(2 * mm, doc="holder beyond the coupler's end, along it")
    holder_width: float = _length(8 * mm, doc="holder, across the coupler")
    gripper_length: float = _length(5 * mm, doc="gripper beyond the holder, along the coupler")
    gripper_width: float = _length(4 * mm, doc="both jaws of the gripper, across the coupler")
    link_mass: str = kind.choice(
        "bars",
        ("bars", "made"),
        doc="mass of the links: of bars from pin to pin, as in the report, or as made, with round ends, holes and pins",
    )
    strength: AcetalStrengthParams = nested(AcetalStrengthParams, doc="what links and pins bear")
    gravity: float = kind.acceleration(9.81, at_least=0.0, at_most=1e3, doc="gravity, towards -y", symbol="g")
    gear_ratio: float | None = kind.ratio(
        None,
        above=0.0,
        at_most=1e4,
        doc="turns of the servo for one of the crank; default: the least with which the smallest servo is enough",
    )
    gear_efficiency: float = kind.ratio(0.9, above=0.0, at_most=1.0, doc="efficiency of the servo's gears", symbol="η")

    sides: int = kind.count(
        1, at_least=1, at_most=2, doc="2: the mirrored four-bar ties from the other side, both cranks coupled by gears"
    )
    axis_distance: float | None = _length(
        None, doc="distance of the pivots of the two cranks, axes of the gears; default: the least with side_clearance"
    )
    side_clearance: float = kind.length(
        1 * mm, at_least=0.0, at_most=LARGE, doc="least clearance of the two sides over the motion"
    )
    gear_module: float | None = kind.length(
        None, at_least=0.1 * mm, at_most=20 * mm, doc="of the gears; default: the finest that is strong enough"
    )
    gear_width: float = _length(8 * mm, doc="width of the gears, along their axes")
    gear_stress: float = kind.pressure(
        20 * MPa, above=0.0, at_most=2e9, doc="allowed bending stress of the teeth; a cautious value for acetal"
    )
    warp_pitch: float = warp_pitch_of(2 * mm, "distance of the two warps between the sides, for the proof of the knot")
    task: HandsTask = nested(HandsTask, doc="hands to search for a knot, in place of this four-bar")

    def check_together(self) -> None:
        """Raise ParameterError for branch 0, and where links are given beside poses."""
        if self.branch == 0:
            raise ParameterError("branch=0 is no side", allowed="+1: O2' left of the line O2-O1', -1: right")
        if self.poses is not None:
            own = (one for one in declared(type(self)) if one.name in SYNTHESISED)
            _refuse_links(one.name for one in own if getattr(self, one.name) != one.default)
            read_three_poses(self.poses)

    @classmethod
    def read(
        cls, settings: Mapping[str, Setting], *, prefix: str = "", default: "KnottingFourBarParams | None" = None
    ) -> "KnottingFourBarParams":
        """Parameters from settings, see `Params.read`; beside poses no link may be set, not even to its default."""
        read = super(KnottingFourBarParams, cls).read(settings, prefix=prefix, default=default)
        if read.poses is not None:
            given = {name.casefold() for name in settings}
            own = (one for one in declared(cls) if one.name in SYNTHESISED)
            _refuse_links(one.name for one in own if given & {one.name, one.alias.casefold()})
        return read


def _refuse_links(given: Iterable[str]) -> None:
    names = ", ".join(given)
    if names:
        allowed, do = "either poses, from which links, hand and branch follow, or these", f"leave out poses, or {names}"
        raise ParameterError(f"poses are given together with {names}", allowed=allowed, do=do)


@dataclass(frozen=True, slots=True)
class PosedParams(KnottingFourBarParams):
    """Parameters in force for poses: the poses, the angle of their ray, and the links that follow from them."""

    def check_together(self) -> None:
        """Nothing: the links follow from the poses."""


def params_of(params: KnottingFourBarParams, synthesis: ThreePoseSynthesis) -> KnottingFourBarParams:
    """Parameters without poses: the links, and the direction of the ground link from O1 to O1'.

    The crank angle to report is the given one with poses, by default that of the first.
    """
    drawn = synthesis.best.candidate.four_bar
    ground, crank, coupler, rocker = drawn.lengths
    given = params.crank_angle if params.poses is not None else None
    return dataclasses.replace(
        params,
        poses=None,
        ground=ground,
        crank=crank,
        coupler=coupler,
        rocker=rocker,
        ground_angle=float(np.angle(drawn.b0 - drawn.a0)) % turn,
        branch=drawn.branch,
        hand=synthesis.hand,
        crank_angle=float(synthesis.crank_angles[0]) if given is None else given,
    )


def read_three_poses(text: str) -> ThreePoses:
    """The three poses of a text. Raises ParameterError for anything else."""
    points, angles = read_poses("poses", text)
    if len(points) in OTHERS:
        given = f"{len(points)} pose{'s' if len(points) > 1 else ''}"
        raise ParameterError(given, allowed="exactly 3", do=OTHERS[len(points)])
    if len(points) > max(OTHERS):
        raise ParameterError(
            f"{len(points)} poses", allowed="exactly 3", do="no four-bar takes more than 5 exactly: choose among them"
        )
    require_task("pose", points, angles, 3, "knotting-four-bar")
    return ThreePoses(points, angles, text)
