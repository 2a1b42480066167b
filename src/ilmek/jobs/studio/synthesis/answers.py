"""What the studio shows of a synthesis: its task, the four-bars found, and why others were left out."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class ShownPosition:
    """How a four-bar meets a position of its task; SI, null where it is not reached or not required.

    circuit  1 or 2, 0 where it is not reached      branch  +1, -1; 0 at a dead centre of the crank
    """

    crank_angle: float | None
    circuit: int
    branch: int
    point_error: float | None
    coupler_error: float | None
    rocker_error: float | None


@dataclass(frozen=True, eq=False, slots=True)
class ShownMerit:
    """Merit of a four-bar, 0 to 1, its terms, and its four factors, each from 0 to 1.

    terms        least transmission angle [rad]; size over the extent of the task, link ratio, sensitivity [1]
    factors      of the terms: the merit is the fourth root of their product
    point_shift  of the tracer [m], angle_shift of the coupler [rad]: greatest with links 0.1 mm off
    """

    value: float
    terms: dict[str, float]
    factors: dict[str, float]
    point_shift: float | None
    angle_shift: float | None


@dataclass(frozen=True, eq=False, slots=True)
class ShownMotion:
    """Positions of a four-bar in motion [m]: x and y of A, B and the tracer P in turn, one row per position.

    a, b, p  x, y, x, y, …; p is empty without a tracer
    closed   whether the motion goes on from its last position to the first; else it returns the same curve
    """

    a: list[float]
    b: list[float]
    p: list[float]
    closed: bool


@dataclass(frozen=True, eq=False, slots=True)
class GeneratedFunction:
    """A function as a four-bar generates it: rotation of the rocker required and generated, and the error [rad].

    extremes  x of the extremes of the error      drawn_at  x of the four-bar as drawn
    """

    x: list[float]
    required: list[float]
    generated: list[float]
    error: list[float]
    extremes: list[float]
    drawn_at: float


@dataclass(frozen=True, eq=False, slots=True)
class ShownFourBar:
    """A four-bar that does the task, as it is shown in the gallery; SI and radians.

    number      from 1, the best                     pins   a0, b0, a, b and tracer as drawn, [x, y]
    links       ground, crank, coupler, rocker       class_name  by Grashof
    circuits    number of circuits                   order  positions as the crank meets them, from 1
    transmission  least over the motion, or over the task where that is required
    curve       x, y, x, y, … of the whole curve of the tracer; empty without one
    apart       distance from the nearest better four-bar, in extents of the task
    made        how it was found                     active  limits without which it would come nearer
    """

    number: int
    pins: dict[str, list[float]]
    links: dict[str, float]
    class_name: str
    crank_turns: bool
    branch: int
    circuits: int
    positions: tuple[ShownPosition, ...]
    order: tuple[int, ...]
    in_order: bool
    transmission: float
    link_ratio: float
    size: float
    merit: ShownMerit | None
    error_max: float | None
    error_rms: float | None
    apart: float | None
    certified: bool
    made: str
    active: tuple[str, ...]
    motion: ShownMotion
    curve: list[float]
    function: GeneratedFunction | None = None


@dataclass(frozen=True, slots=True)
class LeftOutReason:
    """How many four-bars miss a limit; one may miss several."""

    name: str
    words: str
    count: int


@dataclass(frozen=True, eq=False, slots=True)
class LeftOutFourBar:
    """A four-bar that was left out: its pins as drawn [m], how it was found, and each reason as a sentence."""

    pins: dict[str, list[float]]
    made: str
    reasons: dict[str, str]


@dataclass(frozen=True, slots=True)
class LoosenedLimit:
    """A single limit that gives a four-bar if it is loosened.

    words  the whole sentence      name, value  the setting to change; empty where the sentence names none
    """

    words: str
    name: str = ""
    value: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class PivotCurves:
    """Where the pivots, and the pins at the first pose, of links through four poses lie: x, y, … of each part [m]."""

    pivots: tuple[list[float], ...]
    pins: tuple[list[float], ...]


@dataclass(frozen=True, eq=False, slots=True)
class SynthesisAnswer:
    """The four-bars for a task, the best first.

    quick     whether the search was short: the full one may find more, and better ones
    sieve     how many were found and kept, as a sentence
    found     number within all limits, `more` of them not listed
    required  of a function: x and the required rotation of the rocker [rad]
    jam       transmission angle below which a four-bar is left out as jammed [rad]
    """

    machine: str
    quick: bool
    sieve: str
    found: int
    more: int
    candidates: tuple[ShownFourBar, ...]
    left_out: tuple[LeftOutReason, ...]
    removed: tuple[LeftOutFourBar, ...]
    no_four_bar: tuple[str, ...]
    loosened: tuple[LoosenedLimit, ...]
    warnings: tuple[str, ...]
    points: list[list[float]] = field(default_factory=list)
    angles: list[float] = field(default_factory=list)
    required: list[list[float]] | None = None
    curves: PivotCurves | None = None
    jam: float = 0.0


@dataclass(frozen=True, eq=False, slots=True)
class MechanismDocument:
    """A mechanism file: its text, as `--to` writes it, and its data."""

    text: str
    data: dict[str, object]
