"""The cyclogram: the tracks of all actuators over one master shaft, and the relations between them."""

import math
from collections.abc import Iterable

from ilmek.errors import ParameterError
from ilmek.records import value_record
from ilmek.report import Check, at_least, at_most
from ilmek.timing.crossings import passing_share, zone_windows
from ilmek.timing.relations import Exclusion, Moment, Presence, Relation, Spans, Zone, fixed
from ilmek.timing.track import ActuatorLimits, Track, TrackEvent, TrackSegment, riding
from ilmek.timing.windows import Windows, separation
from ilmek.units import turn

__all__ = [
    "ActuatorLimits",
    "Cyclogram",
    "Exclusion",
    "Moment",
    "Relation",
    "Spans",
    "Track",
    "TrackEvent",
    "TrackSegment",
    "Zone",
    "check_all",
    "check_apart",
    "check_cyclogram",
    "fixed",
    "moment_angle",
    "present",
    "riding",
]


@value_record
class Cyclogram:
    """Tracks over one turn of the master shaft, and the relations and exclusions between them.

    period  of the turn [s]
    Raises ParameterError for a period that is not positive, two tracks of one name, and a relation or an exclusion
    that refers to an unknown track, motion or event.
    """

    name: str
    period: float
    tracks: tuple[Track, ...]
    relations: tuple[Relation, ...] = ()
    exclusions: tuple[Exclusion, ...] = ()

    def __post_init__(self) -> None:
        if not 0 < self.period < math.inf:
            raise ParameterError(f"{self.name}: period {self.period:g} s", allowed="above 0 s")
        names = [track.name for track in self.tracks]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ParameterError(f"{self.name}: two tracks are named {twice!r}", do="give each its own name")
        for relation in self.relations:
            moment_angle(self, relation.then)
            moment_angle(self, relation.first)
        for exclusion in self.exclusions:
            present(self, exclusion.first)
            present(self, exclusion.second)

    def track(self, name: str) -> Track:
        """The track of that name. Raises ParameterError where there is none."""
        for track in self.tracks:
            if track.name == name:
                return track
        known = ", ".join(track.name for track in self.tracks)
        raise ParameterError(f"{self.name} has no track {name!r}", allowed=f"its tracks: {known}")

    @property
    def units(self) -> dict[str, str]:
        """Display unit of the positions of each track, by name."""
        return {track.name: track.unit for track in self.tracks}

    @property
    def speed(self) -> float:
        """Speed of the master shaft [rad/s]."""
        return turn / self.period


def moment_angle(cyclogram: Cyclogram, moment: Moment) -> float:
    """Master angle of a moment [rad]; above 2 pi on a motion that runs through the end of the turn.

    Raises ParameterError for an unknown track, motion, event or edge, and for a position that is never passed.
    """
    if moment.edge == "angle":
        return moment.at
    track = cyclogram.track(moment.track)
    if moment.edge in ("start", "end"):
        return track.segment(moment.motion).angle(float(moment.edge == "end"))
    if moment.edge == "past":
        segment = track.segment(moment.motion)
        return segment.angle(passing_share(track.name, segment, moment.at, track.unit))
    if moment.edge == "event":
        event = track.event(moment.motion)
        return track.segment(event.on).angle(event.share) if event.on else event.angle
    raise ParameterError(f"{track.name} has no {moment.edge} {moment.motion!r}", allowed="start, end, event or past")


def present(cyclogram: Cyclogram, presence: Presence) -> Windows:
    """Windows of the master angle [rad] of a presence. Raises ParameterError for an unknown track."""
    if isinstance(presence, Spans):
        return presence.windows
    return zone_windows(cyclogram.track(presence.track), presence.low, presence.high)


def check_all(cyclogram: Cyclogram, relations: Iterable[Relation]) -> tuple[Check, ...]:
    """The checks of relations, in order: the gap [rad] against its least, then against its greatest value."""
    return tuple(check for relation in relations for check in _checks(cyclogram, relation))


def check_apart(cyclogram: Cyclogram, exclusion: Exclusion) -> Check:
    """The check of an exclusion: the least angle [rad] between two presences (negative: overlap), against the gap."""
    apart = separation(present(cyclogram, exclusion.first), present(cyclogram, exclusion.second))
    return at_least(exclusion.label(cyclogram.units), round(apart, 9), round(exclusion.gap, 9), "deg", exclusion.why)


def check_cyclogram(cyclogram: Cyclogram) -> tuple[Check, ...]:
    """The checks of all relations and all exclusions of a cyclogram."""
    apart = (check_apart(cyclogram, exclusion) for exclusion in cyclogram.exclusions)
    return (*check_all(cyclogram, cyclogram.relations), *apart)


def _checks(cyclogram: Cyclogram, relation: Relation) -> Iterable[Check]:
    then, first = (moment_angle(cyclogram, moment) for moment in (relation.then, relation.first))
    gap = round(then + turn * relation.turns - first, 9)
    label = relation.label(cyclogram.units)
    if relation.gap > -math.inf:
        least = round(relation.gap + relation.delay * cyclogram.speed, 9)
        yield at_least(label, gap, least, "deg", relation.why)
    if relation.most < math.inf:
        yield at_most(f"{label}, at most", gap, round(relation.most, 9), "deg", relation.why)
