"""The description of a loom programme in its file: one JSON text for each key of the table `meta`.

    size, quality, knot, yarns, warp_pitch, cyclograms    of the carpet and the loom (`Label`)
    rows, columns, heads, edges, times                    as in `loom.programme.Programme`
    bobbins                                               of weft: yarn, rows that each lasts, time of its change
    totals, work                                          of the carpet (`Totals`), and of each head (`HeadWork`)

What is read is checked whole: every key, type, range and length, and that the numbers agree with each other. What is
written is read again first, so that no file is written which cannot be read.
"""

import json
import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from ilmek.arrays import IntArray
from ilmek.cams.laws import law_of
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.elements.knot_kinds import WRAPS
from ilmek.errors import LoomError, shortened
from ilmek.io.carpet_facts import quality_entry, size_entry, yarn_entries
from ilmek.io.meta_entry import MetaEntry
from ilmek.io.sqlite_readonly import LARGEST_VALUE
from ilmek.loom.bobbins import Bobbin, stop_time
from ilmek.loom.programme import LONGEST_TIME, MOST_PER_SIDE, HeadWork, Programme, Times
from ilmek.loom.sharing import MOST_HEADS, halves, share
from ilmek.records import record
from ilmek.timing.cyclogram import Cyclogram, Track, TrackEvent, TrackSegment
from ilmek.units import parse_unit, turn

MOST_CYCLOGRAMS, MOST_TRACKS, MOST_MOTIONS, MOST_EVENTS = 4, 64, 200, 200
"""Largest numbers of cyclograms, and in all of them of tracks, motions and events: several times those of a loom."""

MOST_LAW_NUMBERS = 500
"""Largest number of parameters of all motion laws: a spline through 250 points takes all of them and 0.2 s."""

MOST_BOBBINS = 4
"""Largest number of yarns of weft."""

MOST_TRAVEL = 4 * MOST_YARNS * MOST_KNOTS
"""Bound of the pitches moved by all heads: each pass of a part moves a head over less than four parts."""

_SAME = 1e-9
"""Relative difference of sums that are taken in another order."""

_BLOCK = 1 << 21
"""Knots that are counted at once."""

_KEYS = (
    "size", "quality", "knot", "yarns", "warp_pitch", "rows", "columns", "heads", "edges", "times", "bobbins", "totals",
    "work", "cyclograms",
)  # fmt: skip
_SEGMENT = ("name", "start", "end", "begin", "finish")


@dataclass(frozen=True, slots=True)
class Label:
    """Description of a programme: the carpet, its yarns in the order of the chart, the loom's warp pitch [m], and the
    cyclograms of a knot and of a row.
    """

    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]
    warp_pitch: float
    cyclograms: tuple[Cyclogram, ...] = ()


@dataclass(frozen=True, slots=True)
class Totals:
    """Totals of the carpet.

    duration  weaving time [s]
    travel    pitches moved by all heads
    counts    knots of each yarn
    """

    duration: float
    knots: int
    changes: int
    travel: int
    counts: tuple[int, ...]

    @property
    def changes_per_knot(self) -> float:
        """Colour changes per knot."""
        return self.changes / self.knots


@record
class ProgrammeMeta:
    """The description of a programme."""

    label: Label
    rows: int
    columns: int
    heads: int
    edges: IntArray
    times: Times
    bobbins: tuple[Bobbin, ...]
    totals: Totals
    work: HeadWork


def meta_texts(programme: Programme, label: Label) -> dict[str, str]:
    """The description as JSON texts by key. Raises an IlmekError for a label that would be refused when it is read."""
    counts = np.zeros(programme.yarns, np.int64)
    step = max(1, _BLOCK // programme.columns)
    for first in range(0, programme.rows, step):
        counts += np.bincount(programme.knots[first : first + step].ravel(), minlength=programme.yarns)
    data = {
        "size": asdict(label.size),
        "quality": asdict(label.quality),
        "knot": label.knot,
        "yarns": [asdict(yarn) for yarn in label.yarns],
        "warp_pitch": label.warp_pitch,
        "rows": programme.rows,
        "columns": programme.columns,
        "heads": programme.heads,
        "edges": programme.edges.tolist(),
        "times": asdict(programme.times),
        "bobbins": [asdict(bobbin) for bobbin in programme.bobbins],
        "totals": {
            "duration": programme.duration,
            "knots": int(counts.sum()),
            "changes": int(programme.work.changes.sum()),
            "travel": int(programme.work.travel.sum()),
            "counts": counts.tolist(),
        },
        "work": {one.name: getattr(programme.work, one.name).tolist() for one in fields(HeadWork)},
        "cyclograms": [_cyclogram_record(cyclogram) for cyclogram in label.cyclograms],
    }
    texts = {key: json.dumps(value) for key, value in data.items()}
    read_meta(texts)
    return texts


def read_meta(texts: Mapping[str, str]) -> ProgrammeMeta:
    """The description from JSON texts by key, checked. Raises an IlmekError for the first fault, naming its key."""
    if set(texts) != set(_KEYS):
        raise LoomError("the description has other keys", allowed=", ".join(_KEYS))
    entries = {key: MetaEntry(key, _parsed(key, texts[key])) for key in _KEYS}
    rows, columns = (entries[key].whole(1, MOST_PER_SIDE) for key in ("rows", "columns"))
    if rows * columns > MOST_KNOTS:
        raise LoomError(f"{columns} x {rows} knots", allowed=f"at most {MOST_KNOTS // 1_000_000} million")
    heads = entries["heads"].whole(1, MOST_HEADS)
    edges = share(columns, heads)
    if entries["edges"].wholes(len(edges), columns).tolist() != edges.tolist():
        raise LoomError("the edges are not those of the heads", allowed="as `loom.sharing.share` gives them")
    given_times = entries["times"].table(*Times.__slots__)
    times = Times(**{key: one.number(0.0, LONGEST_TIME) for key, one in given_times.items()})
    label = Label(
        size_entry(entries["size"]),
        quality_entry(entries["quality"]),
        entries["knot"].one_of(*WRAPS),
        yarn_entries(entries["yarns"]),
        entries["warp_pitch"].number(1e-6, 1.0),
        _CyclogramReader().cyclograms(entries["cyclograms"]),
    )
    bobbins, totals = _bobbins(entries["bobbins"]), _totals(entries["totals"], len(label.yarns))
    meta = ProgrammeMeta(label, rows, columns, heads, edges, times, bobbins, totals, _work(entries["work"], heads))
    _require_agreement(meta)
    return meta


def _parsed(key: str, text: str) -> Any:
    if len(text) > LARGEST_VALUE:
        raise LoomError(f"{key} has {len(text)} characters", allowed=f"at most {LARGEST_VALUE}")
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:  # no JSON, a number of thousands of digits, deeply nested brackets
        raise LoomError(f"{key} is not JSON ({shortened(str(error), 100)})") from None


def _bobbins(entry: MetaEntry) -> tuple[Bobbin, ...]:
    """The bobbins of weft, one for each yarn."""
    found = []
    for one in entry.rows(0, MOST_BOBBINS):
        given = one.table(*(field.name for field in fields(Bobbin)))
        lasts = given["rows"].whole(1, sys.maxsize)
        found.append(Bobbin(given["yarn"].text(least=1), lasts, given["time"].number(0.0, LONGEST_TIME)))
    if len({bobbin.yarn for bobbin in found}) < len(found):
        raise LoomError("a yarn of weft has two bobbins", allowed="one for each")
    return tuple(found)


def _totals(entry: MetaEntry, yarns: int) -> Totals:
    given = entry.table(*(field.name for field in fields(Totals)))
    return Totals(
        given["duration"].number(0.0, sys.float_info.max),
        given["knots"].whole(1, MOST_KNOTS),
        given["changes"].whole(0, MOST_KNOTS),
        given["travel"].whole(0, MOST_TRAVEL),
        tuple(given["counts"].wholes(yarns, MOST_KNOTS).tolist()),
    )


def _work(entry: MetaEntry, heads: int) -> HeadWork:
    given = entry.table(*(field.name for field in fields(HeadWork)))
    busy = np.array([one.number(0.0, sys.float_info.max) for one in given.pop("busy").rows(heads, heads)])
    return HeadWork(**{key: one.wholes(heads, MOST_TRAVEL) for key, one in given.items()}, busy=busy)


def _require_agreement(meta: ProgrammeMeta) -> None:
    """Raise LoomError unless totals, work and times agree: knots and sums exactly, times within their bounds.

    A head is busy for knots t_knot + changes t_change, and for at most t_travel longer per pitch. The weaving time is
    at least wefts, stops and the busiest head, at most wefts, stops and all heads one after the other.
    """
    work, totals, times = meta.work, meta.totals, meta.times
    blocks = np.diff(meta.edges[:: halves(meta.heads)])
    sums = (totals.knots, totals.knots, totals.changes, totals.travel)
    if sums != (meta.rows * meta.columns, sum(totals.counts), int(work.changes.sum()), int(work.travel.sum())):
        raise LoomError("the totals are not those of the yarns and heads")
    if np.any(work.knots != meta.rows * blocks) or np.any(work.changes > work.knots):
        raise LoomError("the work of the heads is not that of their knots")
    least = work.knots * times.knot + work.changes * times.colour_change
    most = least + work.travel * times.travel
    if not np.all((least <= work.busy * (1 + _SAME)) & (work.busy <= most * (1 + _SAME))):
        raise LoomError("the working times of the heads are not those of their work")
    tying = totals.duration - meta.rows * times.weft - stop_time(meta.bobbins, meta.rows)
    rounding = _SAME * totals.duration
    if not work.busy.max() - rounding <= tying <= work.busy.sum() + rounding:
        raise LoomError("the weaving time is not that of the heads and wefts")


def _cyclogram_record(cyclogram: Cyclogram) -> dict[str, Any]:
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
        return tuple(self._cyclogram(one) for one in entry.rows(0, MOST_CYCLOGRAMS))

    def _cyclogram(self, entry: MetaEntry) -> Cyclogram:
        given = entry.table("name", "period", "tracks")
        tracks = given["tracks"].rows(0, MOST_TRACKS - self.tracks)
        self.tracks += len(tracks)
        return Cyclogram(
            given["name"].text(), given["period"].number(0.0, LONGEST_TIME), tuple(self._track(one) for one in tracks)
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
            tuple(self._segment(one) for one in segments),
            tuple(self._event(one) for one in events),
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

    def _parameters(self, entry: MetaEntry) -> dict[str, Any]:
        if not isinstance(entry.value, dict):
            entry.refuse("a table of numbers and lists of numbers")
        found: dict[str, Any] = {}
        for key, value in entry.value.items():
            MetaEntry(f"{entry.path}: a name", key).text()
            one = MetaEntry(f"{entry.path}.{shortened(key)}", value)
            single = not isinstance(value, list)
            numbers = [one] if single else one.rows(0, MOST_LAW_NUMBERS - self.law_numbers)
            self.law_numbers += len(numbers)
            if self.law_numbers > MOST_LAW_NUMBERS:
                raise LoomError("the motion laws have too many parameters", allowed=f"at most {MOST_LAW_NUMBERS}")
            values = tuple(number.number() for number in numbers)
            found[key] = values[0] if single else values
        return found

    def _event(self, entry: MetaEntry) -> TrackEvent:
        given = entry.table("name", "angle", "on", "share")
        return TrackEvent(
            given["name"].text(), given["angle"].number(0.0, turn), given["on"].text(), given["share"].number(0.0, 1.0)
        )
