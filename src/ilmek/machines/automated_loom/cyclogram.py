"""The loom's cyclograms: a knot with the head's step to the next one, and a row of wefts and beats.

A row is two wefts and two beats on one turn of the shedding cams.                               [thesis, 3.3]

    1   0 to  90 deg    cams lift the even warps; the straight weft is laid while the shed is open for its carrier
    2  90 to 180 deg    they come down; the beater beats and is back
    3 180 to 270 deg    cams lift the odd warps; the sinuous weft is laid
    4 270 to 360 deg    they come down; the beater beats; the carpet is taken up by a row

Where a beat takes longer than they leave for it, the cams stand after each half turn, the shed closed, until it ends.

The heads stand clear of the warps for the whole turn; the knots of the row were tied before it began. The thesis prints
the four steps of 90 degrees and the harmonic law; where within them weft, beater and take-up move is chosen here. A
shuttle passes over and another back (`ilmek.machines.weft`): in every second row both start at the other edge, so that
the carriage's position is to be taken from there. A rapier goes in and out in each shed.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS, law_of
from ilmek.machines import WEFT_CARRIERS
from ilmek.machines.beat import Beat
from ilmek.machines.electronic_cam import cam_table
from ilmek.machines.warp_tension.design import TAKE_UP_LAW
from ilmek.machines.weaver import Weaver
from ilmek.machines.weaver.design import head_relations
from ilmek.machines.weaver.motions import CENTRE_ARM, CENTRE_MOTION, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.machines.weft import WeftPassage
from ilmek.records import value_record
from ilmek.report import CamTable
from ilmek.timing.cyclogram import (
    Cyclogram,
    Exclusion,
    Moment,
    Relation,
    Track,
    TrackEvent,
    TrackSegment,
    Zone,
    moment_angle,
    riding,
)
from ilmek.timing.s_curve import s_curve
from ilmek.timing.track import MotionLaw, shortest_period
from ilmek.units import deg, turn

EVEN, ODD, BEATER, TAKE_UP = "even warps", "odd warps", "beater", "take-up"
SLIDE = "slide of the beater"
SOURCE = "thesis, 3.3: the four steps of a row"
HEADS, WEAVERS, LOOM = "heads", "weavers", "loom"
WEAVERS_ROW = "row with its weavers"
"""Name of the cyclogram of weavers and loom."""
RETREAT_END = 36 * deg
"""Cam angle at which the heads have retreated from the warps; they return behind the second beat."""

GAP = 2 * deg
"""Least angle between the weft's carrier in the shed and the beater."""

_HALF = turn / 2


@value_record
class RowTiming:
    """What the cyclogram of a row is made of.

    lift, law   of the warps [m]             window  shed angles between which the weft's carrier has room [rad]
    carrier     of the weft, and its passage beat_end, take_up_end  angles of each, and of the second, half
    beat        the beater's motion          row_pitch  carpet taken up for a row [m]
    retreat     of the heads from the warps [m]; None: there are no heads
    turning     share of the row for which the shedding cams turn; else they stand, the shed closed, for the beats
    """

    lift: float
    law: str
    window: tuple[float, float]
    carrier: str
    passage: WeftPassage
    beat: Beat
    beat_end: float
    row_pitch: float
    take_up_end: float
    retreat: float | None = None
    turning: float = 1.0

    def early(self, angle: float) -> float:
        """Master angle of a cam angle of the first half of the row, after which the cams stand [rad]."""
        return self.turning * angle

    def late(self, angle: float) -> float:
        """Master angle as long before the end of the first half as a cam angle would be, were they to turn on [rad]."""
        return _HALF - self.turning * (_HALF - angle)

    def cam_angle(self, angle: FloatArray) -> FloatArray:
        """Angle of the shedding cams [rad] at master angles of the row [rad]."""
        half, within = np.divmod(np.asarray(angle), _HALF)
        return np.asarray(half * _HALF + np.minimum(within / self.turning, _HALF))

    @property
    def open(self) -> tuple[float, float]:
        """Master angles between which the even shed has room for the weft's carrier [rad]."""
        return self.early(self.window[0]), self.early(self.window[1])


CARRIAGE = "carriage"


@lru_cache(maxsize=16)
def knot_cyclogram(head: Weaver, period: float) -> Cyclogram:
    """The cyclogram of a knot at a period [s]: the head's tracks, and its carriage, which steps on to the next knot.

    The step, jerk-limited, begins when the last tool is out of the warps, and runs into the next turn where it must.
    """
    tied, limits = head.cyclogram, head.params
    names = [track.name for track in tied.tracks]
    move = s_curve(limits.cloth.knot_pitch, limits.carriage)
    out = max(tied.track(name).segment(motion).end for name, motion in _OUT if name in names) % turn
    law = law_of("s-curve", {"ramp": min(0.25, move.ramp / move.time), "cruise": move.cruise / move.time})
    step = TrackSegment("step", out, out + turn * move.time / period, 0.0, limits.cloth.knot_pitch, law)
    track = Track(
        CARRIAGE, "linear axis", (step,), (riding("at the next knot", step),), revolves=limits.cloth.knot_pitch
    )
    apart = tuple(
        Exclusion(
            Zone(CARRIAGE, 0.0, limits.cloth.knot_pitch, "between two knots"),
            Zone(name, 0.0, name="in the warps"),
            why=_CLEAR,
        )
        for name in _IN_THE_WARPS
        if name in names
    )
    relations = (*tied.relations, *head_relations(head))
    return Cyclogram(tied.name, period, (*tied.tracks, track), relations, (*tied.exclusions, *apart))


def weavers_row(acts: Sequence[tuple[str, str, float]]) -> Cyclogram:
    """The cyclogram of a row that weavers tie: acts of weavers and loom by name and time [s], one after the other."""
    period, actuators = sum(time for *_, time in acts), {WEAVERS: "weavers by hand", LOOM: "loom"}
    ends, law = np.cumsum([turn * time / period for *_, time in acts]).tolist(), _law("uniform")
    spans = list(zip([0.0, *ends], ends, acts, strict=False))

    def track(who: str) -> Track:
        own = [(act, begin, end) for begin, end, (doer, act, _) in spans if doer == who]
        share = 1 / len(own)
        parts = (
            TrackSegment(act, begin, end, number * share, (number + 1) * share, law)
            for number, (act, begin, end) in enumerate(own)
        )
        return Track(who, actuators[who], tuple(parts), unit="1", revolves=1.0)

    return Cyclogram(WEAVERS_ROW, period, (track(WEAVERS), track(LOOM)))


def cam_tables_of(cyclogram: Cyclogram, names: tuple[str, ...]) -> tuple[CamTable, ...]:
    """Some tracks of a cyclogram for a controller's electronic cams."""
    return tuple(
        cam_table(
            cyclogram.track(name), f"{cyclogram.name}-{name}", f"{name} over a {cyclogram.name}", cyclogram.period
        )
        for name in names
    )


_OUT = ((SIDE_MOTION, "return"), (CENTRE_MOTION, "return"), (OPENER, "return"), (SLEY, "up"))
_IN_THE_WARPS = (SIDE_MOTION, CENTRE_MOTION, OPENER, LEFT_ARM, RIGHT_ARM, CENTRE_ARM, SLEY)
_CLEAR = "the head moves along the row only while no tool of it is in the warps"


def shortest_passage(timing: RowTiming) -> float:
    """The shortest turn of the cams [s] in which the weft's carrier keeps its limits; inf where no angle is left."""
    first, last = timing.window
    return timing.passage.time * turn / (last - first) if last > first else math.inf


def timed(timing: RowTiming, cam_turn: float, stop: float) -> tuple[RowTiming, float]:
    """The timing with the share for which the cams turn, and the time of the row [s], for a turn of the cams [s].

    stop  time in which the cams stop and start again [s]
    The cams turn on where the beat fits between the weft's carrier and `beat_end`. Where it does not, they turn more
    slowly, or stand twice with the shed closed for beat and take-up: what takes less time. inf where no angle is left
    for the beat.
    """
    first, last = timing.window
    free = timing.beat_end - last - GAP
    if free <= 0 or last <= first:
        return timing, math.inf
    slow = max(cam_turn, timing.beat.whole * turn / free)
    if slow <= cam_turn * (1 + 1e-12):
        return timing, cam_turn
    after = (_HALF - timing.beat_end) / turn * cam_turn
    stands = cam_turn + 2 * (stop + timing.beat.whole + after)
    return (replace(timing, turning=cam_turn / stands), stands) if stands < slow else (timing, slow)


def cyclogram(timing: RowTiming, period: float) -> Cyclogram:
    """The cyclogram of a row at its time [s].

    Raises ParameterError where weft, beat and take-up do not follow each other.
    """
    tracks = (
        _warps(EVEN, timing, 0.0),
        _warps(ODD, timing, _HALF),
        _weft(timing),
        *beat_tracks(timing.beat, period, timing.late(timing.beat_end)),
        _take_up(timing),
        *_heads(timing),
    )
    return Cyclogram("row", period, tracks, relations(timing))


def relations(timing: RowTiming) -> tuple[Relation, ...]:
    """What must come after what on the turn."""
    name = timing.carrier
    first, second = _passes(timing)
    room = f"the {name} moves only where the shed has room for it"
    clear = f"beater and {name} are never in the shed together"
    begins, ends = f"room for the {name}", "room ends"
    order = (
        (Moment(name, first[0].name, "start"), Moment(EVEN, begins, "event"), 0.0, room),
        (Moment(EVEN, ends, "event"), Moment(name, first[-1].name, "end"), 0.0, room),
        (Moment(BEATER, "beat 1", "start"), Moment(name, first[-1].name, "end"), GAP, clear),
        (Moment(name, second[0].name, "start"), Moment(BEATER, "back 1", "end"), GAP, clear),
        (Moment(name, second[0].name, "start"), Moment(ODD, begins, "event"), 0.0, room),
        (Moment(ODD, ends, "event"), Moment(name, second[-1].name, "end"), 0.0, room),
        (Moment(BEATER, "beat 2", "start"), Moment(name, second[-1].name, "end"), GAP, clear),
        (Moment(ODD, "lift", "start"), Moment(EVEN, "lower", "end"), 0.0, SOURCE),
        (Moment(TAKE_UP, "take up", "start"), Moment(BEATER, "back 2", "end"), 0.0, "the beater is off the fell"),
    )
    return tuple(Relation(then, first, gap, why) for then, first, gap, why in order)


def _law(name: str) -> MotionLaw:
    return LAWS[name]


def _warps(name: str, timing: RowTiming, shift: float) -> Track:
    law, quarter = _law(timing.law), timing.early(turn / 4)
    parts = (
        TrackSegment("lift", shift, shift + quarter, 0.0, timing.lift, law),
        TrackSegment("lower", shift + quarter, shift + 2 * quarter, timing.lift, 0.0, law),
    )
    first, last = timing.open
    events = (TrackEvent(f"room for the {timing.carrier}", shift + first), TrackEvent("room ends", shift + last))
    return Track(name, "shedding cams", parts, events)


def _passes(timing: RowTiming) -> tuple[tuple[TrackSegment, ...], tuple[TrackSegment, ...]]:
    """The motions of the weft's carrier in the even and in the odd shed, each stretched to the window."""
    (first, last), passage = timing.open, timing.passage
    law, stroke = passage.law, passage.stroke
    if not passage.back:
        over = TrackSegment("pass", first, last, 0.0, stroke, law)
        return (over,), (TrackSegment("pass back", _HALF + first, _HALF + last, stroke, 0.0, law),)
    spent = passage.share * (last - first)

    def there_and_back(number: int, shift: float) -> tuple[TrackSegment, ...]:
        return (
            TrackSegment(f"insert {number}", shift + first, shift + first + spent, 0.0, stroke, law),
            TrackSegment(f"withdraw {number}", shift + last - spent, shift + last, stroke, 0.0, law),
        )

    return there_and_back(1, 0.0), there_and_back(2, _HALF)


def _weft(timing: RowTiming) -> Track:
    straight, sinuous = _passes(timing)
    events = (riding("straight weft laid", straight[-1]), riding("sinuous weft laid", sinuous[-1]))
    return Track(timing.carrier, "linear axis", (*straight, *sinuous), events)


def weft_windows(row: Cyclogram) -> tuple[tuple[float, float], tuple[float, float]]:
    """Angles between which the weft's carrier is in the even and in the odd shed [rad]."""
    moves = next(track for track in row.tracks if track.name in WEFT_CARRIERS).segments
    first, second = moves[: len(moves) // 2], moves[len(moves) // 2 :]
    return (first[0].start, first[-1].end), (second[0].start, second[-1].end)


def beat_tracks(beat: Beat, period: float, end: float) -> tuple[Track, ...]:
    """The tracks of what beats and of its slide, if any, over two beats; end: angle at which all of the first stands
    [rad], the second half a turn later.
    """
    back = end - turn * beat.park_time / period  # but for the run of the slide to where it stands
    return (_beater(beat, period, back), *_slide(beat, period, back))


def _beater(beat: Beat, period: float, back: float) -> Track:
    """Two beats, each forward, pressed where it is, and back."""
    spent = turn * beat.time / period
    parts: list[TrackSegment] = []
    for number, end in ((1, back), (2, _HALF + back)):
        start = end - spent
        middle = start + beat.forward * spent
        parts += [
            TrackSegment(f"beat {number}", start, middle, 0.0, beat.stroke, beat.law),
            TrackSegment(f"back {number}", middle + beat.pressed * spent, end, beat.stroke, 0.0, beat.back_law),
        ]
    events = (TrackEvent("beat", parts[0].end), TrackEvent("beat", parts[2].end))
    return Track(BEATER, beat.actuator, tuple(parts), events)


def _slide(beat: Beat, period: float, back: float) -> tuple[Track, ...]:
    """The slide that carries the beater across, from edge to edge and back in the two beats; drawn as one motion, with
    its runs from and to where it stands beside the cloth.
    """
    law = _law("modified-sine")
    spent, parked = (turn * time / period for time in (beat.time, beat.park_time))
    first, last = back - spent * (1 - beat.forward), back - spent * (1 - beat.forward - beat.pressed)
    whole = 2 * beat.park + beat.slide
    runs = (
        ("in", back - spent - parked, back - spent, 0.0, beat.park),
        ("across", first, last, beat.park, beat.park + beat.slide),
        ("out", back, back + parked, beat.park + beat.slide, whole),
    )
    there = [TrackSegment(*run, law) for run in runs if run[3] != run[4]]
    again = [
        TrackSegment(f"{name} again", _HALF + start, _HALF + end, whole - begin, whole - finish, law)
        for name, start, end, begin, finish in runs
        if begin != finish
    ]
    return (Track(SLIDE, "linear axis", (*there, *again)),) if there else ()


def _take_up(timing: RowTiming) -> Track:
    start, end = (_HALF + timing.late(angle) for angle in (timing.beat_end, timing.take_up_end))
    part = TrackSegment("take up", start, end, 0.0, timing.row_pitch, TAKE_UP_LAW)
    return Track(TAKE_UP, "warp cylinder", (part,), revolves=timing.row_pitch)


def _heads(timing: RowTiming) -> tuple[Track, ...]:
    """The heads' rail, if any: away from the warps while the shed opens, and back behind the second beat."""
    if timing.retreat is None:
        return ()
    law = _law("cycloidal")
    parts = (
        TrackSegment("retreat", 0.0, timing.early(RETREAT_END), 0.0, timing.retreat, law),
        TrackSegment("return", _HALF + timing.late(timing.beat_end), turn, timing.retreat, 0.0, law),
    )
    return (Track(HEADS, "linear axes", parts),)


def shortest_retreat(timing: RowTiming, speed_limit: float, acceleration_limit: float) -> float:
    """The shortest turn of the cams [s] in which the heads' rail keeps its limits; 0 without heads."""
    return max((shortest_period(track, speed_limit, acceleration_limit) for track in _heads(timing)), default=0.0)


def row_ends(row: Cyclogram) -> tuple[float, ...]:
    """Times [s] at which straight weft, first beat, sinuous weft, second beat and take-up of a row end.

    A weft ends where it is laid, a beat where the beater is back, the take-up with the turn.
    """
    carrier = next(track.name for track in row.tracks if track.name in WEFT_CARRIERS)
    moments = (
        Moment(carrier, "straight weft laid", "event"),
        Moment(BEATER, "back 1", "end"),
        Moment(carrier, "sinuous weft laid", "event"),
        Moment(BEATER, "back 2", "end"),
    )
    return (*(moment_angle(row, moment) / turn * row.period for moment in moments), row.period)


def take_up_time(timing: RowTiming, period: float) -> float:
    """Time of the take-up [s] at a time of the row [s]."""
    return timing.turning * (timing.take_up_end - timing.beat_end) / turn * period
