"""The description of a loom programme in its file: one JSON text for each key of the table `meta`.

    digest                  of the programme (`loom.operations.LoomProgramme`)
    all other keys          as in `loom.operations.LoomSetup`; `loading` and `packages` by head

What is read is checked whole: every key, type, range and length. What is written is read again first, so that no file
is written which cannot be read.
"""

import json
import re
import sys
from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray, UInt8
from ilmek.cams.laws import law_of
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.elements.knot_kinds import WRAPS
from ilmek.errors import LoomError, shortened
from ilmek.io.carpet_facts import quality_entry, size_entry, yarn_data, yarn_entries
from ilmek.io.meta_entry import MetaEntry
from ilmek.io.sqlite_readonly import LARGEST_VALUE
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import EMPTY, LONGEST_PACKAGE, ROW_ENDS, LoomSetup, OperationTimes
from ilmek.loom.programme import MOST_PER_SIDE
from ilmek.loom.sharing import MOST_HEADS
from ilmek.loom.times import LONGEST_TIME
from ilmek.report import Json
from ilmek.timing.cyclogram import Cyclogram, Track, TrackEvent, TrackSegment
from ilmek.units import parse_unit, turn

MOST_CYCLOGRAMS, MOST_TRACKS, MOST_MOTIONS, MOST_EVENTS = 4, 64, 200, 200
"""Largest numbers of cyclograms, and in all of them of tracks, motions and events: several times those of a loom."""

MOST_LAW_NUMBERS = 500
"""Largest number of parameters of all motion laws: a spline through 250 points takes all of them and 0.2 s."""

MOST_BOBBINS = 4
"""Largest number of yarns of weft."""

LONGEST_KNOT = 10.0
"""Bound of the pile yarn of a knot [m]."""

_SAME = 1e-9
"""Least share of a turn by which an actuator revolves."""

_DIGEST = re.compile(r"[0-9a-f]{64}")
OPTIONAL = ("row_knots",)
KEYS = ("digest", *(field.name for field in fields(LoomSetup) if field.name not in OPTIONAL))
_SEGMENT = ("name", "start", "end", "begin", "finish")


def meta_texts(setup: LoomSetup, digest: str) -> dict[str, str]:
    """The description as JSON texts by key. Raises an IlmekError for a setup that would be refused when it is read."""
    data = {field.name: _plain(getattr(setup, field.name)) for field in fields(setup) if field.name not in OPTIONAL}
    data |= {} if setup.row_knots is None else {"row_knots": list(setup.row_knots)}
    data |= {"digest": digest, "cyclograms": [_cyclogram_record(cyclogram) for cyclogram in setup.cyclograms]}
    texts = {key: json.dumps(value) for key, value in data.items()}
    read_meta(texts)
    return texts


def _plain(value: Any) -> Any:
    """A value of a setup as plain data."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    if isinstance(value, Yarn):
        return yarn_data(value)
    return value if isinstance(value, str | int | float) else asdict(value)


def read_meta(texts: Mapping[str, str]) -> tuple[LoomSetup, str]:
    """Setup and digest from JSON texts by key, checked. Raises an IlmekError for the first fault, naming its key."""
    if set(texts) - set(OPTIONAL) != set(KEYS):
        raise LoomError("the description has other keys", allowed=", ".join(KEYS))
    entries = {key: MetaEntry(key, _parsed(key, text)) for key, text in texts.items()}
    rows, columns = (entries[key].whole(1, MOST_PER_SIDE) for key in ("rows", "columns"))
    if rows * columns > MOST_KNOTS:
        raise LoomError(f"{columns} x {rows} knots", allowed=f"at most {MOST_KNOTS // 1_000_000} million")
    heads, tubes = entries["heads"].whole(1, MOST_HEADS), entries["tubes"].whole(1, MOST_YARNS)
    yarns = yarn_entries(entries["yarns"])
    setup = LoomSetup(
        loom=_digest(entries["loom"]),
        size=size_entry(entries["size"]),
        quality=quality_entry(entries["quality"]),
        knot=entries["knot"].one_of(*WRAPS),
        yarns=yarns,
        warp_pitch=entries["warp_pitch"].number(1e-6, 1.0),
        rows=rows,
        columns=columns,
        heads=heads,
        tubes=tubes,
        spacing=entries["spacing"].whole(1, MOST_PER_SIDE),
        times=_times(entries["times"]),
        loading=_loading(entries["loading"], heads, tubes, len(yarns)),
        packages=_packages(entries["packages"], heads, tubes),
        knot_yarn=tuple(row.number(0.0, LONGEST_KNOT) for row in entries["knot_yarn"].rows(len(yarns), len(yarns))),
        wefts=_bobbins(entries["wefts"]),
        cyclograms=_CyclogramReader().cyclograms(entries["cyclograms"]),
        row_knots=tuple(entries["row_knots"].wholes(rows, columns).tolist()) if "row_knots" in entries else None,
    )
    return setup, _digest(entries["digest"])


def _parsed(key: str, text: str) -> Any:
    if len(text) > LARGEST_VALUE:
        raise LoomError(f"{key} has {len(text)} characters", allowed=f"at most {LARGEST_VALUE}")
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:  # no JSON, a number of thousands of digits, deeply nested brackets
        raise LoomError(f"{key} is not JSON ({shortened(str(error), 100)})") from None


def _digest(entry: MetaEntry) -> str:
    text = entry.text()
    if _DIGEST.fullmatch(text) is None:
        entry.refuse("64 hexadecimal digits")
    return text


def _times(entry: MetaEntry) -> OperationTimes:
    """The times of the operations: of a knot above 0, the ends of a row in their order."""
    given = entry.table(*(field.name for field in fields(OperationTimes)))
    ends = tuple(row.number(0.0, LONGEST_TIME) for row in given.pop("row_ends").rows(len(ROW_ENDS), len(ROW_ENDS)))
    if list(ends) != sorted(ends):
        raise LoomError("times.row_ends are not in order", allowed="ascending times")
    times = OperationTimes(**{key: one.number(0.0, LONGEST_TIME) for key, one in given.items()}, row_ends=ends)
    if times.knot == 0:
        raise LoomError("time of knot 0 s", allowed="above 0 s")
    return times


def _loading(entry: MetaEntry, heads: int, tubes: int, yarns: int) -> UInt8[np.ndarray, "heads tubes"]:
    loading = np.array([row.wholes(tubes, EMPTY) for row in entry.rows(heads, heads)])
    if np.any((loading >= yarns) & (loading != EMPTY)):
        raise LoomError("loading has an unknown yarn", allowed=f"0 to {yarns - 1}, and {EMPTY} for an empty tube")
    return loading.astype(np.uint8)


def _packages(entry: MetaEntry, heads: int, tubes: int) -> FloatArray:
    found = [[one.number(0.0, LONGEST_PACKAGE) for one in row.rows(tubes, tubes)] for row in entry.rows(heads, heads)]
    return np.array(found)


def _bobbins(entry: MetaEntry) -> tuple[Bobbin, ...]:
    """The bobbins of weft, one for each yarn."""
    bobbins = []
    for row in entry.rows(0, MOST_BOBBINS):
        given = row.table(*(field.name for field in fields(Bobbin)))
        lasts = given["rows"].whole(1, sys.maxsize)
        bobbins.append(Bobbin(given["yarn"].text(least=1), lasts, given["time"].number(0.0, LONGEST_TIME)))
    if len({bobbin.yarn for bobbin in bobbins}) < len(bobbins):
        raise LoomError("a yarn of weft has two bobbins", allowed="one for each")
    return tuple(bobbins)


def _cyclogram_record(cyclogram: Cyclogram) -> dict[str, Json]:
    """A cyclogram as plain data; a law by its name and parameters."""
    return {
        "name": cyclogram.name,
        "period": cyclogram.period,
        "tracks": [
            {
                "name": track.name,
                "actuator": track.actuator,
                "unit": track.unit,
                "revolves": track.revolves,
                "segments": [
                    {
                        **{key: getattr(part, key) for key in _SEGMENT},
                        "law": part.law.name,
                        "parameters": dict(part.law.parameters),
                    }
                    for part in track.segments
                ],
                "events": [asdict(event) for event in track.events],
            }
            for track in cyclogram.tracks
        ],
    }


class _CyclogramReader:
    """Reads cyclograms and counts what all of them have together."""

    def __init__(self) -> None:
        self.tracks, self.motions, self.events, self.law_numbers = 0, 0, 0, 0

    def cyclograms(self, entry: MetaEntry) -> tuple[Cyclogram, ...]:
        """The cyclograms of a list."""
        return tuple(self._cyclogram(row) for row in entry.rows(0, MOST_CYCLOGRAMS))

    def _cyclogram(self, entry: MetaEntry) -> Cyclogram:
        given = entry.table("name", "period", "tracks")
        tracks = given["tracks"].rows(0, MOST_TRACKS - self.tracks)
        self.tracks += len(tracks)
        return Cyclogram(
            given["name"].text(),
            given["period"].number(0.0, LONGEST_TIME),
            tuple(self._track(track) for track in tracks),
        )

    def _track(self, entry: MetaEntry) -> Track:
        given = entry.table("name", "actuator", "unit", "revolves", "segments", "events")
        segments = given["segments"].rows(0, MOST_MOTIONS - self.motions)
        events = given["events"].rows(0, MOST_EVENTS - self.events)
        self.motions += len(segments)
        self.events += len(events)
        unit, revolves = given["unit"].text(), given["revolves"].number()
        parse_unit(unit)
        if 0 < abs(revolves) < _SAME:
            given["revolves"].refuse(f"0, or a magnitude of at least {_SAME:g}")
        return Track(
            given["name"].text(),
            given["actuator"].text(),
            tuple(self._segment(segment) for segment in segments),
            tuple(self._event(event) for event in events),
            unit,
            revolves,
        )

    def _segment(self, entry: MetaEntry) -> TrackSegment:
        given = entry.table(*_SEGMENT, "law", "parameters")
        return TrackSegment(
            given["name"].text(),
            given["start"].number(0.0, 2 * turn),
            given["end"].number(0.0, 2 * turn),
            given["begin"].number(),
            given["finish"].number(),
            law_of(given["law"].text(), self._parameters(given["parameters"])),
        )

    def _parameters(self, entry: MetaEntry) -> dict[str, Json]:
        if not isinstance(entry.value, dict):
            entry.refuse("a table of numbers and lists of numbers")
        parameters: dict[str, Json] = {}
        for key, value in entry.value.items():
            MetaEntry(f"{entry.path}: a name", key).text()
            one = MetaEntry(f"{entry.path}.{shortened(key)}", value)
            single = not isinstance(value, list)
            numbers = [one] if single else one.rows(0, MOST_LAW_NUMBERS - self.law_numbers)
            self.law_numbers += len(numbers)
            if self.law_numbers > MOST_LAW_NUMBERS:
                raise LoomError("the motion laws have too many parameters", allowed=f"at most {MOST_LAW_NUMBERS}")
            values = tuple(number.number() for number in numbers)
            parameters[key] = values[0] if single else values
        return parameters

    def _event(self, entry: MetaEntry) -> TrackEvent:
        given = entry.table("name", "angle", "on", "share")
        return TrackEvent(
            given["name"].text(), given["angle"].number(0.0, turn), given["on"].text(), given["share"].number(0.0, 1.0)
        )
