"""The knotting head's parameters and its design: cycle, limits, carriage and colour selector."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.cams.laws import LAWS
from ilmek.errors import ParameterError
from ilmek.machines.weaver.cyclogram import CENTRE_MOTION, DRAW_TURN, HANDLER, SIDE_MOTION, SLEY, Steps, Strokes
from ilmek.machines.weaver.cyclogram import cyclogram as knot_cyclogram
from ilmek.machines.weaver.drive import Drive, drive_for
from ilmek.params import Params, param
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, peak_acceleration, peak_speed, shortest_period
from ilmek.units import deg, format_quantity, turn

HAND_KNOT = 2.4
"""The best hand weaver's time for a knot [s]: 25 a minute."""

LEAST_STEP = 10 * deg
"""Least angle of a step of the turn."""


@dataclass(frozen=True, slots=True)
class WeaverParams(Params):
    """What may be asked of a knotting head. Phases and strokes are choices of ours: the thesis prints none."""

    cycle: float = param(
        2.0,
        unit="s",
        at_least=1e-3,
        at_most=3600.0,
        doc="time of a knot that is asked for; longer where limits demand it",
    )
    law: str = param("modified-sine", choices=tuple(LAWS), doc="law of all motions")
    prepare_end: float = param(100 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the pile is ready")
    open_end: float = param(172 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the warps are open")
    knot_end: float = param(250 * deg, unit="deg", above=0.0, below=turn, doc="cam angle at which the knot is made")
    press_end: float = param(345 * deg, unit="deg", above=0.0, at_most=turn, doc="cam angle at which all are back")
    relation_gap: float = param(1 * deg, unit="deg", at_least=0.0, below=turn, doc="least gap of motions in sequence")
    jaw: float = param(0.003, unit="mm", above=0.0, at_most=0.05, doc="opening of the grippers' jaws")
    pull_back: float = param(0.008, unit="mm", above=0.0, at_most=0.1, doc="side grippers back, to free the handler")
    opening: float = param(0.020, unit="mm", above=0.0, at_most=0.3, doc="side grippers and opener forward")
    crossing: float = param(0.020, unit="mm", above=0.0, at_most=0.3, doc="side grippers along the screw")
    crossing_turn: float = param(180 * deg, unit="deg", above=0.0, at_most=turn, doc="what the screw turns them by")
    centre_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="centre gripper forward")
    sley_stroke: float = param(0.025, unit="mm", above=0.0, at_most=0.3, doc="sley down")
    knot_yarn: float = param(0.045, unit="mm", above=0.0, at_most=0.3, doc="pile yarn drawn for a knot, waste included")
    speed_limit: float = param(
        1.0, unit="m/s", at_least=1e-3, at_most=100.0, doc="allowed speed of grippers, sley and handler's tip"
    )
    acceleration_limit: float = param(
        20.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="allowed acceleration of the same"
    )
    tool_mass: float = param(0.15, unit="kg", at_least=0.0, at_most=100.0, doc="mass that each cam moves")
    knot_pitch: float = param(0.004, unit="mm", at_least=1e-6, at_most=0.1, doc="distance of neighbouring knots")
    carriage_speed: float = param(0.25, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the head along the row")
    carriage_acceleration: float = param(
        2.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the head along the row"
    )
    tubes: int = param(16, at_least=1, at_most=255, doc="yarn tubes, one for each colour")
    tube_pitch: float = param(0.012, unit="mm", at_least=1e-6, at_most=1.0, doc="distance of neighbouring tubes")
    selector_speed: float = param(0.2, unit="m/s", at_least=1e-3, at_most=100.0, doc="speed of the colour selector")
    selector_acceleration: float = param(
        1.0, unit="m/s^2", at_least=1e-3, at_most=1e5, doc="acceleration of the colour selector"
    )

    def check_together(self) -> None:
        """The steps of the turn follow each other, each with angle enough."""
        ends = {"prepare_end": self.prepare_end, "open_end": self.open_end, "knot_end": self.knot_end}
        before, at = "the beginning of the turn", 0.0
        for name, end in (*ends.items(), ("press_end", self.press_end)):
            if end < at + LEAST_STEP:
                raise ParameterError(
                    f"{name}={format_quantity(end, 'deg')} leaves the step after {before} no room",
                    allowed=f"at least {format_quantity(at + LEAST_STEP, 'deg')}",
                )
            before, at = name, end


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
    handler_radius   of the handler's tip [m], such that it draws the pile yarn of a knot
    carriage_step    time of a step to the next knot [s]      carriage_window  time in which no gripper is in the warps
    travel           time of each further pitch [s]           colour_change    mean time to bring another tube in line
    drive            of the cam shaft, by the tools' inertia
    """

    params: WeaverParams
    cyclogram: Cyclogram
    peaks: Mapping[str, TrackPeaks]
    cycle: float
    handler_radius: float
    carriage_step: float
    carriage_window: float
    travel: float
    colour_change: float
    drive: Drive

    @property
    def colour_change_longest(self) -> float:
        """Time to bring the last tube in line after the first [s]; none for a single tube."""
        params = self.params
        distance = (params.tubes - 1) * params.tube_pitch
        return move_time(distance, params.selector_speed, params.selector_acceleration)

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
        return self.params.crossing * turn / self.params.crossing_turn


def design(params: WeaverParams) -> Weaver:
    """The head that ties a knot in the time asked for, or in the shortest that speeds and accelerations allow."""
    steps = Steps(params.prepare_end, params.open_end, params.knot_end, params.press_end)
    strokes = Strokes(
        params.jaw,
        params.pull_back,
        params.opening,
        params.crossing,
        params.centre_stroke,
        params.sley_stroke,
        params.law,
    )
    radius = params.knot_yarn / DRAW_TURN
    asked = knot_cyclogram(steps, strokes, params.cycle)
    cycle = max(params.cycle, *(_peaks(track, asked.period, radius, params).shortest for track in asked.tracks))
    kept = knot_cyclogram(steps, strokes, cycle)
    return Weaver(
        params,
        kept,
        {track.name: _peaks(track, cycle, radius, params) for track in kept.tracks},
        cycle,
        radius,
        move_time(params.knot_pitch, params.carriage_speed, params.carriage_acceleration),
        carriage_window(kept),
        travel_time(params, carriage_window(kept)),
        colour_change_time(params),
        drive_for(kept, {HANDLER: radius}, params.tool_mass),
    )


def move_time(distance: float, speed: float, acceleration: float) -> float:
    """Time of a move from rest to rest [s], at constant acceleration up to a speed.

    t = d/v + v/a where the speed is reached, d >= v^2/a; else t = 2 sqrt(d/a).
    """
    if distance >= speed**2 / acceleration:
        return distance / speed + speed / acceleration
    return 2 * math.sqrt(distance / acceleration)


def travel_time(params: WeaverParams, window: float) -> float:
    """Time t of each further pitch of a longer move [s], such that no move of d pitches p takes longer than reckoned:

        move_time(d p) <= W + (d - 1) t   for every d,   W = max(window, move_time(p))

    With a window [s] for start and stop, t is p / v; in a shorter one they take a part of it. Below the distance v^2/a
    the greatest (2 sqrt(d p / a) - W) / (d - 1) is at sqrt d = c + sqrt(c^2 - 1), c = W / (2 sqrt(p / a)).
    """
    p, v, a = params.knot_pitch, params.carriage_speed, params.carriage_acceleration
    room = max(window, move_time(p, v, a))
    c = max(1.0, room / (2 * math.sqrt(p / a)))
    worst = max(2.0, min((c + math.sqrt(c**2 - 1)) ** 2, v**2 / (a * p)))
    return max(p / v, (move_time(worst * p, v, a) - room) / (worst - 1))


def colour_change_time(params: WeaverParams) -> float:
    """Mean time to bring another tube in line [s]; none for a single tube.

    Of the n (n - 1) / 2 pairs of tubes in a line, n - d are d pitches apart.
    """
    n, p, v, a = params.tubes, params.tube_pitch, params.selector_speed, params.selector_acceleration
    return sum((n - d) * move_time(d * p, v, a) for d in range(1, n)) / max(n * (n - 1) / 2, 1)


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
