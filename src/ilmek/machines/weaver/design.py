"""The knotting head's design: cycle, limits, carriage and colour selector."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ilmek.machines.weaver import moves
from ilmek.machines.weaver.cams import HeadCam, cams_for
from ilmek.machines.weaver.cyclogram import (
    CENTRE_MOTION,
    DRAW_TURN,
    HANDLER,
    SIDE_MOTION,
    SLEY,
    CycleSteps,
    Strokes,
)
from ilmek.machines.weaver.cyclogram import cyclogram as knot_cyclogram
from ilmek.machines.weaver.drive import CamShaftDrive, drive_for
from ilmek.machines.weaver.grippers import Grippers, grippers_for, yarn_needed
from ilmek.machines.weaver.knot import on_the_pair, tied_by
from ilmek.machines.weaver.optimised import optimised
from ilmek.machines.weaver.params import WeaverParams
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import ActuatorLimits, Track, peak_acceleration, peak_speed, shortest_period
from ilmek.units import turn
from ilmek.weaving.knots.proof import TiedKnot

HAND_KNOT = 2.4
"""The best hand weaver's time for a knot [s]: 25 a minute."""


@dataclass(frozen=True, slots=True)
class TrackPeaks:
    """A track at the head's cycle: stroke [m], largest speed [m/s] and acceleration [m/s²], and the shortest cycle
    that its limits allow [s]; of the handler at the tip.
    """

    stroke: float
    speed: float
    acceleration: float
    shortest: float


@dataclass(frozen=True, slots=True)
class Weaver:
    """A designed knotting head.

    cyclogram        at the cycle it keeps            peaks  by track, in order of the cyclogram
    cycle            the time of a knot [s]: what was asked for, or the shortest that the limits allow
    drawn            pile yarn drawn for a knot [m]     handler_radius  of the handler's tip [m], such that it draws it
    grippers         in plan view                       tied  the knot that their motions tie, proved
    carriage_step    time of a step to the next knot [s]      carriage_window  time in which no gripper is in the warps
    travel           time of each further pitch [s]           colour_change    mean time to bring another tube in line
    cams             one for each track                 drive  of the cam shaft
    """

    params: WeaverParams
    cyclogram: Cyclogram
    peaks: Mapping[str, TrackPeaks]
    cycle: float
    drawn: float
    handler_radius: float
    grippers: Grippers
    tied: TiedKnot
    carriage_step: float
    carriage_window: float
    travel: float
    colour_change: float
    cams: tuple[HeadCam, ...]
    drive: CamShaftDrive

    @property
    def colour_change_longest(self) -> float:
        """Time to bring the last tube in line after the first [s]; none for a single tube."""
        return moves.colour_change_longest(self.params)

    @property
    def selector_window(self) -> float:
        """Time from the cut of a pile to the grasp of the next [s], in which the selector could go ahead."""
        events = {event.name: event.angle for event in self.cyclogram.track(HANDLER).events}
        return (turn - events["cut"] + events["grasp"]) / self.cyclogram.speed

    @property
    def limiting(self) -> str:
        """The track that sets the shortest cycle."""
        return max(self.peaks, key=lambda name: self.peaks[name].shortest)

    @property
    def shortest(self) -> float:
        """The shortest cycle that all limits allow [s]."""
        return self.peaks[self.limiting].shortest

    @property
    def screw_lead(self) -> float:
        """Advance of the side grippers' screw per turn [m]."""
        return self.grippers.crossing * turn / self.grippers.turn

    @property
    def in_knot(self) -> float:
        """Pile yarn that stays in the carpet for a knot [m]: the bill's less what is shorn off both ends."""
        return self.params.billed - 2 * self.params.cut_waste

    @property
    def knot_tied(self) -> str | None:
        """Kind of the knot that is tied on the pair of warps; None where none is."""
        return on_the_pair(self.tied)


def design(params: WeaverParams) -> Weaver:
    """The head that ties a knot in the time asked for, or in the shortest that speeds and accelerations allow."""
    steps = CycleSteps(params.prepare_end, params.open_end, params.knot_end, params.press_end)
    drawn = max(params.billed, yarn_needed(params))
    radius, grippers = drawn / DRAW_TURN, grippers_for(params, drawn)
    strokes = Strokes(
        params.jaw,
        params.pull_back,
        params.opening,
        grippers.crossing,
        params.centre_stroke,
        params.sley_stroke,
        params.law,
    )
    kept = _kept(params, knot_cyclogram(steps, strokes, params.cycle), radius)
    cycle = kept.period
    cams = cams_for(params, kept, radius)
    return Weaver(
        params,
        kept,
        {track.name: _peaks(track, cycle, radius, params) for track in kept.tracks},
        cycle,
        drawn,
        radius,
        grippers,
        tied_by(kept, grippers, params.jaw),
        moves.step_time(params),
        carriage_window(kept),
        moves.travel_time(params, carriage_window(kept)),
        moves.colour_change_time(params),
        cams,
        drive_for(cams, kept.speed),
    )


def _kept(params: WeaverParams, asked: Cyclogram, radius: float) -> Cyclogram:
    """The cyclogram at the cycle asked for, or at the shortest that the limits allow."""
    if params.optimise:
        speed, pull = params.speed_limit, params.acceleration_limit
        arms = {track.name: radius if track.name == HANDLER else 1.0 for track in asked.tracks}
        limits = {name: ActuatorLimits(speed / arm, pull / arm) for name, arm in arms.items()}
        return optimised(asked, limits, params.relation_gap, params.cutting_time)
    shortest = max(_peaks(track, asked.period, radius, params).shortest for track in asked.tracks)
    return replace(asked, period=max(asked.period, shortest))


def carriage_window(cyclogram: Cyclogram) -> float:
    """Time in which the head may step along the row [s]: from the last tool out of the warps to the opener's entry."""
    out = max(
        cyclogram.track(SIDE_MOTION).segment("return").end,
        cyclogram.track(CENTRE_MOTION).segment("return").end,
        cyclogram.track(SLEY).segment("up").end,
    )
    entry = cyclogram.track(SIDE_MOTION).segment("open warps").start
    return (turn - out + entry) / cyclogram.speed


def _peaks(track: Track, period: float, radius: float, params: WeaverParams) -> TrackPeaks:
    arm = radius if track.name == HANDLER else 1.0
    return TrackPeaks(
        track.stroke * arm,
        peak_speed(track, period) * arm,
        peak_acceleration(track, period) * arm,
        shortest_period(track, params.speed_limit / arm, params.acceleration_limit / arm),
    )
