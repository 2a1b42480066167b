"""Cyclograms as TOML or JSON: tracks with their laws, relations, exclusions, limits.

    name = "press"
    period = "1s"

    [tracks.die]
    actuator = "cam 1"                          # unit = "mm"; optional: held, revolves, limits
    limits = { acceleration = "60m/s^2" }

    [tracks.die.motions]                        # a law with parameters: { name = "scca", ... }
    down = { start = "170deg", end = "215deg", from = "0mm", to = "100mm", law = "modified-sine" }

    [tracks.die.events]
    pressed = { on = "down", share = 1.0 }      # or passing = "30mm", or angle = "200deg"

    [[relations]]
    then = { track = "die", starts = "up" }     # ends, event, or past with at = "30mm"; or { angle = "90deg" }
    first = { track = "die", ends = "down" }
    gap = "10deg"                               # most, turns, delay, why

    [[exclusions]]
    first = { track = "die", above = "30mm" }   # below, name; or { name = "reed", windows = [["80deg", "120deg"]] }
    second = { track = "feeder", above = "50mm" }
    gap = "2deg"

Motions may stand in any order. Numbers are SI and radians; text has its unit. Written files are read again without
loss, every number to its last bit: an angle or a position is written in its unit if that gives the same number again,
else in SI.
"""

import copy
import itertools
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ilmek.cams.laws import LAWS
from ilmek.errors import MechanismError, ParameterError, restated
from ilmek.io.cyclogram_entries import CyclogramEntry
from ilmek.io.data_text import DataText, parse_data, read_data
from ilmek.io.output import write_file
from ilmek.io.schema import SourceText, Table
from ilmek.io.toml_text import toml_section, toml_text, written_quantity
from ilmek.records import JsonObject
from ilmek.report import Json
from ilmek.timing.crossings import passing_share
from ilmek.timing.cyclogram import (
    ActuatorLimits,
    Cyclogram,
    Exclusion,
    Moment,
    Relation,
    Spans,
    Track,
    TrackEvent,
    TrackSegment,
    Zone,
)
from ilmek.timing.relations import Presence
from ilmek.timing.track import MotionLaw, riding
from ilmek.timing.windows import windows_of
from ilmek.units import parse_unit

MOST_TRACKS, MOST_MOTIONS, MOST_EVENTS, MOST_RELATIONS = 50, 100, 200, 200
"""Largest numbers of tracks, of motions and events of all tracks, and of relations and of exclusions."""

MOST_PASSAGES = 300
"""Largest number of motions that the zones of all exclusions are compared with; each takes some milliseconds."""

LEAST = 1e-9
"""Least period [s], angle of a motion [rad] and limit of an actuator [SI]: divisions by them stay finite."""

_EDGES = {"starts": "start", "ends": "end", "event": "event", "past": "past"}
_LIMITS = {"speed": "/s", "acceleration": "/s^2", "jerk": "/s^3"}


def read_cyclogram(path: Path) -> Cyclogram:
    """The cyclogram of a .toml or .json file.

    Raises ParameterError with the file, the line and the key for any error in the file.
    """
    return _read(read_data(path, "cyclogram", ParameterError), str(path))


def parse_cyclogram(text: str, *, name: str = "cyclogram", toml: bool = True) -> Cyclogram:
    """The cyclogram of a TOML or JSON text; messages call it `name`. Raises as `read_cyclogram`."""
    return _read(parse_data(text, name=name, toml=toml, error=ParameterError), name)


def cyclogram_of_data(data: Mapping[str, object]) -> Cyclogram:
    """The cyclogram of the plain data of a file, as `tomllib` or `json` reads them.

    Raises ParameterError with the key.
    """
    return _read(DataText(data, {}, ""), "cyclogram")


def timed_data(data: Table, cyclogram: Cyclogram) -> JsonObject:
    """The data of a file with the timing of another cyclogram of the same tracks; all else is kept as it is written.

    Changed are the period, start and end of motions, and the angles of events that follow no motion; an angle of an
    event that follows one is left out.
    """
    timed = copy.deepcopy(dict(data))
    if cyclogram.period != cyclogram_of_data(data).period:
        timed["period"] = written_quantity(cyclogram.period, "s")
    for track in cyclogram.tracks:
        entry = timed["tracks"][track.name]
        for part in track.segments:
            angles = {"start": written_quantity(part.start, "deg"), "end": written_quantity(part.end, "deg")}
            entry["motions"][part.name] |= angles
        for event in track.events:
            given = entry["events"][event.name]
            if event.on:
                given.pop("angle", None)
            else:
                given["angle"] = written_quantity(event.angle, "deg")
    return timed


def _read(text: DataText, name: str) -> Cyclogram:
    with restated(ParameterError, of=MechanismError):
        return _cyclogram(CyclogramEntry(text.data, (), SourceText(name, text.lines)))


def write_cyclogram(path: Path, cyclogram: Cyclogram) -> None:
    """Write a .toml or .json file. Raises OutputError; ParameterError for another suffix."""
    write_file(path, cyclogram_writer(path)(cyclogram))


def cyclogram_writer(path: Path) -> Callable[[Cyclogram], str]:
    """The function that gives the text of a .toml or .json file. Raises ParameterError for another suffix."""
    writers = {".toml": cyclogram_toml, ".json": cyclogram_json}
    if path.suffix.lower() not in writers:
        raise ParameterError(f"cyclogram file {path} ends in {path.suffix!r}", allowed=".toml or .json")
    return writers[path.suffix.lower()]


def cyclogram_toml(cyclogram: Cyclogram) -> str:
    """The cyclogram as TOML text."""
    data = cyclogram_data(cyclogram)
    parts = [toml_text({key: data[key] for key in ("name", "period")}).rstrip()]
    for name, track in data["tracks"].items():
        deep = ("motions", "events")
        parts.append(toml_section(("tracks", name), {key: value for key, value in track.items() if key not in deep}))
        parts += [toml_section(("tracks", name, key), track[key]) for key in deep if track.get(key)]
    for key in ("relations", "exclusions"):
        parts += [toml_section((key,), entry, many=True) for entry in data.get(key, ())]
    return "\n\n".join(parts) + "\n"


def cyclogram_json(cyclogram: Cyclogram) -> str:
    """The cyclogram as JSON text."""
    return json.dumps(cyclogram_data(cyclogram), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _cyclogram(root: CyclogramEntry) -> Cyclogram:
    root.keys("name", "period", "tracks", "relations", "exclusions", needs=("period", "tracks"))
    tracks = tuple(_track(name, entry) for name, entry in root.table("tracks").entries())
    units = {track.name: track.unit for track in tracks}
    period = root.quantity("period", "s")
    if 0 < period < LEAST:
        root.refuse(ParameterError(f"{period:g} s is too short", allowed=f"{LEAST:g} s or more"), "period")
    known = Cyclogram(root.text("name", "cyclogram"), period, tracks) if tracks else None
    if known is None:
        root.refuse(ParameterError("has no tracks", allowed="at least one table [tracks.NAME]"))
    with root.located():
        relations = tuple(_relation(entry, units) for entry in root.rows("relations"))
        exclusions = tuple(_exclusion(entry, units) for entry in root.rows("exclusions"))
        _check_counts(root, tracks, exclusions)
        for relation, entry in zip(relations, root.rows("relations"), strict=True):
            with entry.located():
                replace(known, relations=(relation,))
        for exclusion, entry in zip(exclusions, root.rows("exclusions"), strict=True):
            with entry.located():
                replace(known, exclusions=(exclusion,))
        return Cyclogram(known.name, known.period, tracks, relations, exclusions)


def _check_counts(root: CyclogramEntry, tracks: Sequence[Track], exclusions: Sequence[Exclusion]) -> None:
    motions = {track.name: len(track.segments) for track in tracks}
    presences = [one for exclusion in exclusions for one in (exclusion.first, exclusion.second)]
    zones = [presence.track for presence in presences if isinstance(presence, Zone)]
    counts = (
        ("tracks", len(tracks), MOST_TRACKS, "tracks"),
        ("tracks", sum(motions.values()), MOST_MOTIONS, "motions"),
        ("tracks", sum(len(track.events) for track in tracks), MOST_EVENTS, "events"),
        ("relations", len(root.rows("relations")), MOST_RELATIONS, "relations"),
        ("exclusions", sum(motions[track] for track in zones), MOST_PASSAGES, "motions through zones of exclusions"),
        ("exclusions", len(exclusions), MOST_RELATIONS, "exclusions"),
    )
    for key, count, most, noun in counts:
        if count > most:
            root.refuse(ParameterError(f"has {count} {noun}", allowed=f"at most {most}"), key)


def _track(name: str, entry: CyclogramEntry) -> Track:
    entry.keys("actuator", "unit", "revolves", "limits", "held", "motions", "events")
    with entry.located():
        unit = entry.text("unit", "mm")
        parse_unit(unit)
        given = (_motion(part, one, unit) for part, one in entry.table("motions").entries())
        parts = tuple(sorted(given, key=lambda part: part.start))
        bare = Track(name, entry.text("actuator", ""), parts, (), unit, entry.quantity("revolves", unit, 0.0))
        events = tuple(_event(bare, event, one) for event, one in entry.table("events").entries())
        limits = _limits(entry.table("limits"), unit)
        return Track(name, bare.actuator, parts, events, unit, bare.revolves, limits, locked=entry.flag("held"))


def _motion(name: str, entry: CyclogramEntry, unit: str) -> TrackSegment:
    entry.keys("start", "end", "from", "to", "law", needs=("start", "end", "from", "to", "law"))
    angles = entry.quantity("start", "rad"), entry.quantity("end", "rad")
    if 0 < angles[1] - angles[0] < LEAST:
        entry.refuse(ParameterError("is too short", allowed=f"{LEAST:g} rad or more from start to end"))
    return TrackSegment(name, *angles, entry.quantity("from", unit), entry.quantity("to", unit), entry.law("law"))


def _event(track: Track, name: str, entry: CyclogramEntry) -> TrackEvent:
    entry.keys("angle", "on", "share", "passing")
    with entry.located():
        if not entry.has("on"):
            return TrackEvent(name, entry.quantity("angle", "rad"))
        segment = track.segment(entry.text("on"))
        if entry.has("passing"):
            position = entry.quantity("passing", track.unit)
            return riding(name, segment, passing_share(track.name, segment, position, track.unit))
        event = riding(name, segment, entry.quantity("share", "1", 1.0))
        angle = entry.quantity("angle", "rad", event.angle)
        return TrackEvent(name, angle, event.on, event.share)


def _limits(entry: CyclogramEntry, unit: str) -> ActuatorLimits:
    entry.keys(*_LIMITS, "time")
    with entry.located():
        found = {key: entry.quantity(key, unit + per, math.inf) for key, per in _LIMITS.items()}
        for key, limit in found.items():
            if 0 < limit < LEAST:
                entry.refuse(ParameterError(f"{limit:g} is too small", allowed=f"{LEAST:g} or more in SI"), key)
        return ActuatorLimits(**found, time=entry.quantity("time", "s", 0.0))


def _relation(entry: CyclogramEntry, units: Mapping[str, str]) -> Relation:
    entry.keys("then", "first", "gap", "most", "turns", "delay", "why", needs=("then", "first"))
    with entry.located():
        least = -math.inf if entry.has("most") else 0.0
        return Relation(
            _moment(entry.table("then"), units),
            _moment(entry.table("first"), units),
            entry.quantity("gap", "rad", least),
            entry.text("why", ""),
            entry.quantity("most", "rad", math.inf),
            entry.whole("turns"),
            entry.quantity("delay", "s", 0.0),
        )


def _moment(entry: CyclogramEntry, units: Mapping[str, str]) -> Moment:
    if entry.has("angle"):
        entry.keys("angle")
        return Moment("", "", "angle", entry.quantity("angle", "rad"))
    edge = next((key for key in _EDGES if entry.has(key)), "starts")
    entry.keys("track", edge, *(["at"] if edge == "past" else []), needs=("track", edge))
    track = _known(entry, units)
    at = entry.quantity("at", units[track]) if edge == "past" else 0.0
    return Moment(track, entry.text(edge), _EDGES[edge], at)


def _known(entry: CyclogramEntry, units: Mapping[str, str]) -> str:
    """The track that an entry names. Raises ParameterError for an unknown one."""
    track = entry.text("track")
    if track not in units:
        entry.refuse(ParameterError(f"there is no track {track!r}", allowed=f"tracks: {', '.join(units)}"), "track")
    return track


def _exclusion(entry: CyclogramEntry, units: Mapping[str, str]) -> Exclusion:
    entry.keys("first", "second", "gap", "why", needs=("first", "second"))
    with entry.located():
        first, second = (_presence(entry.table(key), units) for key in ("first", "second"))
        return Exclusion(first, second, entry.quantity("gap", "rad", 0.0), entry.text("why", "never both"))


def _presence(entry: CyclogramEntry, units: Mapping[str, str]) -> Presence:
    if entry.has("windows"):
        entry.keys("name", "windows")
        with entry.located():
            return Spans(entry.text("name", "windows"), windows_of(entry.pairs("windows", "rad")))
    entry.keys("track", "above", "below", "name", needs=("track",))
    track = _known(entry, units)
    ends = entry.quantity("above", units[track], -math.inf), entry.quantity("below", units[track], math.inf)
    return Zone(track, *ends, entry.text("name", ""))


def cyclogram_data(cyclogram: Cyclogram) -> JsonObject:
    """The cyclogram as the data of a file."""
    units = cyclogram.units
    data: dict[str, Json] = {
        "name": cyclogram.name,
        "period": written_quantity(cyclogram.period, "s"),
        "tracks": {track.name: _track_data(track) for track in cyclogram.tracks},
        "relations": [_relation_data(relation, units) for relation in cyclogram.relations],
        "exclusions": [_exclusion_data(exclusion, units) for exclusion in cyclogram.exclusions],
    }
    return {key: value for key, value in data.items() if value != []}


def _track_data(track: Track) -> dict[str, Json]:
    limits = {
        key: written_quantity(getattr(track.limits, key), track.unit + per)
        for key, per in _LIMITS.items()
        if getattr(track.limits, key) < math.inf
    }
    if track.limits.time:
        limits["time"] = written_quantity(track.limits.time, "s")
    data = {
        "actuator": track.actuator,
        "unit": track.unit,
        "revolves": written_quantity(track.revolves, track.unit) if track.revolves else 0,
        "held": track.locked,
        "limits": limits,
        "motions": {part.name: _motion_data(part, track.unit) for part in track.segments},
        "events": _events_data(track.events),
    }
    return {key: value for key, value in data.items() if value or key in ("actuator", "unit")}


def _motion_data(part: TrackSegment, unit: str) -> dict[str, Json]:
    angles = {key: written_quantity(value, "deg") for key, value in (("start", part.start), ("end", part.end))}
    ends = {key: written_quantity(value, unit) for key, value in (("from", part.begin), ("to", part.finish))}
    return {**angles, **ends, "law": _law_data(part.law)}


def _law_data(law: MotionLaw) -> str | dict[str, Json]:
    if law.name in LAWS and LAWS[law.name].parameters == law.parameters:
        return law.name
    found = {key: list(value) if isinstance(value, tuple) else value for key, value in law.parameters.items()}
    return {"name": law.name, **found} if found else law.name


def _events_data(events: Sequence[TrackEvent]) -> dict[str, Json]:
    """Events by name; further ones of the same name get a number."""
    found: dict[str, Json] = {}
    for event in events:
        numbered = (f"{event.name} {number}" for number in itertools.count(2))
        name = event.name if event.name not in found else next(name for name in numbered if name not in found)
        found[name] = _event_data(event)
    return found


def _event_data(event: TrackEvent) -> JsonObject:
    rides = {"on": event.on, "share": event.share} if event.on else {}
    return {"angle": written_quantity(event.angle, "deg"), **rides}


def _relation_data(one: Relation, units: Mapping[str, str]) -> dict[str, Json]:
    data: dict[str, Json] = {"then": _moment_data(one.then, units), "first": _moment_data(one.first, units)}
    if one.gap > -math.inf:
        data["gap"] = written_quantity(one.gap, "deg")
    if one.most < math.inf:
        data["most"] = written_quantity(one.most, "deg")
    return data | {key: getattr(one, key) for key in ("turns", "delay", "why") if getattr(one, key)}


def _moment_data(one: Moment, units: Mapping[str, str]) -> dict[str, Json]:
    if one.edge == "angle":
        return {"angle": written_quantity(one.at, "deg")}
    edge = next(key for key, value in _EDGES.items() if value == one.edge)
    at = {"at": written_quantity(one.at, units[one.track])} if one.edge == "past" else {}
    return {"track": one.track, edge: one.motion, **at}


def _exclusion_data(one: Exclusion, units: Mapping[str, str]) -> dict[str, Json]:
    both = {key: _presence_data(getattr(one, key), units) for key in ("first", "second")}
    return {**both, "gap": written_quantity(one.gap, "deg"), "why": one.why}


def _presence_data(one: Presence, units: Mapping[str, str]) -> dict[str, Json]:
    if isinstance(one, Spans):
        return {"name": one.name, "windows": [[window.start, window.end] for window in one.windows]}
    ends = {key: written_quantity(at, units[one.track]) for key, at in (("above", one.low), ("below", one.high))
            if math.isfinite(at)}  # fmt: skip
    return {"track": one.track, **ends, **({"name": one.name} if one.name else {})}
