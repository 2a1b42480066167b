"""The knotting head's design: cycle, limits, carriage and colour selector."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ilmek.cams.loaded_plate_cam import CamShaftDrive, LoadedPlateCam, drive_for
from ilmek.machines.weaver.cams import cams_for
from ilmek.machines.weaver.cyclogram import DRAW_TURN, optimised
from ilmek.machines.weaver.cyclogram import cyclogram as knot_cyclogram
from ilmek.machines.weaver.grippers import Grippers, grippers_for, yarn_needed
from ilmek.machines.weaver.knot import on_the_pair, proof_text, tied_by
from ilmek.machines.weaver.motions import CENTRE_MOTION, HANDLER, SIDE_MOTION, SLEY
from ilmek.machines.weaver.params import WeaverParams
from ilmek.records import computed, record, result
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.s_curve import mean_move_time, move_time, travel_time
from ilmek.timing.track import ActuatorLimits, Track, peak_acceleration, peak_speed, shortest_period
from ilmek.units import turn
from ilmek.weaving.knots.proof import TiedKnot


@dataclass(frozen=True, slots=True)
class TrackPeaks:
    """A track at the head's cycle: stroke [m], largest speed [m/s] and acceleration [m/s²], and the shortest cycle
    that its limits allow [s]; of the handler at the tip.
    """

    stroke: float
    speed: float
    acceleration: float
    shortest: float


@record
class Weaver:
    """A designed knotting head.

    cyclogram  at its cycle                   peaks   by track, in order of the cyclogram
    grippers   in plan view                   tied    the knot that their motions tie, proved
    cams       one for each track             drive   of the cam shaft
    """

    params: WeaverParams
    cyclogram: Cyclogram
    peaks: Mapping[str, TrackPeaks]
    cycle: float = result("s", "time of a knot: as required, or the shortest possible", name="cycle_time_knot")
    drawn: float = result("mm", "pile yarn drawn for a knot", name="yarn_drawn")
    handler_radius: float = result("mm", "radius at which the handler draws that yarn")
    grippers: Grippers
    tied: TiedKnot
    carriage_step: float = result("s", "time of the step to the next knot", name="carriage_step_time")
    carriage_window: float = result("s", "time in which no tool is in the warps")
    travel: float = result("s", "time of each further pitch", name="carriage_travel_time")
    colour_change: float = result("s", "mean time to bring another tube in line", name="colour_change_time")
    cams: tuple[LoadedPlateCam, ...]
    drive: CamShaftDrive

    shortest = computed(
        "s",
        "shortest cycle that speeds and accelerations allow",
        lambda it: it.peaks[it.limiting].shortest,
        name="cycle_time_shortest",
    )
    knots_per_minute = computed("", "knots of one head in a minute, without colour changes", lambda it: 60 / it.cycle)
    cam_speed = computed("rpm", "speed of the cam shaft", lambda it: it.cyclogram.speed)
    speed_max = computed(
        "m/s", "largest speed of each track", lambda it: {name: peak.speed for name, peak in it.peaks.items()}
    )
    acceleration_max = computed(
        "m/s^2",
        "largest acceleration of each track",
        lambda it: {name: peak.acceleration for name, peak in it.peaks.items()},
    )
    knot_tied = computed(
        "",
        "the knot that the grippers' motion ties on the pair of warps, proved",
        lambda it: on_the_pair(it.tied),
        absent="none",
    )
    knot_why = computed("", "conclusion of the proof", lambda it: proof_text(it.tied))
    yarn_billed = computed(
        "mm", "pile yarn of a knot by the yarn bill, what is shorn off included", lambda it: it.params.billed
    )
    yarn_in_knot = computed(
        "mm",
        "pile yarn that stays in the carpet for a knot",
        lambda it: it.params.billed - 2 * it.params.cut_waste,
    )
    cut_waste = computed("mm", "pile yarn cut off for a knot", lambda it: it.drawn - it.yarn_in_knot)

    @computed("s", "time from the first tube to the last")
    def colour_change_longest(self) -> float:
        return move_time((self.params.tubes - 1) * self.params.tube_pitch, self.params.selector)

    @computed("", "the track that sets the shortest cycle", name="cycle_time_set_by")
    def limiting(self) -> str:
        return max(self.peaks, key=lambda name: self.peaks[name].shortest)

    @computed("s", "from cut to next grasp: a selector that knows the next colour could move in it; not used")
    def selector_window(self) -> float:
        events = {event.name: event.angle for event in self.cyclogram.track(HANDLER).events}
        return (turn - events["cut"] + events["grasp"]) / self.cyclogram.speed


def design(params: WeaverParams) -> Weaver:
    """The head that ties a knot in the required time, or in the shortest that speeds and accelerations allow."""
    drawn = max(params.billed, yarn_needed(params))
    radius, grippers = drawn / DRAW_TURN, grippers_for(params, drawn)
    cycle = _within_limits(params, knot_cyclogram(params, grippers.crossing), radius)
    window, cams = carriage_window(cycle), cams_for(params, cycle, radius)
    return Weaver(
        params=params,
        cyclogram=cycle,
        peaks={track.name: _peaks(track, cycle.period, radius, params) for track in cycle.tracks},
        cycle=cycle.period,
        drawn=drawn,
        handler_radius=radius,
        grippers=grippers,
        tied=tied_by(cycle, grippers, params.jaw),
        carriage_step=move_time(params.knot_pitch, params.carriage),
        carriage_window=window,
        travel=travel_time(params.knot_pitch, window, params.carriage),
        colour_change=mean_move_time(params.tubes, params.tube_pitch, params.selector),
        cams=cams,
        drive=drive_for(cams, cycle.speed),
    )


def _within_limits(params: WeaverParams, required: Cyclogram, radius: float) -> Cyclogram:
    """The cyclogram at the required cycle, or at the shortest that the limits allow."""
    if params.optimise:
        speed, acceleration = params.speed_limit, params.acceleration_limit
        arms = {track.name: radius if track.name == HANDLER else 1.0 for track in required.tracks}
        limits = {name: ActuatorLimits(speed / arm, acceleration / arm) for name, arm in arms.items()}
        return optimised(required, limits, params.relation_gap, params.cutting_time)
    shortest = max(_peaks(track, required.period, radius, params).shortest for track in required.tracks)
    return replace(required, period=max(required.period, shortest))


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
