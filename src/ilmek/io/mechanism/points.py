"""Points of the bodies of a mechanism file: coordinates, polar, by three sides; links given by their length."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any, NamedTuple

from ilmek.errors import MechanismError, did_you_mean
from ilmek.io.declared import ChoiceEntry, ListEntry, TextEntry, keys, quantity, variant
from ilmek.io.mechanism.joints import Members
from ilmek.io.mechanism.names import LENGTH, XY, two_names
from ilmek.io.schema import SourceText, Table
from ilmek.linkage.model import GROUND, Joint

_ROUNDING = 1e-15

_FROM = TextEntry("a point of the body", "point")

POINT = variant(
    XY,
    keys(
        {
            "radius": quantity("m", "distance from the origin, or from the point `from`"),
            "angle": quantity("rad", "of the direction, against x of the body"),
        },
        {"from": _FROM},
    ),
    keys(
        {
            "sides": ListEntry("distances from the two points `from`", LENGTH, 2, 2),
            "side": ChoiceEntry("of the line from the first to the second", ("left", "right")),
        },
        {"from": two_names("two points of the body; of a body with length: by default its two ends", "point")},
    ),
    keys({"offset": replace(XY, doc="from the point `from`"), "from": _FROM}),
    name="point",
    doc="position in the body's own frame",
)

AT = variant(_FROM, XY, doc="a point of the body, or [x, y] in its frame", name="at")

LARGEST_RATIO = 200.0
"""Greatest ratio of the longest to the shortest link length that needs no confirmation."""


def complex_of(pair: Iterable[float]) -> complex:
    """A pair of coordinates as a complex number."""
    x, y = pair
    return complex(x, y)


def polar(radius: float, angle: float) -> complex:
    """A vector by its length and direction [rad]; along an axis its other component is exactly 0.

    >>> polar(2.0, math.pi / 2)
    2j
    """
    cos, sin = math.cos(angle), math.sin(angle)
    return complex(radius * (cos if abs(cos) > _ROUNDING else 0.0), radius * (sin if abs(sin) > _ROUNDING else 0.0))


def points_of(
    body: str, table: Table, members: Members, joints: Iterable[Joint], source: SourceText
) -> dict[str, complex]:
    """The points of a body in its frame [m], those of all its joints among them where they follow from the file.

    body     name           table  of the body, checked by the schema      members  bodies of each joint of the file
    joints   of the mechanism, each of two bodies
    Raises MechanismError with line and key.
    """
    own = [joint for joint, bodies in members.items() if body in bodies]
    given = table.get("points", {})
    ends = _ends(body, table, [joint for joint in own if joint not in given], source)
    found = dict(zip(ends, (0j, complex(table.get("length", 0.0))), strict=False))
    if not given and not ends and body != GROUND:
        found = dict.fromkeys(own, 0j)
    _Points(body, given, ends, found, source).add_all()
    ordered = {name: found[name] for name in (*ends, *given)} or found
    for joint in joints:
        name = joint.name.rpartition(".")[0]
        if body in joint.bodies and joint.name not in ordered and name in ordered and name in own:
            ordered[joint.name] = ordered[name]
    return ordered


def _ends(body: str, table: Table, free: list[str], source: SourceText) -> tuple[str, ...]:
    """The two joints of a link that is given by its length."""
    if "length" not in table:
        if "between" in table:
            source.refuse(
                ("bodies", body, "between"), MechanismError("is given without a length", do="give length too")
            )
        return ()
    ends = tuple(table.get("between", free))
    if len(ends) != 2 or ends[0] == ends[1]:
        names = ", ".join(ends) or "none"
        given = f"a length is between two joints, and {body!r} has {len(ends)} without a point of its own: {names}"
        error = MechanismError(given, do="give `between`, or the other points")
        source.refuse(("bodies", body, "length"), error)
    return ends


class _Points:
    """Points that may be given by other points of the body."""

    def __init__(
        self, body: str, given: Table, ends: tuple[str, ...], found: dict[str, complex], source: SourceText
    ) -> None:
        self.body, self.given, self.ends, self.found, self.source = body, given, ends, found, source

    def add_all(self) -> None:
        """Add every given point to those found, each after those that it uses."""
        for first in self.given:
            waiting = [first]
            while waiting:
                name = waiting[-1]
                if name in self.found:
                    waiting.pop()
                    continue
                with self.source.located("bodies", self.body, "points", name):
                    later = [other for other in self._uses(name) if other not in self.found]
                    for other in later:
                        self._check(other, waiting)
                    if not later:
                        self.found[waiting.pop()] = self._position(self.given[name])
                waiting += later[:1]

    def _uses(self, name: str) -> tuple[str, ...]:
        entry = self.given[name]
        if isinstance(entry, list):
            return ()
        if "sides" not in entry:
            return (entry["from"],) if "from" in entry else ()
        uses = tuple(entry.get("from", self.ends))
        if len(uses) != 2:
            raise MechanismError("has two sides, but no two points", do="give `from`, two points of the body")
        return uses

    def _check(self, other: str, waiting: list[str]) -> None:
        if other in waiting:
            circle = " -> ".join([*waiting[waiting.index(other) :], other])
            raise MechanismError(f"the points {circle} of {self.body} depend on one another")
        if other not in self.given:
            known = [*self.found, *self.given]
            allowed = f"it has {', '.join(dict.fromkeys(known)) or 'none'}"
            given = f"body {self.body!r} has no point {other!r}"
            raise MechanismError(given, allowed=allowed, do=did_you_mean(other, known))

    def _position(self, entry: Any) -> complex:
        if isinstance(entry, list):
            return complex_of(entry)
        if "sides" in entry:
            start, end = (self.found[name] for name in entry.get("from", self.ends))
            return third_corner(start, end, *entry["sides"], left=entry["side"] == "left")
        start = self.found[entry["from"]] if "from" in entry else 0j
        if "offset" in entry:
            return start + complex_of(entry["offset"])
        return start + polar(entry["radius"], entry["angle"])


def third_corner(start: complex, end: complex, first: float, second: float, *, left: bool) -> complex:
    """The corner of a triangle at given distances from two others [m].

        x = (d² + a² - b²) / (2 d),   y = ± √(a² - x²)            along and across start -> end

    start, end     corners [m]; d apart      first, second  distances a, b from them [m]
    left           whether the corner is on the left of start -> end

    Raises MechanismError where the sides form no triangle.
    >>> third_corner(0j, 4 + 0j, 3.0, 5.0, left=True)
    3j
    """
    apart = abs(end - start)
    if not (first > 0 and second > 0 and apart > 0 and abs(first - second) <= apart <= first + second):
        given = f"sides of {first * 1e3:g} mm, {second * 1e3:g} mm and {apart * 1e3:g} mm form no triangle"
        raise MechanismError(given, allowed="each side is at most the sum of the other two")
    along = (apart**2 + (first - second) * (first + second)) / (2 * apart)
    across = math.sqrt(max(first**2 - along**2, 0.0))
    return start + complex(along, across if left else -across) * (end - start) / apart


def check_lengths(points: Mapping[str, Mapping[str, complex]], members: Members, source: SourceText) -> None:
    """Raise MechanismError where the longest link length is more than `LARGEST_RATIO` times the shortest.

    points  body -> name -> position [m]; a length is the distance between two joints of one body
    """
    extremes = extreme_lengths(points, members)
    if extremes is None:
        return
    short, long = extremes
    if long.length > LARGEST_RATIO * short.length:
        error = MechanismError(
            f"{long} is {long.length * 1e3:g} mm and {short} {short.length * 1e3:g} mm: "
            f"{long.length / short.length:.0f} to 1",
            allowed=f"up to {LARGEST_RATIO:g} to 1 without confirmation",
            do='check the units; if they are right, write confirm = ["lengths"] at the top of the file',
        )
        source.refuse(("bodies", long.body), error)


class LinkLength(NamedTuple):
    """The distance between two joints of a body [m]."""

    length: float
    body: str
    first: str
    second: str

    def __str__(self) -> str:
        return f"{self.first}-{self.second} of {self.body}"


def extreme_lengths(
    points: Mapping[str, Mapping[str, complex]], members: Members
) -> tuple[LinkLength, LinkLength] | None:
    """The shortest and the longest distance above 0 between two joints of one body; None where there is none."""
    found: list[LinkLength] = []
    for body, own in points.items():
        joints = [name for name, bodies in members.items() if body in bodies and name in own]
        pairs = combinations(joints, 2)
        found += [LinkLength(abs(own[first] - own[second]), body, first, second) for first, second in pairs]
    lengths = [length for length in found if length.length > 0]
    return (min(lengths), max(lengths)) if lengths else None
