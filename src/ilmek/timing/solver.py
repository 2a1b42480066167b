"""Optimal timing of a cyclogram: least peak acceleration, or shortest period, within all relations.

The peak acceleration of a motion is |h| Ca (w/beta)^2, so a bound on it is a lower bound of its angle beta. With the
rows of `constraints` both tasks are linear programmes, so the solution is a global optimum; the multipliers prove it
and show which rows bind. Where two presences overlap at the start, both orders are tried. Every other order is kept.

After the largest acceleration is minimised, the motions that determine it are fixed and the largest of the others is
minimised, and so on: no motion is faster than necessary.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.timing.constraints import Constraint, Form, Unknowns, exclusion_rows, standing_rows, unknowns
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, TrackSegment, peak_acceleration
from ilmek.units import format_quantity, parse_unit, turn

ORDERS = 4096
"""Largest number of orders of overlapping presences that are tried."""

_BINDS, _ACTIVE = 1e-7, 1e-7

_EASED = 1 + 1e-12
"""By which the shortest period is lengthened, so that motions at their limits have room for rounding."""


@dataclass(frozen=True, slots=True)
class Binding:
    """A binding row: it limits the solution.

    label   in words          kind   relation, exclusion, order, turn, limit or motion
    share   of a motion in the critical path [-], their sum is 1; NaN for other rows
    cost    relative growth of the objective per radian added to the row [1/rad]
    """

    label: str
    kind: str
    share: float
    cost: float


@dataclass(frozen=True, slots=True)
class Solution:
    """An optimised cyclogram.

    goal           acceleration or period
    before, after  the objective: the period [s], or the largest acceleration over its weight
    measure, unit  description of the objective, and its display unit
    binding        the binding rows, in the order of the turn
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


def least_acceleration(cyclogram: Cyclogram, progress: Progress = SILENT) -> Solution:
    """The cyclogram with the least peak acceleration at its period, within all limits.

    Accelerations are divided by the tracks' limits; for a track without a limit, by its present peak. They are not
    weighted where no track has a limit and all have one dimension.
    Raises ParameterError where no motion is free, and for contradicting relations, which it names; Cancelled.
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
    _, rows, answer = _best(known, rows, motions, progress)
    answer = _even(known, rows, motions, answer)
    solved = _placed(known, answer.x, cyclogram.period)
    before, after = (_level(one, weights) for one in (cyclogram, solved))
    binding = _binding([*rows, *motions], answer, power=2)
    return Solution(solved, "acceleration", before, after, measure, unit, binding)


def least_period(cyclogram: Cyclogram, progress: Progress = SILENT) -> Solution:
    """The cyclogram with the shortest period within the tracks' limits, then with the least accelerations.

    Raises ParameterError for a moving track without a limit, where no motion is free, and for contradicting relations,
    which it names; Cancelled.
    """
    known, rows, motions, answer = _quickest(cyclogram, progress)
    binding = _binding([*rows, *motions], answer, power=1)
    period = turn / float(answer.x[0])
    quick = _placed(known, answer.x, period)
    eased = least_acceleration(replace(quick, period=period * _EASED)).cyclogram
    return Solution(eased, "period", cyclogram.period, eased.period, "period", "s", binding)


def period_needed(cyclogram: Cyclogram) -> float:
    """The shortest period within the tracks' limits [s], that of `least_period`, whose errors it raises."""
    return turn / float(_quickest(cyclogram)[-1].x[0]) * _EASED


def _quickest(
    cyclogram: Cyclogram, progress: Progress = SILENT
) -> tuple[Unknowns, list[Constraint], list[Constraint], _Answer]:
    """The unknowns, the rows, the motions' rows, and the solution with the shortest period."""
    known = unknowns(cyclogram)
    _moving(cyclogram)
    free = [track.name for track in cyclogram.tracks if track.segments and not track.locked and not _is_limited(track)]
    if free:
        raise ParameterError(
            f"no limit is given for {', '.join(free)}, so the period has no lower bound",
            allowed="a limit of speed, acceleration, jerk or time for every track that moves",
            do="give a limit, or lock the track",
        )
    motions = [
        _stretch(known, track, part, value, what)
        for track in cyclogram.tracks
        for part in track.segments
        for what, value in _limited(track, part)
    ]
    _, rows, answer = _best(known, standing_rows(known, period_free=True), motions, progress)
    return known, rows, motions, answer


def require_possible(cyclogram: Cyclogram) -> None:
    """Raise ParameterError where relations and exclusions contradict each other for any timing; it names them."""
    known = unknowns(cyclogram)
    if len(known.index):
        rows = standing_rows(known, period_free=False)
        motions = [_stretch(known, track, part, 1.0) for track, part in _moving(cyclogram)]
        _best(known, rows, motions)


def _moving(cyclogram: Cyclogram) -> list[tuple[Track, TrackSegment]]:
    """The motions that are free. Raises ParameterError where there are none."""
    found = [(track, part) for track in cyclogram.tracks if not track.locked for part in track.segments if part.stroke]
    if not found:
        raise ParameterError(f"{cyclogram.name}: no motion is free", do="give a track motions, or unlock a track")
    return found


def _stretch(known: Unknowns, track: Track, part: TrackSegment, rate: float, limit: str = "") -> Constraint:
    """The row beta >= rate * r of a motion, and the limit that causes it."""
    label = f"{track.name}: {part.name}{f' at its limit of {limit}' if limit else ''}"
    return Constraint(known.beta(track, part) - known.growth(rate), label, "motion")


def _bound(known: Unknowns, track: Track, part: TrackSegment, limit: str, beta: float) -> Constraint:
    """The row of the least angle of a motion by a limit at the given period."""
    label = f"{track.name}: {part.name} at its limit of {limit}"
    return Constraint(known.beta(track, part).shifted(-beta), label, "limit")


def _peak(track: Track, part: TrackSegment) -> float:
    if not math.isfinite(part.law.acceleration_peak):
        raise ParameterError(
            f"{track.name}: {part.name} moves by the law {part.law.name}, whose acceleration is infinite",
            do="use another law, or lock the track",
        )
    return part.law.acceleration_peak


def _limited(track: Track, part: TrackSegment) -> Iterator[tuple[str, float]]:
    """Each limit of a motion, and the least time by it [s]."""
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
                do="use another law, raise the limit, or omit it",
            )
        if time > 0:
            yield what, time


def _is_limited(track: Track) -> bool:
    limits = track.limits
    return min(limits.speed, limits.acceleration, limits.jerk) < math.inf or limits.time > 0


def _weights(cyclogram: Cyclogram) -> tuple[dict[str, float], str, str]:
    """Weights of the tracks' accelerations, description of the quotient, and its unit."""
    tracks = [track for track in cyclogram.tracks if not track.locked and any(part.stroke for part in track.segments)]
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
    known: Unknowns, rows: list[Constraint], motions: list[Constraint], progress: Progress = SILENT
) -> tuple[float, list[Constraint], _Answer]:
    """The largest r over all orders of overlapping presences, with the rows of that order and the solution."""
    alternatives = [one for exclusion in known.cyclogram.exclusions for one in exclusion_rows(known, exclusion)]
    orders = math.prod(map(len, alternatives))
    if orders > ORDERS:
        raise ParameterError(
            f"{sum(len(choice) > 1 for choice in alternatives)} pairs of presences overlap: too many orders to try",
            do="arrange the motions roughly in the required order",
        )
    best: tuple[float, list[Constraint], _Answer] | None = None
    for number, chosen in enumerate(itertools.product(*alternatives)):
        progress(number / orders)
        all_rows = [*rows, *(row for one in chosen for row in one)]
        answer = _maximum([*all_rows, *motions])
        if answer is not None and (best is None or answer.x[0] > best[0]):
            best = (float(answer.x[0]), all_rows, answer)
    if best is None or best[0] < 1e-9:
        _blame([*rows, *(row for alternative in alternatives for row in alternative[0]), *motions], known)
    assert best is not None
    return best


def _maximum(rows: Sequence[Constraint]) -> _Answer | None:
    """The largest r within rows; None where they are infeasible."""
    weights = np.array([row.form.weights for row in rows])
    least = -np.array([row.form.constant for row in rows])
    goal = -np.eye(1, weights.shape[1])[0]
    bounds = [(0.0, None), *[(None, None)] * (weights.shape[1] - 1)]
    found = scipy.optimize.linprog(goal, A_ub=-weights, b_ub=-least, bounds=bounds, method="highs-ds")
    if found.status == 3:
        raise ParameterError("no row limits the cyclogram", do="give limits, or relations")
    if found.status != 0:
        return None
    return _Answer(np.asarray(found.x), -np.asarray(found.ineqlin.marginals))


def _even(known: Unknowns, rows: list[Constraint], motions: list[Constraint], first: _Answer) -> _Answer:
    """The solution in which the accelerations of the non-binding motions are minimised too, the largest first."""
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
    """The row of a motion with r fixed to this value."""
    rate = row.form.weights[0]
    return Constraint(
        Form(row.form.weights - known.growth(rate).weights, row.form.constant + rate * r), row.label, row.kind
    )


def _polished(rows: Sequence[Constraint], x: FloatArray) -> FloatArray:
    """The solution corrected so that its active rows hold to rounding."""
    weights = np.array([row.form.weights for row in rows])
    left = weights @ x + np.array([row.form.constant for row in rows])
    tight = np.abs(left) < _ACTIVE
    step = np.linalg.lstsq(weights[tight], -left[tight], rcond=None)[0]
    return np.asarray(x + step)


def _placed(known: Unknowns, x: FloatArray, period: float) -> Cyclogram:
    """The cyclogram with the motions and events of the solution."""

    def at(track: str, name: str, edge: str) -> float:
        value = float(x[known.index[track, name, edge]])
        return 0.0 if abs(value) < 1e-9 else turn if abs(value - turn) < 1e-9 else value

    tracks = []
    for track in known.cyclogram.tracks:
        if track.locked:
            tracks.append(track)
            continue
        parts = [
            replace(part, start=at(track.name, part.name, "start"), end=at(track.name, part.name, "end"))
            for part in track.segments
        ]
        # An end equal to the next start up to rounding is set to it.
        for first, then in itertools.pairwise(range(len(parts))):
            if abs(parts[first].end - parts[then].start) < 1e-9:
                parts[first] = replace(parts[first], end=parts[then].start)
        spans = {part.name: part for part in parts}
        events = []
        for event in track.events:
            if event.on:
                angle = spans[event.on].angle(event.share)
                events.append(replace(event, angle=angle % turn if spans[event.on].end > turn else angle))
            elif (track.name, event.name, "event") in known.index:
                events.append(replace(event, angle=at(track.name, event.name, "event")))
            else:
                events.append(event)
        tracks.append(replace(track, segments=tuple(parts), events=tuple(events)))
    return replace(known.cyclogram, period=period, tracks=tuple(tracks))


def _binding(rows: Sequence[Constraint], answer: _Answer, power: int) -> tuple[Binding, ...]:
    """The binding rows, in the order of the turn; the objective is proportional to r^-power."""
    r, found = answer.x[0], []
    for row, y in zip(rows, answer.multipliers, strict=True):
        if y > _BINDS * r:
            share = float(-y * row.form.weights[0]) if row.kind == "motion" else math.nan
            angles = answer.x[1:][row.form.weights[1:] != 0]
            found.append((float(angles.min(initial=turn)), Binding(row.label, row.kind, share, float(power * y / r))))
    return tuple(binding for _, binding in sorted(found, key=lambda one: one[0]))


def _blame(rows: Sequence[Constraint], known: Unknowns) -> None:
    """Raise ParameterError that names the contradicting rows: those with a multiplier when all rows are relaxed by the
    least common angle. If they are all gaps, they form a loop of positive length.
    """
    weights = np.array([[*row.form.weights, 1.0] for row in rows])
    least = -np.array([row.form.constant for row in rows])
    goal = np.eye(1, weights.shape[1], weights.shape[1] - 1)[0]
    bounds = [(1e-6, None), *[(None, None)] * (weights.shape[1] - 2), (0.0, None)]
    found = scipy.optimize.linprog(goal, A_ub=-weights, b_ub=-least, bounds=bounds, method="highs-ds")
    if found.status != 0:
        raise ParameterError(f"{known.cyclogram.name}: numbers of too different magnitude for the solver")
    y = -np.asarray(found.ineqlin.marginals)
    guilty = [row for row in np.argsort(-y, kind="stable") if y[row] > _BINDS]
    over = found.fun / max(float(y.max()), _BINDS)
    limited = any(rows[row].kind == "limit" for row in guilty)
    labels = list(dict.fromkeys(rows[row].label for row in guilty if rows[row].kind != "motion"))
    raise ParameterError(
        f"{known.cyclogram.name}: a relation loop in the cyclogram cannot hold: {'; '.join(labels)}",
        allowed=f"together they require {format_quantity(over, 'deg')} more than available"
        if over > 1e-5
        else "together they leave no angle for the motions",
        do="relax one of them, or give a longer period" if limited else "relax one of them",
    )
