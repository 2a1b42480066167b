"""Bodies, joints and inputs: the parts of a planar mechanism."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TypeAlias

from ilmek.arguments import TURN, Arguments
from ilmek.errors import MechanismError
from ilmek.records import brief

GROUND = "ground"
"""The fixed body; its frame is the world."""

NamedPoint: TypeAlias = str | tuple[str, str]
"""A point of a body: "body.point", or (body, point)."""

FreePoint: TypeAlias = NamedPoint | tuple[str, complex]
"""A point of a body, or (body, position in its frame [m])."""


@dataclass(frozen=True, slots=True)
class Body:
    """A rigid body: named points in its own frame [m], complex or (x, y).

    The frame is free to choose; the origin need not be a point of the body. The body named "ground" is fixed and
    its frame is the world.

    >>> Body("rocker", {"B0": 0, "B": 0.23, "E": (0.3, 0.05)}).points["E"]
    (0.3+0.05j)
    """

    name: str
    points: Mapping[str, complex]

    def __post_init__(self) -> None:
        set_texts(self, "name")
        given = Arguments(f"body {self.name!r}", MechanismError)
        points: dict[str, complex] = {}
        for name, point in given.mapping("points", self.points, lambda _, point: point).items():
            try:
                points[name] = given.point(f"point {name!r}", point)
            except MechanismError as error:
                error.about = ("bodies", self.name, "points", name)
                raise
        object.__setattr__(self, "points", points)

    def __hash__(self) -> int:
        return hash((self.name, tuple(sorted(self.points))))

    def __repr__(self) -> str:
        return brief(self)


@dataclass(frozen=True, slots=True)
class Pin:
    """A turning joint: two bodies at the point that both carry under the pin's name.

    The order of the bodies defines the branch of a group with this pin as its free pin: with +1 the pin is on the left
    of the line from the known pin of `first` to the known pin of `second`.

    >>> Pin("B", "coupler", "rocker").bodies
    ('coupler', 'rocker')
    """

    name: str
    first: str
    second: str

    def __post_init__(self) -> None:
        set_texts(self, "name", "first", "second")

    @property
    def bodies(self) -> tuple[str, str]:
        """The two joined bodies."""
        return self.first, self.second


@dataclass(frozen=True, slots=True)
class Slide:
    """A sliding joint: a point of `body` moves along a line of `guide`; the angle between the bodies is fixed.

    The line goes through the guide's point of the slide's name, in direction `along` [rad] of the guide's frame; the
    body's point of the slide's name lies on it, `s` metres from the guide's point. The body has the angle `turned`
    [rad] against the guide. An offset slider is one whose line misses the crank's pivot; the guide may move.

    >>> round(Slide("line", "ram", "ground", along="90deg").along, 4)
    1.5708
    """

    name: str
    body: str
    guide: str
    along: float = 0.0
    turned: float = 0.0

    def __post_init__(self) -> None:
        set_texts(self, "name", "body", "guide")
        given = Arguments(f"slide {self.name!r}", MechanismError)
        with about("joints", self.name):
            for name in ("along", "turned"):
                object.__setattr__(self, name, given.angle(name, getattr(self, name), most=2 * TURN))

    @property
    def bodies(self) -> tuple[str, str]:
        """The two joined bodies: the sliding body and the guide."""
        return self.body, self.guide


@dataclass(frozen=True, slots=True)
class Rotation:
    """An input that turns `body` about the pin `about`: the angle [rad] against the other body at that pin.

    For a pin on the ground that is the angle of the body in the world, counter-clockwise from x.

    >>> Rotation("crank", "A0").name
    'crank'
    """

    body: str
    about: str

    def __post_init__(self) -> None:
        set_texts(self, "body", "about")

    @property
    def name(self) -> str:
        """Name of the input in `solve`: the name of the body."""
        return self.body

    @property
    def joint(self) -> str:
        """The joint that it drives."""
        return self.about


@dataclass(frozen=True, slots=True)
class Displacement:
    """An input that shifts a slide: the distance s [m] from the guide's point along the line.

    >>> Displacement("line").name
    'line'
    """

    slide: str

    def __post_init__(self) -> None:
        set_texts(self, "slide")

    @property
    def name(self) -> str:
        """Name of the input in `solve`: the name of the slide."""
        return self.slide

    @property
    def joint(self) -> str:
        """The joint that it drives."""
        return self.slide


def body_point(given: Arguments, name: str, value: object) -> tuple[str, str]:
    """The names of a body and of its point. Raises an error for a text without a dot, and for other objects."""
    if isinstance(value, str):
        body, _, point = value.partition(".")
        if not (body and point):
            raise given.error(f"{name} is {value!r}", allowed='a point of a body, like "rocker.E"')
        return body, point
    body, point = given.pair(name, value, 'a point of a body: "body.point", or (body, point)')
    return given.text(f"body of {name}", body), given.text(f"point of {name}", point)


def free_point(given: Arguments, name: str, value: object) -> tuple[str, str | complex]:
    """The names of a body and of its point, or a body and a position in its frame [m]."""
    if not isinstance(value, str):
        body, point = given.pair(name, value, 'a point of a body: "body.point", or (body, point)')
        if not isinstance(point, str):
            return given.text(f"body of {name}", body), given.point(name, point)
    return body_point(given, name, value)


def set_texts(value: object, *names: str) -> None:
    """Set fields of a record to the texts that they are given."""
    for name in names:
        text = getattr(value, name)
        if type(text) is not str:
            given = Arguments(f"a {type(value).__name__.lower()}", MechanismError)
            object.__setattr__(value, name, given.text(name, text))


def set_points(value: object, *names: str) -> None:
    """Set fields of a record to the bodies and points that they name; `on` may be a position."""
    given = Arguments(f"a {type(value).__name__.lower()}", MechanismError)
    for name in names:
        read = free_point if name == "on" else body_point
        object.__setattr__(value, name, read(given, name, getattr(value, name)))


@contextmanager
def about(*path: str) -> Iterator[None]:
    """Attribute errors without an entry of their own to this entry."""
    try:
        yield
    except MechanismError as error:
        error.about = error.about or path
        raise
