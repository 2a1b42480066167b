"""The cyclogram of the knotting head: five cams on one shaft that turns once for each knot.

The order is the thesis' (section 2.2.3, Figure 2.11); its figure has no angles in the text, so these are ours. The turn
is in four steps; within a step the motions have fixed shares of it, so that moving a step's end keeps the order.

    1 prepare    the handler goes to the tube, grasps the pile, draws it, has it cut, presents it; side grippers close
    2 open       side grippers pull back; the handler turns home; they go forward, the opener parts the warps
    3 knot       side grippers go on along the screw, linear and turning, until the pile crosses; the centre gripper
                 comes, closes; side grippers open
    4 press      side grippers turn back; the centre gripper draws the ends out between the warps; side grippers and
                 opener return; the sley pushes the knot down; the centre gripper opens; the sley returns

The thesis lets the centre gripper go "finally", and does not say when it goes back. It must go back before: ends that
it lets go behind the warps stay there, and no knot is tied.
"""

import math
from dataclasses import dataclass

from ilmek.cams.laws import LAWS
from ilmek.timing.cyclogram import Cyclogram, Moment, Relation, Track, TrackEvent, TrackSegment, riding
from ilmek.timing.track import MotionLaw
from ilmek.units import deg

SIDE_GRASP, SIDE_MOTION = "side-gripper grasp", "side-gripper motion"
CENTRE_GRASP, CENTRE_MOTION = "centre-gripper grasp", "centre-gripper motion"
HANDLER, SLEY = "pile handler", "sley"
SOURCE = "thesis, 2.2.3: order of the knotting sequence"

TUBE_TURN, DRAW_TURN, PRESENT_TURN = 90 * deg, 110 * deg, 70 * deg
"""What the handler turns to the tube, drawing the pile, and to the side grippers; the rest of a turn brings it home."""


@dataclass(frozen=True, slots=True)
class Strokes:
    """Strokes of the tracks [m]: jaws of the grippers, side grippers back, forward through the warps and along the
    screw, centre gripper, sley; and the law of all motions by name.
    """

    jaw: float
    back: float
    opening: float
    crossing: float
    centre: float
    sley: float
    law: str


@dataclass(frozen=True, slots=True)
class CycleSteps:
    """Master angles at which the four steps of the turn end [rad]; the rest of the turn is a dwell of all."""

    prepare: float
    open: float
    knot: float
    press: float

    def angle(self, step: int, share: float) -> float:
        """The master angle at a share of a step, 1 to 4."""
        ends = (0.0, self.prepare, self.open, self.knot, self.press)
        return ends[step - 1] + share * (ends[step] - ends[step - 1])

    def motion(
        self, name: str, step: int, shares: tuple[float, float], path: tuple[float, float], law: str
    ) -> TrackSegment:
        """A motion between two shares of a step, from path[0] to path[1]."""
        return TrackSegment(name, self.angle(step, shares[0]), self.angle(step, shares[1]), *path, _law(law))


def cyclogram(steps: CycleSteps, strokes: Strokes, period: float) -> Cyclogram:
    """The head's cyclogram at a period of the cam shaft [s]; positions [m], of the handler [rad].

    Raises ParameterError where a step is left no angle.
    """
    tracks = (
        _side_grasp(steps, strokes),
        _side_motion(steps, strokes),
        _centre_grasp(steps, strokes),
        _centre_motion(steps, strokes),
        _handler(steps, strokes),
        _sley(steps, strokes),
    )
    return Cyclogram("knot", period, tracks)


def relations(gap: float, cut: float = 0.0) -> tuple[Relation, ...]:
    """What must come after what, by at least `gap` [rad of the cam shaft]; the cutter needs the angle `cut`."""
    blade = Relation(Moment(HANDLER, "present", "start"), Moment(HANDLER, "draw", "end"), max(gap, cut), "the cutter")
    order = (
        (Moment(HANDLER, "grasp", "event"), Moment(HANDLER, "to tube", "end")),
        (Moment(HANDLER, "draw", "start"), Moment(HANDLER, "grasp", "event")),
        (Moment(HANDLER, "cut", "event"), Moment(HANDLER, "draw", "end")),
        (Moment(HANDLER, "present", "start"), Moment(HANDLER, "cut", "event")),
        (Moment(SIDE_GRASP, "close", "start"), Moment(HANDLER, "present", "end")),
        (Moment(SIDE_MOTION, "pull back", "start"), Moment(SIDE_GRASP, "close", "end")),
        (Moment(HANDLER, "home", "start"), Moment(SIDE_MOTION, "pull back", "end")),
        (Moment(SIDE_MOTION, "open warps", "start"), Moment(HANDLER, "home", "end")),
        (Moment(CENTRE_MOTION, "forward", "start"), Moment(SIDE_MOTION, "cross", "end")),
        (Moment(CENTRE_GRASP, "close", "start"), Moment(CENTRE_MOTION, "forward", "end")),
        (Moment(SIDE_GRASP, "open", "start"), Moment(CENTRE_GRASP, "close", "end")),
        (Moment(SIDE_MOTION, "turn back", "start"), Moment(SIDE_GRASP, "open", "end")),
        (Moment(CENTRE_MOTION, "return", "start"), Moment(SIDE_GRASP, "open", "end")),
        (Moment(SIDE_MOTION, "return", "start"), Moment(CENTRE_MOTION, "return", "end")),
        (Moment(SLEY, "down", "start"), Moment(CENTRE_MOTION, "return", "end")),
        (Moment(CENTRE_GRASP, "open", "start"), Moment(SLEY, "down", "end")),
        (Moment(SLEY, "up", "start"), Moment(SLEY, "down", "end")),
    )
    return (*(Relation(then, first, gap, SOURCE) for then, first in order), blade)


def _law(name: str) -> MotionLaw:
    return LAWS[name]


def _side_grasp(steps: CycleSteps, by: Strokes) -> Track:
    parts = (
        steps.motion("close", 1, (0.905, 1.0), (0.0, by.jaw), by.law),
        steps.motion("open", 3, (0.85, 0.985), (by.jaw, 0.0), by.law),
    )
    events = (riding("pile held", parts[0]), riding("pile released", parts[1]))
    return Track(SIDE_GRASP, "cam 1", parts, events)


def _side_motion(steps: CycleSteps, by: Strokes) -> Track:
    """With the warp opener on it, and from the opened warps on the screw that turns the grippers."""
    far = by.opening + by.crossing
    parts = (
        steps.motion("pull back", 2, (0.02, 0.215), (0.0, -by.back), by.law),
        steps.motion("open warps", 2, (0.62, 1.0), (-by.back, by.opening), by.law),
        steps.motion("cross", 3, (0.0, 0.26), (by.opening, far), by.law),
        steps.motion("turn back", 4, (0.015, 0.24), (far, by.opening), by.law),
        steps.motion("return", 4, (0.35, 0.64), (by.opening, 0.0), by.law),
    )
    return Track(SIDE_MOTION, "cam 2", parts, (riding("warps open", parts[1]), riding("pile crossed", parts[2])))


def _centre_grasp(steps: CycleSteps, by: Strokes) -> Track:
    parts = (
        steps.motion("close", 3, (0.695, 0.83), (0.0, by.jaw), by.law),
        steps.motion("open", 4, (0.685, 0.80), (by.jaw, 0.0), by.law),
    )
    events = (riding("knot held", parts[0]), riding("knot released", parts[1]))
    return Track(CENTRE_GRASP, "cam 3", parts, events)


def _centre_motion(steps: CycleSteps, by: Strokes) -> Track:
    parts = (
        steps.motion("forward", 3, (0.275, 0.68), (0.0, by.centre), by.law),
        steps.motion("return", 4, (0.015, 0.335), (by.centre, 0.0), by.law),
    )
    return Track(CENTRE_MOTION, "cam 4", parts, (riding("ends drawn out", parts[1]),))


def _handler(steps: CycleSteps, by: Strokes) -> Track:
    drawn, shown = TUBE_TURN + DRAW_TURN, TUBE_TURN + DRAW_TURN + PRESENT_TURN
    parts = (
        steps.motion("to tube", 1, (0.0, 0.27), (0.0, TUBE_TURN), by.law),
        steps.motion("draw", 1, (0.30, 0.60), (TUBE_TURN, drawn), by.law),
        steps.motion("present", 1, (0.65, 0.89), (drawn, shown), by.law),
        steps.motion("home", 2, (0.23, 0.605), (shown, 2 * math.pi), by.law),
    )
    events = (TrackEvent("grasp", steps.angle(1, 0.285)), TrackEvent("cut", steps.angle(1, 0.62)))
    return Track(HANDLER, "cam 5", parts, events, unit="deg", revolves=2 * math.pi)


def _sley(steps: CycleSteps, by: Strokes) -> Track:
    parts = (
        steps.motion("down", 4, (0.35, 0.67), (0.0, by.sley), by.law),
        steps.motion("up", 4, (0.685, 1.0), (by.sley, 0.0), by.law),
    )
    return Track(SLEY, "gear", parts, (riding("knot down", parts[0]),))
