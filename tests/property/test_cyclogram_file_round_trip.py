"""A cyclogram written is read again to the last bit, as TOML and as JSON; a mistake is named by its line."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS, law_of
from ilmek.errors import ParameterError
from ilmek.io.cyclogram_file import (
    cyclogram_json,
    cyclogram_toml,
    parse_cyclogram,
    read_cyclogram,
    write_cyclogram,
)
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
    fixed,
    riding,
)
from ilmek.timing.windows import Window
from ilmek.units import turn

EXAMPLE = Path(__file__).parents[2] / "examples" / "press.toml"
LAW = [*LAWS.values(), law_of("modified-sine", {"constant_velocity": 0.3})]
LETTERS = list("aB 9.:-_'\"\\[]{}=#,é≥")


def name(pick: np.random.Generator) -> str:
    """Any printable text, hard ones among them."""
    return "".join(pick.choice(LETTERS, pick.integers(0, 6)))


def names(pick: np.random.Generator, count: int) -> list[str]:
    return [f"{name(pick)}{number}" for number in range(count)]


def track(pick: np.random.Generator, called: str) -> Track:
    cuts = np.sort(pick.uniform(0, turn, 4)).tolist()
    ends, low, high = names(pick, 2), -pick.uniform(0.01, 1), pick.uniform(0.01, 1)
    laws = [LAW[number] for number in pick.integers(0, len(LAW), 2)]
    parts = (
        TrackSegment(ends[0], cuts[0], cuts[1], low, high, laws[0]),
        TrackSegment(ends[1], cuts[2], cuts[3], high, low, laws[1]),
    )
    events = (TrackEvent("alone", pick.uniform(0, turn)), riding("rides", parts[0], pick.uniform()))
    limits = ActuatorLimits(pick.uniform(0.1, 9), pick.choice([math.inf, 4.5]), pick.uniform(1, 1e6), pick.uniform())
    unit, revolves = str(pick.choice(["mm", "deg", "m", "1"])), float(pick.choice([0.0, turn]))
    return Track(called, name(pick), parts, events, unit, revolves, limits, bool(pick.integers(2)))


def cyclogram(pick: np.random.Generator) -> Cyclogram:
    made = tuple(track(pick, called) for called in names(pick, int(pick.integers(1, 4))))
    first, last = made[0], made[-1]
    part, gap = first.segments[0], float(pick.uniform(-7, 7))
    moments = (
        Moment(first.name, part.name, str(pick.choice(["start", "end"]))),
        Moment(first.name, part.name, "past", (part.begin + part.finish) / 2),
        Moment(last.name, "rides", "event"),
        fixed(pick.uniform(0, turn)),
    )
    relations = (
        Relation(moments[0], moments[2], gap, name(pick), gap + 1, int(pick.integers(-2, 3)), pick.uniform()),
        Relation(moments[1], moments[3], -math.inf, "", most=gap),
    )
    zone = Zone(first.name, pick.uniform(-1, 1), math.inf, name(pick))
    exclusion = Exclusion(zone, Spans("reed", (Window(0.5, pick.uniform(1, 6.5)),)), gap, name(pick))
    return Cyclogram(name(pick), pick.uniform(0.01, 100), made, relations, (exclusion,))


@settings(max_examples=6)
@given(seed=st.integers(0, 2**32 - 1))
def test_round_trip(seed) -> None:
    made = cyclogram(np.random.default_rng(seed))
    assert parse_cyclogram(cyclogram_toml(made)) == made
    assert parse_cyclogram(cyclogram_json(made), toml=False) == made


@pytest.mark.parametrize("ending", ["toml", "json"])
def test_the_example_through_a_file(tmp_path: Path, ending: str) -> None:
    example, place = read_cyclogram(EXAMPLE), tmp_path / f"again.{ending}"
    write_cyclogram(place, example)
    assert read_cyclogram(place) == example
    assert 'end = "80deg"' in cyclogram_toml(example)  # numbers a person can read, where they are the same numbers


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"modified-sine" }', '"modified-sin" }', "tracks.die.motions.down.law: there is no law 'modified-sin'"),
        ('start = "170deg"', 'start = "220deg"', "tracks.die: die: down runs from 220 deg to 215 deg"),
        ('start = "225deg"', 'start = "200deg"', "tracks.die: die: up starts at 200 deg, before down ends at 215 deg"),
        ('period = "1s"', 'period = "1mm"', "line 4, period: '1mm' has the wrong unit"),
        ('period = "1s"', "", "has no 'period'"),
        ('gap = "10deg"', 'gab = "10deg"', "unknown key 'gab'; keys: then, first, gap, .*did you mean 'gap'"),
        ('starts = "out" }', 'starts = "jump" }', "relations.0: feeder has no motion 'jump'; its motions: in, out"),
        ('at = "40mm"', 'at = "140mm"', "relations.2: die: up never passes 140 mm; it goes from 100 mm to 0 mm"),
        ('track = "die", above', 'track = "dye", above', "first.track: there is no track 'dye'; tracks: feeder, die"),
        ('share = 1.0 }', 'share = 2.0 }', "a share from 0 to 1"),
        ('time = "60ms"', 'time = "-60ms"', "tracks.ejector.limits: least time of a motion -0.06 s"),
        ('speed = "3m/s"', 'speed = "3rpm"', "limits.speed: '3rpm' has the wrong unit"),
        ("turns = 1", "turns = 0.5", "relations.3.turns: 0.5 is not a whole number"),
        ("[tracks.die]", "[tracks.die", "line 17, column 12: "),
    ],
)  # fmt: skip
def test_a_mistake_is_named(old: str, new: str, said: str) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(ParameterError, match=said):
        parse_cyclogram(text.replace(old, new, 1), name="press.toml")


def test_events_of_one_name_are_numbered() -> None:
    press = read_cyclogram(EXAMPLE)
    (feeder,) = (one for one in press.tracks if one.name == "feeder")
    twice = replace(feeder, events=(TrackEvent("beat", 1.0), TrackEvent("beat", 2.0)))
    beats = replace(press, tracks=(twice,), relations=(), exclusions=())
    (again,) = parse_cyclogram(cyclogram_toml(beats)).tracks
    assert again.events == (TrackEvent("beat", 1.0), TrackEvent("beat 2", 2.0))
