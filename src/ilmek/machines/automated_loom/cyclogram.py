"""The loom's cyclograms: a knot with the head's step to the next one, and a row of wefts and beats.

A row is two wefts and two beats on one turn of the shedding cams.                               [thesis, 3.3]

    1   0 to  90 deg    cams lift the even warps; the shuttle passes while the shed is open for it
    2  90 to 180 deg    they come down; the beater beats and is back
    3 180 to 270 deg    cams lift the odd warps; the shuttle passes back
    4 270 to 360 deg    they come down; the beater beats; the carpet is taken up by a row

The heads stand clear of the warps for the whole turn; the knots of the row were tied before it began. The thesis prints
the four steps of 90 degrees and the harmonic law; where within them shuttle, beater and take-up move is chosen here.
"""

import math

from ilmek.cams.laws import LAWS, law_of
from ilmek.machines.beat import Beat
from ilmek.machines.electronic_cam import cam_table
from ilmek.machines.warp_tension.design import TAKE_UP_LAW
from ilmek.machines.weaver import Weaver
from ilmek.machines.weaver.design import head_relations
from ilmek.machines.weaver.motions import (
    CENTRE_ARM,
    CENTRE_MOTION,
    LEFT_ARM,
    OPENER,
    RIGHT_ARM,
    SIDE_MOTION,
    SLEY,
)
from ilmek.records import value_record
from ilmek.report import CamTable
from ilmek.timing.cyclogram import Cyclogram, Exclusion, Moment, Relation, Track, TrackEvent, TrackSegment, Zone, riding
from ilmek.timing.s_curve import s_curve
from ilmek.timing.track import MotionLaw, shortest_period
from ilmek.units import deg, turn

EVEN, ODD, SHUTTLE, BEATER, TAKE_UP = "even warps", "odd warps", "shuttle", "beater", "take-up"
SOURCE = "thesis, 3.3: the four steps of a row"
HEADS = "heads"
RETREAT_END = 36 * deg
"""Cam angle at which the heads have retreated from the warps; they return behind the second beat."""

GAP = 2 * deg
"""Least angle between the shuttle in the shed and the beater."""

_HALF = turn / 2


@value_record
class RowTiming:
    """What the cyclogram of a row is made of.

    lift, law        of the warps [m]                window  shed angles between which the shuttle has room [rad]
    shuttle_stroke   from rest to rest [m]           beat_end, take_up_end  angles of each, and of the second, half
    beat             the beater's motion             row_pitch  carpet taken up for a row [m]
    retreat          of the heads from the warps [m]
    """

    lift: float
    law: str
    window: tuple[float, float]
    shuttle_stroke: float
    beat: Beat
    beat_end: float
    row_pitch: float
    take_up_end: float
    retreat: float = 0.0


CARRIAGE = "carriage"


def knot_cyclogram(head: Weaver, period: float) -> Cyclogram:
    """The cyclogram of a knot at a period [s]: the head's tracks, and its carriage, which steps on to the next knot.

    The step, jerk-limited, begins when the last tool is out of the warps, and runs into the next turn where it must.
    """
    tied, limits = head.cyclogram, head.params
    names = [track.name for track in tied.tracks]
    move = s_curve(limits.knot_pitch, limits.carriage)
    out = max(tied.track(name).segment(motion).end for name, motion in _OUT if name in names)
    law = law_of("s-curve", {"ramp": min(0.25, move.ramp / move.time), "cruise": move.cruise / move.time})
    step = TrackSegment("step", out, out + turn * move.time / period, 0.0, limits.knot_pitch, law)
    track = Track(CARRIAGE, "linear axis", (step,), (riding("at the next knot", step),), revolves=limits.knot_pitch)
    apart = tuple(
        Exclusion(
            Zone(CARRIAGE, 0.0, limits.knot_pitch, "between two knots"),
            Zone(name, 0.0, name="in the warps"),
            why=_CLEAR,
        )
        for name in _IN_THE_WARPS
        if name in names
    )
    relations = (*tied.relations, *head_relations(head))
    return Cyclogram(tied.name, period, (*tied.tracks, track), relations, (*tied.exclusions, *apart))


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


def shortest_row(timing: RowTiming, speed_limit: float, acceleration_limit: float) -> float:
    """The shortest turn of the cams [s] in which the shuttle keeps its limits and the beat fits behind it.

    inf where no angle is left between shuttle and beat.
    """
    room = timing.beat_end - timing.window[1] - GAP
    if room <= 0:
        return math.inf
    return max(shortest_period(_shuttle(timing), speed_limit, acceleration_limit), timing.beat.time * turn / room)


def cyclogram(timing: RowTiming, period: float) -> Cyclogram:
    """The cyclogram of a row at a period of the shedding cams [s].

    Raises ParameterError where shuttle, beat and take-up do not follow each other.
    """
    tracks = (
        _warps(EVEN, timing, 0.0),
        _warps(ODD, timing, _HALF),
        _shuttle(timing),
        _beater(timing, period),
        _take_up(timing),
        _heads(timing),
    )
    return Cyclogram("row", period, tracks, relations())


def relations() -> tuple[Relation, ...]:
    """What must come after what on the turn."""
    room = "the shuttle moves only where the shed has room for it"
    clear = "beater and shuttle are never in the shed together"
    order = (
        (Moment(SHUTTLE, "pass", "start"), Moment(EVEN, "room for the shuttle", "event"), 0.0, room),
        (Moment(EVEN, "room ends", "event"), Moment(SHUTTLE, "pass", "end"), 0.0, room),
        (Moment(BEATER, "beat 1", "start"), Moment(SHUTTLE, "pass", "end"), GAP, clear),
        (Moment(SHUTTLE, "pass back", "start"), Moment(BEATER, "back 1", "end"), GAP, clear),
        (Moment(SHUTTLE, "pass back", "start"), Moment(ODD, "room for the shuttle", "event"), 0.0, room),
        (Moment(ODD, "room ends", "event"), Moment(SHUTTLE, "pass back", "end"), 0.0, room),
        (Moment(BEATER, "beat 2", "start"), Moment(SHUTTLE, "pass back", "end"), GAP, clear),
        (Moment(ODD, "lift", "start"), Moment(EVEN, "lower", "end"), 0.0, SOURCE),
        (Moment(TAKE_UP, "take up", "start"), Moment(BEATER, "back 2", "end"), 0.0, "the beater is off the fell"),
    )
    return tuple(Relation(then, first, gap, why) for then, first, gap, why in order)


def _law(name: str) -> MotionLaw:
    return LAWS[name]


def _warps(name: str, timing: RowTiming, shift: float) -> Track:
    law, quarter = _law(timing.law), turn / 4
    parts = (
        TrackSegment("lift", shift, shift + quarter, 0.0, timing.lift, law),
        TrackSegment("lower", shift + quarter, shift + _HALF, timing.lift, 0.0, law),
    )
    first, last = timing.window
    events = (TrackEvent("room for the shuttle", shift + first), TrackEvent("room ends", shift + last))
    return Track(name, "shedding cams", parts, events)


def _shuttle(timing: RowTiming) -> Track:
    first, last = timing.window
    law, stroke = _law("cycloidal"), timing.shuttle_stroke
    parts = (
        TrackSegment("pass", first, last, 0.0, stroke, law),
        TrackSegment("pass back", _HALF + first, _HALF + last, stroke, 0.0, law),
    )
    events = (riding("straight weft laid", parts[0]), riding("sinuous weft laid", parts[1]))
    return Track(SHUTTLE, "linear axis", parts, events)


def _beater(timing: RowTiming, period: float) -> Track:
    """Two beats, each forward, pressed where it is, and back."""
    beat, spent = timing.beat, turn * timing.beat.time / period
    parts: list[TrackSegment] = []
    for number, end in ((1, timing.beat_end), (2, _HALF + timing.beat_end)):
        start = end - spent
        middle = start + beat.forward * spent
        parts += [
            TrackSegment(f"beat {number}", start, middle, 0.0, beat.stroke, beat.law),
            TrackSegment(f"back {number}", middle + beat.pressed * spent, end, beat.stroke, 0.0, beat.back_law),
        ]
    events = (TrackEvent("beat", parts[0].end), TrackEvent("beat", parts[2].end))
    return Track(BEATER, beat.actuator, tuple(parts), events)


def _take_up(timing: RowTiming) -> Track:
    start = _HALF + timing.beat_end
    part = TrackSegment("take up", start, _HALF + timing.take_up_end, 0.0, timing.row_pitch, TAKE_UP_LAW)
    return Track(TAKE_UP, "warp cylinder", (part,), revolves=timing.row_pitch)


def _heads(timing: RowTiming) -> Track:
    """The heads' rail: away from the warps while the shed opens, and back behind the second beat."""
    law = _law("cycloidal")
    parts = (
        TrackSegment("retreat", 0.0, RETREAT_END, 0.0, timing.retreat, law),
        TrackSegment("return", _HALF + timing.beat_end, turn, timing.retreat, 0.0, law),
    )
    return Track(HEADS, "linear axes", parts)


def shortest_retreat(timing: RowTiming, speed_limit: float, acceleration_limit: float) -> float:
    """The shortest turn of the cams [s] in which the heads' rail keeps its limits."""
    return shortest_period(_heads(timing), speed_limit, acceleration_limit)


def take_up_time(timing: RowTiming, period: float) -> float:
    """Time of the take-up [s] at a period of the cams [s]."""
    return (timing.take_up_end - timing.beat_end) / turn * period
