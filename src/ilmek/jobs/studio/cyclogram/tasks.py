"""A cyclogram under the user's hands: curves, relations and exclusions while it is dragged; its solution as work."""

import math
from dataclasses import dataclass, field

import numpy as np

from ilmek.cams.laws import FAMILIES
from ilmek.io.cyclogram_file import cyclogram_data, cyclogram_of_data, cyclogram_toml, timed_data
from ilmek.jobs.cyclogram import binding_cost, cyclograms_of, limit_checks, solve, timed
from ilmek.jobs.studio.answers import Binary, Context, packed
from ilmek.jobs.studio.checks import shown_check
from ilmek.jobs.studio.cyclogram.answers import (
    CyclogramSolution,
    CyclogramView,
    MachineCyclograms,
    NamedCyclogram,
    ShownBinding,
    ShownExclusion,
    ShownMoment,
    ShownMotionPart,
    ShownPresence,
    ShownRelation,
    ShownTrack,
)
from ilmek.jobs.studio.words import in_page
from ilmek.params import Setting
from ilmek.records import JsonObject, alike
from ilmek.timing.cyclogram import (
    Cyclogram,
    Exclusion,
    Moment,
    Relation,
    Track,
    TrackSegment,
    check_all,
    check_apart,
    moment_angle,
    present,
)
from ilmek.timing.figures import law_label
from ilmek.timing.relations import Presence, Spans
from ilmek.timing.track import TrackCurves, curves, peak_acceleration, peak_jerk, peak_speed
from ilmek.timing.windows import Windows, common
from ilmek.units import from_si, turn

STEPS = 720
"""Samples of a turn."""


@dataclass(frozen=True, eq=False, slots=True)
class CyclogramRequest:
    """A cyclogram as the plain data of its file."""

    data: JsonObject


@dataclass(frozen=True, eq=False, slots=True)
class SolveRequest:
    """A cyclogram as the plain data of its file, and its goal: acceleration or period."""

    data: JsonObject
    goal: str = "acceleration"


@dataclass(frozen=True, eq=False, slots=True)
class MachineCyclogramRequest:
    """A machine of the catalogue and its settings; "": which machines have cyclograms."""

    machine: str = ""
    settings: dict[str, Setting] = field(default_factory=dict)


def view(request: CyclogramRequest, context: Context) -> Binary:
    """A cyclogram as it is shown: see `CyclogramView`. Raises ParameterError with the key of what is wrong."""
    cyclogram = cyclogram_of_data(request.data)
    drawn = [(track, curves(track, STEPS)) for track in cyclogram.tracks]
    parts = [_packed(cyclogram, rows) for _, rows in drawn]
    relations = tuple(_relation(cyclogram, relation) for relation in cyclogram.relations)
    exclusions = tuple(_exclusion(cyclogram, exclusion) for exclusion in cyclogram.exclusions)
    about = CyclogramView(
        name=cyclogram.name,
        period=cyclogram.period,
        tracks=tuple(_track(cyclogram, track, rows) for track, rows in drawn),
        relations=relations,
        exclusions=exclusions,
        limits=tuple(map(shown_check, limit_checks(cyclogram))),
        laws=tuple(FAMILIES),
        lengths=tuple(len(part) for part in parts),
    )
    return packed(about, *parts)


def _packed(cyclogram: Cyclogram, rows: TrackCurves) -> bytes:
    """Angle, position, velocity, acceleration and jerk over time, as 32-bit floats."""
    w = cyclogram.speed
    quantities = (rows.angle, rows.position, rows.slope * w, rows.bend * w**2, rows.jolt * w**3)
    return np.stack(quantities).astype("<f4").tobytes()


def _track(cyclogram: Cyclogram, track: Track, rows: TrackCurves) -> ShownTrack:
    limits, period = track.limits, cyclogram.period
    return alike(
        ShownTrack,
        track,
        shown_unit=track.unit,
        factor=from_si(1.0, track.unit),
        limits={name: getattr(limits, name) for name in ("speed", "acceleration", "jerk")}
        | {"time": limits.time or None},
        motions=tuple(_part(cyclogram, part) for part in track.segments),
        peaks={
            "speed": peak_speed(track, period),
            "acceleration": peak_acceleration(track, period),
            "jerk": peak_jerk(track, period),
        },
        low=float(rows.position.min()),
        high=float(rows.position.max()),
        count=len(rows.angle),
    )


def _part(cyclogram: Cyclogram, part: TrackSegment) -> ShownMotionPart:
    rate, law = cyclogram.speed / part.beta, part.law
    peaks = (law.velocity_peak, law.acceleration_peak, law.jerk_peak)
    values = (abs(part.stroke) * peak * rate**order for order, peak in enumerate(peaks, 1))
    return ShownMotionPart(part.name, part.start, part.end, part.begin, part.finish, law.name, law_label(law), *values)


def _relation(cyclogram: Cyclogram, relation: Relation) -> ShownRelation:
    first, then = (_moment(cyclogram, moment) for moment in (relation.first, relation.then))
    gap = then.angle + turn * relation.turns - first.angle
    least = relation.gap + relation.delay * cyclogram.speed if relation.gap > -math.inf else None
    most = relation.most if relation.most < math.inf else None
    margins = [math.inf if least is None else gap - least, math.inf if most is None else most - gap]
    return ShownRelation(
        label=in_page(relation.label(cyclogram.units)),
        why=relation.why,
        first=first,
        then=then,
        turns=relation.turns,
        gap=gap,
        least=least,
        most=most,
        margin=min(margins),
        ok=all(check.ok for check in check_all(cyclogram, (relation,))),
    )


def _moment(cyclogram: Cyclogram, moment: Moment) -> ShownMoment:
    return ShownMoment(moment.track, moment_angle(cyclogram, moment), in_page(moment.label(cyclogram.units)))


def _exclusion(cyclogram: Cyclogram, exclusion: Exclusion) -> ShownExclusion:
    check = check_apart(cyclogram, exclusion)
    both = common(present(cyclogram, exclusion.first), present(cyclogram, exclusion.second))
    return ShownExclusion(
        label=in_page(exclusion.label(cyclogram.units)),
        why=exclusion.why,
        first=_presence(cyclogram, exclusion.first),
        second=_presence(cyclogram, exclusion.second),
        overlaps=_spans(both),
        apart=check.value,
        gap=check.limit,
        margin=check.value - check.limit,
        ok=check.ok,
    )


def _presence(cyclogram: Cyclogram, presence: Presence) -> ShownPresence:
    windows = _spans(present(cyclogram, presence))
    if isinstance(presence, Spans):
        return ShownPresence("", presence.name, windows)
    return ShownPresence(presence.track, in_page(presence.label(cyclogram.units)), windows, presence.low, presence.high)


def _spans(windows: Windows) -> list[list[float]]:
    return [[window.start, window.end] for window in windows]


def solved(request: SolveRequest, context: Context) -> CyclogramSolution:
    """A cyclogram solved for a goal: the data of its file with the new timing, and what binds.

    Raises ParameterError as `ilmek cyclogram --solve` does: it names relations that contradict each other; Cancelled.
    """
    solution = solve(cyclogram_of_data(request.data), request.goal, context.progress)
    return alike(
        CyclogramSolution,
        solution,
        data=timed_data(request.data, solution.cyclogram),
        shown_unit=solution.unit,
        factor=from_si(1.0, solution.unit),
        binding=tuple(
            ShownBinding(in_page(one.label), one.kind, binding_cost(one, solution), one.share, one.cost)
            for one in solution.binding
        ),
    )


def of_machine(request: MachineCyclogramRequest, context: Context) -> MachineCyclograms:
    """The cyclograms of a machine as files' data. Raises ParameterError for a machine without some; Cancelled."""
    if not request.machine:
        return MachineCyclograms(tuple(timed()))
    cyclograms = cyclograms_of(request.machine, request.settings, context.progress.part(0.0, 1.0, "design"))
    named = tuple(
        NamedCyclogram(cyclogram.name, cyclogram_data(cyclogram), cyclogram_toml(cyclogram)) for cyclogram in cyclograms
    )
    return MachineCyclograms(tuple(timed()), named)
