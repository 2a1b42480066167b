"""Motions stretched and overlapped as far as the relations let them: least acceleration, or the shortest turn.

The peak acceleration of a motion is |h| Ca (w/beta)^2, so that a bound on it is a least angle beta; with the rows of
`constraints` both tasks are linear programmes, and their answer is the best there is, not a good one. It is proved by
the multipliers: they say what binds, and by how much. Where two presences overlap at the start, both orders are tried;
any other order of the process is kept.

After the largest acceleration is least, the motions that settle it are kept and the largest of the others is made
least, and so on: no motion is quicker than it needs to be.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.timing.constraints import Constraint, Form, Unknowns, exclusion_rows, standing_rows, unknowns
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, TrackSegment, peak_acceleration
from ilmek.units import format_quantity, parse_unit, turn

ORDERS = 4096
"""Orders of overlapping presences that are tried, at most."""

_BINDS, _ACTIVE = 1e-7, 1e-7


@dataclass(frozen=True, slots=True)
class Binding:
    """What keeps the answer from being better.

    said    in words          kind   relation, exclusion, order, turn, limit or motion
    share   of a motion in the critical path, all of them together 1; nan of all else
    cost    relative growth of the answer for each radian that the row asks more [1/rad]
    """

    said: str
    kind: str
    share: float
    cost: float


@dataclass(frozen=True, slots=True)
class Solution:
    """A cyclogram solved.

    goal           acceleration or period
    before, after  the number made small: the period [s], or the largest acceleration over its weight
    measure        what the number is, in words, and the unit to show it in
    binding        what binds, in the order of the turn
    """

    cyclogram: Cyclogram
    goal: str
    before: float
    after: float
    measure: str
    unit: str
    binding: tuple[Binding, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Answer:
    x: FloatArray
    multipliers: FloatArray


def least_acceleration(cyclogram: Cyclogram) -> Solution:
    """The motions placed so that the largest acceleration is least at the cyclogram's period, within all limits.

    Accelerations are weighed by the tracks' limits; a track without one, by its largest acceleration now. Where no
    track has a limit and all move in one dimension they are not weighed.
    Raises ParameterError where nothing may move, and, naming them, for relations that cannot hold together.
    """
    known = unknowns(cyclogram)
    weights, measure, unit = _weights(cyclogram)
    parts = _moving(cyclogram)
    w = cyclogram.speed
    bounds = [
        _bound(known, track, part, what, w * value) for track, part in parts for what, value in _limited(track, part)
    ]
    motions = [
        _stretch(known, track, part, w * math.sqrt(abs(part.stroke) * _peak(track, part) / weights[track.name]))
        for track, part in parts
    ]
    rows = [*standing_rows(known, period_free=False), *bounds]
    _, rows, answer = _best(known, rows, motions)
    answer = _even(known, rows, motions, answer)
    solved = _placed(known, answer.x, cyclogram.period)
    before, after = (_level(one, weights) for one in (cyclogram, solved))
    binding = _binding([*rows, *motions], answer, power=2)
    return Solution(solved, "acceleration", before, after, measure, unit, binding)


def least_period(cyclogram: Cyclogram) -> Solution:
    """The motions placed so that the turn is shortest within the tracks' limits; then with least accelerations.

    Raises ParameterError for a moving track without a limit, where nothing may move, and, naming them, for relations
    that cannot hold together.
    """
    known = unknowns(cyclogram)
    _moving(cyclogram)
    free = [track.name for track in cyclogram.tracks if track.segments and not track.held and not _is_limited(track)]
    if free:
        raise ParameterError(
            f"no limit of {', '.join(free)} is known, so that no turn is too short for it",
            allowed="a limit of speed, acceleration, jerk or time for every track that moves",
            do="give one, or hold the track",
        )
    motions = [
        _stretch(known, track, part, value, what)
        for track in cyclogram.tracks
        for part in track.segments
        for what, value in _limited(track, part)
    ]
    _, rows, answer = _best(known, standing_rows(known, period_free=True), motions)
    binding = _binding([*rows, *motions], answer, power=1)
    period = turn / float(answer.x[0])
    quick = _placed(known, answer.x, period)
    eased = least_acceleration(replace(quick, period=period * (1 + 1e-12))).cyclogram
    return Solution(eased, "period", cyclogram.period, eased.period, "period", "s", binding)


def require_possible(cyclogram: Cyclogram) -> None:
    """Raise ParameterError, naming them, where relations and exclusions cannot hold together, wherever motions lie."""
    known = unknowns(cyclogram)
    if len(known.place):
        rows = standing_rows(known, period_free=False)
        motions = [_stretch(known, track, part, 1.0) for track, part in _moving(cyclogram)]
        _best(known, rows, motions)


def _moving(cyclogram: Cyclogram) -> list[tuple[Track, TrackSegment]]:
    """The motions that may be changed. Raises ParameterError where there are none."""
    found = [(track, part) for track in cyclogram.tracks if not track.held for part in track.segments if part.stroke]
    if not found:
        raise ParameterError(f"{cyclogram.name}: nothing may move", do="give a track motions, or hold less")
    return found


def _stretch(known: Unknowns, track: Track, part: TrackSegment, rate: float, limit: str = "") -> Constraint:
    """The row: a motion takes the angle rate r, at least; by which limit."""
    said = f"{track.name}: {part.name}{f' at its limit of {limit}' if limit else ''}"
    return Constraint(known.beta(track, part) - known.growth(rate), said, "motion")


def _bound(known: Unknowns, track: Track, part: TrackSegment, limit: str, beta: float) -> Constraint:
    """The row: a motion takes an angle, at least, by a limit at the period that is given."""
    said = f"{track.name}: {part.name} at its limit of {limit}"
    return Constraint(known.beta(track, part).shifted(-beta), said, "limit")


def _peak(track: Track, part: TrackSegment) -> float:
    if not math.isfinite(part.law.acceleration_peak):
        raise ParameterError(
            f"{track.name}: {part.name} moves by the law {part.law.name}, whose acceleration has no bound",
            do="take another law, or hold the track",
        )
    return part.law.acceleration_peak


def _limited(track: Track, part: TrackSegment) -> Iterator[tuple[str, float]]:
    """Each limit, and the least time by it that a motion takes [s]."""
    limits, law, h = track.limits, part.law, abs(part.stroke)
    times = {
        "speed": h * law.velocity_peak / limits.speed,
        "acceleration": math.sqrt(h * law.acceleration_peak / limits.acceleration)
        if limits.acceleration < math.inf
        else 0.0,
        "jerk": math.cbrt(h * law.jerk_peak / limits.jerk) if limits.jerk < math.inf else 0.0,
        "time": limits.time,
    }
    for what, time in times.items():
        if not math.isfinite(time):
            raise ParameterError(
                f"{track.name}: {part.name} never keeps its limit of {what} by the law {part.law.name}",
                do="take another law, raise the limit, or leave it out",
            )
        if time > 0:
            yield what, time


def _is_limited(track: Track) -> bool:
    limits = track.limits
    return min(limits.speed, limits.acceleration, limits.jerk) < math.inf or limits.time > 0


def _weights(cyclogram: Cyclogram) -> tuple[dict[str, float], str, str]:
    """What each track's acceleration is measured by; in words, and the unit of the quotient."""
    tracks = [track for track in cyclogram.tracks if not track.held and any(part.stroke for part in track.segments)]
    limits = {track.name: track.limits.acceleration for track in tracks}
    if not any(map(math.isfinite, limits.values())):
        if len({parse_unit(track.unit).dimension for track in tracks}) == 1:
            return dict.fromkeys(limits, 1.0), "largest acceleration", f"{tracks[0].unit}/s^2"
        now = {track.name: peak_acceleration(track, cyclogram.period) for track in tracks}
        return now, "largest acceleration over what it was", "1"
    now = {track.name: peak_acceleration(track, cyclogram.period) for track in tracks}
    weights = {name: limit if math.isfinite(limit) else now[name] for name, limit in limits.items()}
    return weights, "largest acceleration over its limit", "1"


def _level(cyclogram: Cyclogram, weights: dict[str, float]) -> float:
    """The largest acceleration over its weight."""
    return max(peak_acceleration(cyclogram.track(name), cyclogram.period) / by for name, by in weights.items())


def _best(
    known: Unknowns, rows: list[Constraint], motions: list[Constraint]
) -> tuple[float, list[Constraint], _Answer]:
    """The largest r over all orders of presences that overlap now; with the rows of that order, and its answer."""
    ways = [way for exclusion in known.cyclogram.exclusions for way in exclusion_rows(known, exclusion)]
    if math.prod(map(len, ways)) > ORDERS:
        raise ParameterError(
            f"{sum(len(way) > 1 for way in ways)} pairs of presences overlap, too many to try every order",
            do="place the motions roughly in the order that is wanted",
        )
    best: tuple[float, list[Constraint], _Answer] | None = None
    for chosen in itertools.product(*ways):
        all_rows = [*rows, *(row for one in chosen for row in one)]
        answer = _maximum([*all_rows, *motions])
        if answer is not None and (best is None or answer.x[0] > best[0]):
            best = (float(answer.x[0]), all_rows, answer)
    if best is None or best[0] < 1e-9:
        _blame([*rows, *(row for way in ways for row in way[0]), *motions], known)
    assert best is not None
    return best


def _maximum(rows: Sequence[Constraint]) -> _Answer | None:
    """The largest r within rows; None where nothing is within them."""
    weights = np.array([row.form.weights for row in rows])
    least = -np.array([row.form.constant for row in rows])
    goal = -np.eye(1, weights.shape[1])[0]
    bounds = [(0.0, None), *[(None, None)] * (weights.shape[1] - 1)]
    found = scipy.optimize.linprog(goal, A_ub=-weights, b_ub=-least, bounds=bounds, method="highs-ds")
    if found.status == 3:
        raise ParameterError("nothing binds the cyclogram", do="give limits, or relations")
    if found.status != 0:
        return None
    return _Answer(np.asarray(found.x), -np.asarray(found.ineqlin.marginals))


def _even(known: Unknowns, rows: list[Constraint], motions: list[Constraint], first: _Answer) -> _Answer:
    """The answer with the motions that do not settle r stretched too, the largest of the rest made least each time."""
    kept: list[Constraint] = []
    loose, answer = list(motions), first
    while loose:
        count = len(rows) + len(kept)
        binds = [bool(y > _BINDS) for y in answer.multipliers[count:]]
        r = answer.x[0] * (1 - 1e-11)
        kept += [_frozen(known, row, r) for row, tight in zip(loose, binds, strict=True) if tight]
        loose = [row for row, tight in zip(loose, binds, strict=True) if not tight]
        found = _maximum([*rows, *kept, *loose]) if loose and any(binds) else None
        if found is None:
            break
        answer = found
    return _Answer(_polished([*rows, *kept, *loose], answer.x), first.multipliers)


def _frozen(known: Unknowns, row: Constraint, r: float) -> Constraint:
    """The row of a motion at this r, whatever r becomes."""
    rate = row.form.weights[0]
    return Constraint(
        Form(row.form.weights - known.growth(rate).weights, row.form.constant + rate * r), row.said, row.kind
    )


def _polished(rows: Sequence[Constraint], x: FloatArray) -> FloatArray:
    """The answer moved so that the rows it stands at hold to rounding."""
    weights = np.array([row.form.weights for row in rows])
    left = weights @ x + np.array([row.form.constant for row in rows])
    tight = np.abs(left) < _ACTIVE
    step = np.linalg.lstsq(weights[tight], -left[tight], rcond=None)[0]
    return np.asarray(x + step)


def _placed(known: Unknowns, x: FloatArray, period: float) -> Cyclogram:
    """The cyclogram with its motions and events where the unknowns say."""

    def at(track: str, name: str, edge: str) -> float:
        value = float(x[known.place[track, name, edge]])
        return 0.0 if abs(value) < 1e-9 else turn if abs(value - turn) < 1e-9 else value

    tracks = []
    for track in known.cyclogram.tracks:
        if track.held:
            tracks.append(track)
            continue
        parts = [
            replace(part, start=at(track.name, part.name, "start"), end=at(track.name, part.name, "end"))
            for part in track.segments
        ]
        for first, then in itertools.pairwise(range(len(parts))):  # an end that is a start to rounding is that start
            if abs(parts[first].end - parts[then].start) < 1e-9:
                parts[first] = replace(parts[first], end=parts[then].start)
        spans = {part.name: part for part in parts}
        events = []
        for event in track.events:
            if event.on:
                angle = spans[event.on].angle(event.share)
                events.append(replace(event, angle=angle % turn if spans[event.on].end > turn else angle))
            elif (track.name, event.name, "event") in known.place:
                events.append(replace(event, angle=at(track.name, event.name, "event")))
            else:
                events.append(event)
        tracks.append(replace(track, segments=tuple(parts), events=tuple(events)))
    return replace(known.cyclogram, period=period, tracks=tuple(tracks))


def _binding(rows: Sequence[Constraint], answer: _Answer, power: int) -> tuple[Binding, ...]:
    """What binds, in the order of the turn; the answer goes with r to -power."""
    r, found = answer.x[0], []
    for row, y in zip(rows, answer.multipliers, strict=True):
        if y > _BINDS * r:
            share = float(-y * row.form.weights[0]) if row.kind == "motion" else math.nan
            places = answer.x[1:][row.form.weights[1:] != 0]
            found.append((float(places.min(initial=turn)), Binding(row.said, row.kind, share, float(power * y / r))))
    return tuple(binding for _, binding in sorted(found, key=lambda one: one[0]))


def _blame(rows: Sequence[Constraint], known: Unknowns) -> None:
    """Raise ParameterError that names the rows which cannot hold together: those with a multiplier when all are
    relaxed by the same angle, as little as it takes. Of gaps alone they are a loop of positive length.
    """
    weights = np.array([[*row.form.weights, 1.0] for row in rows])
    least = -np.array([row.form.constant for row in rows])
    goal = np.eye(1, weights.shape[1], weights.shape[1] - 1)[0]
    bounds = [(1e-6, None), *[(None, None)] * (weights.shape[1] - 2), (0.0, None)]
    found = scipy.optimize.linprog(goal, A_ub=-weights, b_ub=-least, bounds=bounds, method="highs-ds")
    if found.status != 0:
        raise ParameterError(f"{known.cyclogram.name}: its numbers are too far apart to be solved")
    y = -np.asarray(found.ineqlin.marginals)
    guilty = [place for place in np.argsort(-y, kind="stable") if y[place] > _BINDS]
    over = found.fun / max(float(y.max()), _BINDS)
    limited = any(rows[place].kind == "limit" for place in guilty)
    said = list(dict.fromkeys(rows[place].said for place in guilty if rows[place].kind != "motion"))
    raise ParameterError(
        f"{known.cyclogram.name}: a relation loop in the cyclogram cannot hold: {'; '.join(said)}",
        allowed=f"together they ask for {format_quantity(over, 'deg')} more than there is"
        if over > 1e-5
        else "together they leave no angle for the motions",
        do="loosen one of them, or give the turn more time" if limited else "loosen one of them",
    )
