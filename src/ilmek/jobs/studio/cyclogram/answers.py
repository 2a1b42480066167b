"""What the studio shows of a cyclogram: tracks, relations and exclusions with their margins, checks, solutions."""

from dataclasses import dataclass, field

from ilmek.jobs.studio.checks import ShownCheck
from ilmek.records import JsonObject
from ilmek.timing.track import TrackEvent


@dataclass(frozen=True, slots=True)
class ShownMotionPart:
    """A motion of a track: master angles [rad], positions [SI], its law and the largest values of its derivatives."""

    name: str
    start: float
    end: float
    begin: float
    finish: float
    law: str
    law_label: str
    speed: float | None
    acceleration: float | None
    jerk: float | None


@dataclass(frozen=True, eq=False, slots=True)
class ShownTrack:
    """A track. SI; null where there is no limit, or where a peak is infinite.

    factor  SI value in `shown_unit` is value times this      locked  the solver leaves it as it is
    count   number of samples of its curves             low, high  least and greatest position
    """

    name: str
    actuator: str
    shown_unit: str
    factor: float
    revolves: float
    locked: bool
    limits: dict[str, float | None]
    motions: tuple[ShownMotionPart, ...]
    events: tuple[TrackEvent, ...]
    peaks: dict[str, float | None]
    low: float
    high: float
    count: int


@dataclass(frozen=True, slots=True)
class ShownMoment:
    """An instant: the track, "" for a fixed angle, and the master angle [rad]."""

    track: str
    angle: float
    label: str


@dataclass(frozen=True, slots=True)
class ShownRelation:
    """`then` comes at least `least` and at most `most` after `first` [rad].

    margin  to the nearer limit, below 0 where it does not hold      turns  `then` is that of so many turns later
    """

    label: str
    why: str
    first: ShownMoment
    then: ShownMoment
    turns: int
    gap: float
    least: float | None
    most: float | None
    margin: float
    ok: bool


@dataclass(frozen=True, eq=False, slots=True)
class ShownPresence:
    """A presence: the track, "" for fixed windows; its windows of the master angle [rad]; bounds of the zone [SI]."""

    track: str
    label: str
    windows: list[list[float]]
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class ShownExclusion:
    """Two presences that exclude each other: their least distance, the required gap and the margin [rad].

    overlaps  windows in which both are present
    """

    label: str
    why: str
    first: ShownPresence
    second: ShownPresence
    overlaps: list[list[float]]
    apart: float
    gap: float
    margin: float
    ok: bool


@dataclass(frozen=True, slots=True)
class CyclogramView:
    """A cyclogram; behind it the curves of each track as 32-bit floats, one part per track: angle [rad], position [SI],
    velocity, acceleration and jerk over time [SI/s, SI/s^2, SI/s^3], each `count` numbers. A jump has its angle twice.

    limits  of the actuators, each with the largest value of its track      laws  names of all motion laws
    """

    name: str
    period: float
    tracks: tuple[ShownTrack, ...]
    relations: tuple[ShownRelation, ...]
    exclusions: tuple[ShownExclusion, ...]
    limits: tuple[ShownCheck, ...]
    laws: tuple[str, ...]
    lengths: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class ShownBinding:
    """A constraint that limits a solution: in words, its kind, its effect in words.

    share  of a motion in the turn's requirement [1]      cost  relative growth of the goal per radian [1/rad]
    """

    label: str
    kind: str
    effect: str
    share: float | None
    cost: float


@dataclass(frozen=True, eq=False, slots=True)
class CyclogramSolution:
    """A solved cyclogram: the file's data with its new timing, and what limits it.

    goal  acceleration or period      measure, shown_unit  of before and after [SI]: description, unit
    """

    data: JsonObject
    goal: str
    measure: str
    shown_unit: str
    factor: float
    before: float
    after: float
    binding: tuple[ShownBinding, ...]


@dataclass(frozen=True, eq=False, slots=True)
class NamedCyclogram:
    """A cyclogram of a machine, as the data of a file."""

    name: str
    data: JsonObject
    text: str


@dataclass(frozen=True, slots=True)
class MachineCyclograms:
    """The cyclograms of a machine; without a machine, the machines that have some."""

    machines: tuple[str, ...]
    cyclograms: tuple[NamedCyclogram, ...] = field(default_factory=tuple)
