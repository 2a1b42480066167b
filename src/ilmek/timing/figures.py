"""Figures of cyclograms: tracks with their laws, presences that exclude each other, and relations."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.report import Axis, Lane, Link, Mark, Move, Shade, Timing
from ilmek.timing.cyclogram import Cyclogram, Exclusion, Moment, Relation, check_all, moment_angle, present
from ilmek.timing.relations import Presence, Zone
from ilmek.timing.track import MotionLaw, Track, TrackSegment, joints, laid, sample
from ilmek.timing.windows import Windows, common
from ilmek.units import deg, format_number, turn

MASTER = Axis("master angle", "deg")


def draw(cyclogram: Cyclogram, title: str, note: str = "", step: float = 1 * deg, drive: Axis = MASTER) -> Timing:
    """The figure of a cyclogram: each track over its stroke, sampled every `step` [rad] and at every joint.

    drive  name of the angle, shared with other figures over it
    """
    lanes = tuple(_lane(cyclogram, track, step) for track in cyclogram.tracks)
    return Timing(cyclogram.name, title, cyclogram.period, lanes, note, tuple(_links(cyclogram)), drive)


def law_label(law: MotionLaw) -> str:
    """The law's name with its scalar parameters."""
    plain = [format_number(value) for value in law.parameters.values() if isinstance(value, float) and value]
    return f"{law.name} ({', '.join(plain)})" if plain else law.name


def _lane(cyclogram: Cyclogram, track: Track, step: float) -> Lane:
    angle = np.unique(np.concatenate([np.linspace(0, turn, round(turn / step) + 1), joints(track)]))
    drawn = sample(track, angle)
    position, speed = drawn.position, turn / cyclogram.period
    motion = position, speed * drawn.slope, speed**2 * drawn.bend
    share = (position - position.min()) / (np.ptp(position) or 1.0)
    events = tuple(Mark(event.angle, event.name) for event in track.events)
    moves = tuple(_move(part) for part in laid(track))
    shades = tuple(dict.fromkeys(_shades(cyclogram, track.name)))
    return Lane(track.name, track.actuator, angle, share, events, moves, track.unit, shades, motion)


def _move(part: TrackSegment) -> Move:
    return Move(part.name, part.start, part.end, part.begin, part.finish, law_label(part.law))


def _shades(cyclogram: Cyclogram, name: str) -> Iterator[Shade]:
    """The stays of a track in zones of exclusions; bad: where both presences overlap."""
    for exclusion in cyclogram.exclusions:
        for own, other in _sides(exclusion):
            if isinstance(own, Zone) and own.track == name:
                here = present(cyclogram, own)
                label = own.name or own.label(cyclogram.units).removeprefix(f"{name} ")
                yield from _shaded(here, label, bad=False)
                yield from _shaded(common(here, present(cyclogram, other)), label, bad=True)


def _sides(exclusion: Exclusion) -> Sequence[tuple[Presence, Presence]]:
    return ((exclusion.first, exclusion.second), (exclusion.second, exclusion.first))


def _shaded(windows: Windows, label: str, *, bad: bool) -> Iterator[Shade]:
    return (Shade(window.start, window.end, label, bad) for window in windows)


def _links(cyclogram: Cyclogram) -> Iterator[Link]:
    """Relations between two tracks within the turn."""
    numbers = {track.name: number for number, track in enumerate(cyclogram.tracks)}
    for relation in cyclogram.relations:
        if _drawable(relation):
            ends = [_end(cyclogram, numbers, moment) for moment in (relation.first, relation.then)]
            ok = all(check.ok for check in check_all(cyclogram, (relation,)))
            gap = relation.gap if relation.gap > -math.inf else relation.most
            yield Link(ends[0], ends[1], f"{format_number(gap / deg)}°", ok)


def _drawable(relation: Relation) -> bool:
    return relation.turns == 0 and "angle" not in (relation.then.edge, relation.first.edge)


def _end(cyclogram: Cyclogram, numbers: dict[str, int], moment: Moment) -> tuple[int, float]:
    return numbers[moment.track], moment_angle(cyclogram, moment)
