"""Cam angles of the head's motions.

The turn of the cam shaft is in four steps, and a motion takes fixed shares of its step, so that moving a step's end
keeps the order [thesis, 2.2.3, Figure 2.11; the thesis prints no angles, the shares are assumed by this project]:

    1 prepare    the handler turns to the tube, grasps the pile, draws it, has it cut, presents it; side grippers close
    2 open       side grippers pull back; the handler turns home; they go forward, the opener parts the warps
    3 knot       side grippers go on along the screw, linear and turning, until the pile crosses; the centre gripper
                 comes, closes; side grippers open
    4 press      side grippers turn back; the centre gripper draws the ends out between the warps; side grippers and
                 opener return, and as they leave its path the sley pushes the knot down; the centre gripper opens;
                 the sley returns

The thesis lets the centre gripper return "finally", after it has opened. It must return before: ends that are released
behind the warps stay there, and no knot is tied.

Where arms tie in place of the grippers, cam 2 moves the opener alone, and they tie in step 3 until the sley moves.

A tool moves forward and then back, each in one or more motions. Where the angles of a tool are set, its motions forward
or back keep their shares of the angle that they take together.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.params import Params, kind
from ilmek.units import format_quantity, turn

SIDE_GRASP, SIDE_MOTION = "side-gripper grasp", "side-gripper motion"
CENTRE_GRASP, CENTRE_MOTION = "centre-gripper grasp", "centre-gripper motion"
HANDLER, SLEY = "pile handler", "sley"
OPENER = "warp opener"
LEFT_ARM, RIGHT_ARM, CENTRE_ARM = "left arm", "right arm", "centre gripper"

ROUNDING = 1e-9
"""Angles this near to each other are the same [rad]."""


StepMotion: TypeAlias = tuple[str, int, float, float]
"""Name of a motion or an instant, its step, 1 to 4, and the shares of the step at which it begins and ends."""

MOTIONS: Mapping[str, tuple[tuple[StepMotion, ...], tuple[StepMotion, ...]]] = {
    SIDE_GRASP: ((("close", 1, 0.905, 1.0),), (("open", 3, 0.85, 0.985),)),
    SIDE_MOTION: (
        (("pull back", 2, 0.02, 0.215), ("open warps", 2, 0.62, 1.0), ("cross", 3, 0.0, 0.26)),
        (("turn back", 4, 0.015, 0.24), ("return", 4, 0.35, 0.64)),
    ),
    CENTRE_GRASP: ((("close", 3, 0.695, 0.83),), (("open", 4, 0.745, 0.86),)),
    CENTRE_MOTION: ((("forward", 3, 0.275, 0.68),), (("return", 4, 0.015, 0.335),)),
    HANDLER: (
        (
            *(("to tube", 1, 0.0, 0.27), ("grasp", 1, 0.285, 0.285), ("draw", 1, 0.30, 0.60)),
            *(("cut", 1, 0.62, 0.62), ("present", 1, 0.65, 0.89)),
        ),
        (("home", 2, 0.23, 0.605),),
    ),
    SLEY: ((("down", 4, 0.48, 0.735),), (("up", 4, 0.745, 1.0),)),
    OPENER: ((("open warps", 2, 0.62, 1.0),), (("return", 4, 0.35, 0.64),)),
}
"""Of each track its motions forward, and its motions back; the opener has a track of its own where arms tie."""


@dataclass(frozen=True, slots=True)
class CycleSteps:
    """Master angles at which the four steps of the turn end [rad]; the rest of the turn is a dwell of all."""

    prepare: float
    open: float
    knot: float
    press: float

    def angle(self, step: int, share: float) -> float:
        """The master angle [rad] at a share of a step, 1 to 4."""
        ends = (0.0, self.prepare, self.open, self.knot, self.press)
        return ends[step - 1] + share * (ends[step] - ends[step - 1])


@dataclass(frozen=True, slots=True)
class ToolAngles(Params):
    """Cam angles of one tool's motions, in place of those that follow from the steps of the turn."""

    start: float | None = kind.angle(
        None, at_least=0.0, below=turn, doc="cam angle at which its motions forward begin; default: by the steps"
    )
    rise: float | None = kind.angle(
        None, above=0.0, below=turn, doc="cam angle that its motions forward take together; default: by the steps"
    )
    return_start: float | None = kind.angle(
        None, above=0.0, below=turn, doc="cam angle at which its motions back begin; default: by the steps"
    )
    fall: float | None = kind.angle(
        None, above=0.0, below=turn, doc="cam angle that its motions back take together; default: by the steps"
    )

    @property
    def given(self) -> dict[str, float]:
        """The angles that are set [rad]."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: value for name, value in values.items() if value is not None}


def motion_angles(track: str, steps: CycleSteps, angles: ToolAngles) -> dict[str, tuple[float, float]]:
    """Begin and end of each motion of a track [rad], and of its instants, by name."""
    motion_angles: dict[str, tuple[float, float]] = {}
    starts, spans = (angles.start, angles.return_start), (angles.rise, angles.fall)
    for motions, start, span in zip(MOTIONS[track], starts, spans, strict=True):
        usual = {name: (steps.angle(step, one), steps.angle(step, then)) for name, step, one, then in motions}
        if start is None and span is None:
            motion_angles |= usual
            continue
        first, last = usual[motions[0][0]][0], usual[motions[-1][0]][1]
        begin, scale = first if start is None else start, 1.0 if span is None else span / (last - first)
        motion_angles |= {
            name: (begin + scale * (one - first), begin + scale * (then - first)) for name, (one, then) in usual.items()
        }
    return motion_angles


def require_order(tool: str, track: str, steps: CycleSteps, angles: ToolAngles) -> None:
    """Raise ParameterError, naming the angles set, where a tool does not move forward and then back within a turn."""
    if not angles.given:
        return
    (*_, (forward, *_)), ((back, *_), *_) = MOTIONS[track]
    at = motion_angles(track, steps, angles)
    end, begin, last = at[forward][1], at[back][0], list(at.values())[-1][1]
    given = ", ".join(f"{tool}.{name}={format_quantity(value, 'deg')}" for name, value in angles.given.items())
    shown = [format_quantity(angle, "deg") for angle in (end, begin, last)]
    if begin < end - ROUNDING:
        raise ParameterError(
            f"{given}: the motions forward end at {shown[0]}, those back begin at {shown[1]}",
            allowed=f"a return that begins at {shown[0]} or later",
            do=f"set {tool}.return_start later, or {tool}.rise smaller",
        )
    if last > turn + ROUNDING:
        do = f"set {tool}.return_start earlier, or {tool}.fall smaller"
        raise ParameterError(f"{given}: the motions back end at {shown[2]}", allowed="at most 360 deg", do=do)
