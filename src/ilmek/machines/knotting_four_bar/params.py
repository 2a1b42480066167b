"""What may be asked of a knotting four-bar."""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ilmek.errors import ParameterError
from ilmek.machines.knotting_four_bar.poses import Synthesis, read_three_poses
from ilmek.params import Params, Setting, declared, param
from ilmek.units import MPa, deg, mm, turn

SMALL, LARGE = 1e-4, 5.0
"""Lengths that are taken for meant [m]."""


def _length(default: float, doc: str, alias: str = "") -> Any:
    return param(default, unit="mm", at_least=SMALL, at_most=LARGE, doc=doc, symbol=alias, alias=alias)


@dataclass(frozen=True, slots=True)
class KnottingFourBarParams(Params):
    """What may be asked of a knotting four-bar; the defaults are the report's, the aliases its symbols.

    With `poses` the links, the hand and the branch follow from them, and may not be given.
    """

    poses: str | None = param(
        None, doc="three poses of the hand and the coupler, like (0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
    )
    ground: float = _length(78.105 * mm, "distance of the pivots O1 and O1'", "r0")
    crank: float = _length(82.345 * mm, "driven link, O1 to O2", "r1")
    coupler: float = _length(15.688 * mm, "coupler between its pins, O2 to O2'", "r2")
    rocker: float = _length(65.426 * mm, "link O1' to O2'", "r3")
    ground_angle: float | None = param(
        None,
        unit="deg",
        at_least=-turn,
        at_most=turn,
        doc="direction from O1 to O1'; unsaid: as it must be for the loop to close at the stated pose. With poses, of "
        "the ray from their origin that both pivots lie on; unsaid: the best",
        symbol="θg",
    )
    stated_crank_angle: float = param(
        135 * deg, unit="deg", at_least=-turn, at_most=turn, doc="crank angle of the stated pose"
    )
    stated_coupler_angle: float = param(
        10 * deg, unit="deg", at_least=-turn, at_most=turn, doc="coupler angle of the stated pose"
    )
    branch: int = param(-1, at_least=-1, at_most=1, doc="+1: pin O2' on the left of the line O2-O1', -1: on the right")
    crank_angle: float | None = param(
        None,
        unit="deg",
        at_least=-2 * turn,
        at_most=2 * turn,
        doc="crank angle to report; unsaid: 135°, with poses that of the first",
        symbol="θ1",
    )
    speed: float = param(1.0, unit="rad/s", at_least=-1e4, at_most=1e4, doc="speed of the crank", symbol="ω1")
    acceleration: float = param(
        0.0, unit="rad/s^2", at_least=-1e7, at_most=1e7, doc="angular acceleration of the crank", symbol="α1"
    )
    hand: float = param(
        32.637 * mm,
        unit="mm",
        at_least=-LARGE,
        at_most=LARGE,
        doc="gripping point on the coupler, from O2 towards O2'; below 0: on the other side of O2",
        symbol="a2",
        alias="a2",
    )
    grip_force: float = param(15.0, unit="N", at_least=0.0, at_most=1e5, doc="force of the yarn on the gripping point")
    grip_angle: float = param(
        90 * deg, unit="deg", at_least=-turn, at_most=turn, doc="direction of the force of the yarn, from x"
    )
    density: float = param(
        1415.9, unit="kg/m^3", above=0.0, at_most=1e5, doc="density of all parts; acetal", symbol="ρ"
    )
    width: float = _length(6 * mm, "width of the links, in the plane of motion")
    thickness: float = _length(5 * mm, "thickness of links, holder and gripper")
    holder_length: float = _length(2 * mm, "holder beyond the coupler's end, along it")
    holder_width: float = _length(8 * mm, "holder, across the coupler")
    gripper_length: float = _length(5 * mm, "gripper beyond the holder, along the coupler")
    gripper_width: float = _length(4 * mm, "both jaws of the gripper, across the coupler")
    gravity: float = param(9.81, unit="m/s^2", at_least=0.0, at_most=1e3, doc="free fall, towards -y", symbol="g")
    gear_ratio: float | None = param(
        None,
        above=0.0,
        at_most=1e4,
        doc="turns of the servo for one of the crank; unsaid: the least with which the smallest servo will do",
    )
    gear_efficiency: float = param(0.9, above=0.0, at_most=1.0, doc="efficiency of the servo's gears", symbol="η")

    sides: int = param(
        1, at_least=1, at_most=2, doc="2: the mirrored four-bar ties from the other side, both cranks coupled by gears"
    )
    axis_distance: float | None = param(
        None,
        unit="mm",
        at_least=SMALL,
        at_most=LARGE,
        doc="distance of the pivots of the two cranks, axes of the gears; unsaid: the least that keeps side_clearance",
    )
    side_clearance: float = param(
        1 * mm, unit="mm", at_least=0.0, at_most=LARGE, doc="kept between the two sides all the way"
    )
    gear_module: float | None = param(
        None, unit="mm", at_least=0.1 * mm, at_most=20 * mm, doc="of the gears; unsaid: the finest that bears"
    )
    gear_width: float = _length(8 * mm, "width of the gears, along their axes")
    gear_stress: float = param(
        20 * MPa, unit="MPa", above=0.0, at_most=2e9, doc="bending that the teeth bear; a cautious value for acetal"
    )
    warp_pitch: float = _length(2 * mm, "distance of the two warps between the sides, for the proof of the knot")

    def check_together(self) -> None:
        """A branch has a side; poses leave nothing of the links to give."""
        if self.branch == 0:
            raise ParameterError("branch=0 is no side", allowed="+1: O2' left of the line O2-O1', -1: right")
        if self.poses is not None:
            given = (one for one in declared(type(self)) if one.name in SYNTHESISED)
            refuse_links(one.name for one in given if getattr(self, one.name) != one.default)
            read_three_poses(self.poses)

    @classmethod
    def read(cls, settings: Mapping[str, Setting], *, prefix: str = "") -> "KnottingFourBarParams":
        """Parameters from settings by name or alias, texts with units allowed; see `Params.read`."""
        read = super(KnottingFourBarParams, cls).read(settings, prefix=prefix)
        if read.poses is not None:
            said = {given.casefold() for given in settings}
            known = (one for one in declared(cls) if one.name in SYNTHESISED)
            refuse_links(one.name for one in known if said & {one.name, one.alias.casefold()})
        return read


SYNTHESISED = ("ground", "crank", "coupler", "rocker", "branch", "hand")
"""What follows from poses."""


def refuse_links(given: Iterable[str]) -> None:
    """Raise ParameterError where anything is given beside poses that follows from them."""
    names = tuple(given)
    if names:
        raise ParameterError(
            f"poses are given together with {', '.join(names)}",
            allowed="either poses, from which links, hand and branch follow, or these",
            do=f"leave out poses, or {', '.join(names)}",
        )


def params_of(params: KnottingFourBarParams, found: Synthesis) -> KnottingFourBarParams:
    """Parameters that need no poses any more: the links and the direction of the ground link from O1 to O1'.

    The crank angle to report is that of the first pose, unless another one is asked for.
    """
    drawn = found.best.candidate.four_bar
    ground, crank, coupler, rocker = drawn.lengths
    asked = params.crank_angle if params.poses is not None else None
    return dataclasses.replace(
        params,
        poses=None,
        ground=ground,
        crank=crank,
        coupler=coupler,
        rocker=rocker,
        ground_angle=float(np.angle(drawn.b0 - drawn.a0)) % turn,
        branch=drawn.branch,
        hand=found.hand,
        crank_angle=float(found.crank_angles[0]) if asked is None else asked,
    )
