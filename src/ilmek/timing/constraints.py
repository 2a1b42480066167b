"""Unknowns and constraints of a cyclogram's solver, as rows of a linear programme.

The unknowns are the starts and ends of all motions of tracks that are not locked, the events of relations that belong
to
no motion, and one number r to be maximised. Every row states form >= 0. It is a relation, an exclusion (the instant at
which a motion passes a position is linear in its start and end), the order of a track, a limit, or the least master
angle of a motion, proportional to r:

    at a given period      beta >= r w sqrt(|h| Ca / weight)       r = 1/sqrt(largest acceleration over its weight)
    for the least period   beta >= r |h| Cv / V,  r sqrt(|h| Ca / A),  r cbrt(|h| Cj / J),  r t          r = w
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.records import record
from ilmek.timing.crossings import TrackInstant, passages, passing_share
from ilmek.timing.cyclogram import Cyclogram, Exclusion, Moment, Relation, Spans, Track, moment_angle
from ilmek.timing.relations import Presence
from ilmek.timing.track import TrackSegment
from ilmek.units import turn


@dataclass(frozen=True, slots=True, eq=False)
class Form:
    """A linear function of the unknowns: constant + weights . x; r is the first unknown."""

    weights: FloatArray
    constant: float = 0.0

    def __add__(self, other: "Form") -> "Form":
        return Form(self.weights + other.weights, self.constant + other.constant)

    def __sub__(self, other: "Form") -> "Form":
        return Form(self.weights - other.weights, self.constant - other.constant)

    def shifted(self, by: float) -> "Form":
        """The form plus a constant."""
        return Form(self.weights, self.constant + by)

    def scaled(self, by: float) -> "Form":
        """The form times a constant."""
        return Form(by * self.weights, by * self.constant)


@dataclass(frozen=True, slots=True, eq=False)
class Constraint:
    """form >= 0, its label, and its kind: relation, exclusion, order, turn, limit or motion."""

    form: Form
    label: str
    kind: str


@record
class Unknowns:
    """Indices of the unknowns, and the forms of all instants [rad].

    index   (track, motion, edge) -> index; edge is start, end or event
    """

    cyclogram: Cyclogram
    index: Mapping[tuple[str, str, str], int] = field(repr=False)

    @property
    def size(self) -> int:
        """Number of unknowns, r included."""
        return 1 + len(self.index)

    @property
    def current(self) -> FloatArray:
        """Their present values [rad], (unknowns,); r is 0."""
        found = (moment_angle(self.cyclogram, Moment(*key)) for key in self.index)
        return np.array([0.0, *found])

    def constant(self, value: float) -> Form:
        """The constant form of a value."""
        return Form(np.zeros(self.size), value)

    def growth(self, rate: float) -> Form:
        """The form rate * r."""
        return Form(np.eye(1, self.size)[0] * rate)

    def moment(self, moment: Moment) -> Form:
        """The form of an instant."""
        key = (moment.track, moment.motion, moment.edge)
        if key in self.index:
            return Form(np.eye(self.size)[self.index[key]])
        if moment.edge in ("past", "event") and not self.cyclogram.track(moment.track).locked:
            track = self.cyclogram.track(moment.track)
            if moment.edge == "past":
                segment = track.segment(moment.motion)
                return self.share(track, segment, passing_share(track.name, segment, moment.at, track.unit))
            event = track.event(moment.motion)
            if event.on:
                return self.share(track, track.segment(event.on), event.share)
        return self.constant(moment_angle(self.cyclogram, moment))

    def share(self, track: Track, segment: TrackSegment, u: float) -> Form:
        """The instant at a share u [-] of a motion's time."""
        start = self.moment(Moment(track.name, segment.name, "start"))
        return start + self.beta(track, segment).scaled(u)

    def beta(self, track: Track, segment: TrackSegment) -> Form:
        """The master angle of a motion."""
        start, end = (self.moment(Moment(track.name, segment.name, edge)) for edge in ("start", "end"))
        return end - start

    def at(self, track: Track, instant: TrackInstant) -> Form:
        """The form of an instant on a track's motions."""
        return self.share(track, track.segments[instant.motion], instant.share).shifted(turn * instant.turns)


def unknowns(cyclogram: Cyclogram) -> Unknowns:
    """The unknowns of a cyclogram."""
    keys = [
        (track.name, segment.name, edge)
        for track in cyclogram.tracks
        if not track.locked
        for segment in track.segments
        for edge in ("start", "end")
    ]
    moments = [moment for relation in cyclogram.relations for moment in (relation.then, relation.first)]
    keys += [
        (moment.track, moment.motion, "event")
        for moment in moments
        if moment.edge == "event" and _stands_alone(cyclogram.track(moment.track), moment.motion)
    ]
    return Unknowns(cyclogram, {key: number for number, key in enumerate(dict.fromkeys(keys), 1)})


def _stands_alone(track: Track, event: str) -> bool:
    return not track.locked and not track.event(event).on


def standing_rows(known: Unknowns, *, period_free: bool) -> list[Constraint]:
    """Rows of all relations, and of the order of each track in the turn.

    period_free  the period is unknown: r is the speed of the master shaft [rad/s]
    """
    rows = [row for relation in known.cyclogram.relations for row in _relation(known, relation, period_free)]
    rows += [row for track in known.cyclogram.tracks if not track.locked for row in _order(known, track)]
    events = [key for key in known.index if key[2] == "event"]
    for key in events:
        at, label = known.moment(Moment(*key)), f"{key[0]}: {key[1]} within the turn"
        rows += [Constraint(at, label, "turn"), Constraint(known.constant(turn) - at, label, "turn")]
    return rows


def _relation(known: Unknowns, relation: Relation, period_free: bool) -> Iterator[Constraint]:
    units = known.cyclogram.units
    gap = (known.moment(relation.then) - known.moment(relation.first)).shifted(turn * relation.turns)
    delay = relation.delay
    late = known.growth(delay) if period_free else known.constant(delay * known.cyclogram.speed)
    label = relation.label(units)
    if relation.gap > -math.inf:
        yield Constraint((gap - late).shifted(-relation.gap), label, "relation")
    if relation.most < math.inf:
        yield Constraint(known.constant(relation.most) - gap, f"{label}, at most", "relation")


def _order(known: Unknowns, track: Track) -> Iterator[Constraint]:
    """Motions one after the other, within the turn unless the track runs through its end now."""
    if not track.segments:
        return
    starts = [known.share(track, part, 0.0) for part in track.segments]
    ends = [known.share(track, part, 1.0) for part in track.segments]
    for part, start, end in zip(track.segments, starts, ends, strict=True):
        yield Constraint(end - start, f"{track.name}: {part.name} ends after it starts", "order")
        if part.stroke == 0:
            kept = f"{track.name}: {part.name} keeps its angle"
            yield Constraint((end - start).shifted(-part.beta), kept, "order")
    pairs = zip(track.segments, track.segments[1:], ends, starts[1:], strict=False)
    for first, then, end, start in pairs:
        yield Constraint(start - end, f"{track.name}: {then.name} starts after {first.name} ends", "order")
    yield Constraint(starts[0], f"{track.name}: {track.segments[0].name} starts within the turn", "turn")
    last, through = track.segments[-1], track.segments[-1].end > turn + 1e-9
    limit = starts[0].shifted(turn) if through else known.constant(turn)
    yield Constraint(limit - ends[-1], f"{track.name}: {last.name} ends within the turn", "turn")
    if through:
        yield Constraint(
            known.constant(turn - 1e-6) - starts[-1], f"{track.name}: {last.name} starts within the turn", "turn"
        )


def exclusion_rows(known: Unknowns, exclusion: Exclusion) -> Iterator[tuple[tuple[Constraint, ...], ...]]:
    """Rows that keep two stays apart, for every pair of stays: the present order, or both orders where they overlap."""
    for a in _stays(known, exclusion.first):
        for b in _stays(known, exclusion.second):
            yield _alternatives(known, exclusion, a, b)


def _alternatives(
    known: Unknowns, exclusion: Exclusion, a: tuple[Form, Form], b: tuple[Form, Form]
) -> tuple[tuple[Constraint, ...], ...]:
    x, label = known.current, exclusion.label(known.cyclogram.units)
    now = [float(form.weights @ x) + form.constant for form in (*a, *b)]
    after = -math.floor((now[2] - now[0]) / turn)
    alternatives = []
    for shift in (after, after - 1):
        gaps = (b[0] - a[1]).shifted(turn * shift), (a[0] - b[1]).shifted(turn * (1 - shift))
        alternatives.append(tuple(Constraint(gap.shifted(-exclusion.gap), label, "exclusion") for gap in gaps))
        if shift == after and min(float(gap.weights @ x) + gap.constant for gap in gaps) >= 0:
            break
    return tuple(alternatives)


def _stays(known: Unknowns, presence: Presence) -> list[tuple[Form, Form]]:
    """Entry and exit of every stay of a presence; a whole turn where it never leaves."""
    if isinstance(presence, Spans):
        return [(known.constant(window.start), known.constant(window.end)) for window in presence.windows]
    track = known.cyclogram.track(presence.track)
    stays = passages(track, presence.low, presence.high)
    if stays is None:
        return [(known.constant(0.0), known.constant(turn))]
    return [(known.at(track, stay.entry), known.at(track, stay.exit)) for stay in stays]
