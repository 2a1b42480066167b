"""Selection of the four-bars found for a task: filtered, ranked, one of them drawn; the removed ones with reasons."""

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ilmek.errors import ParameterError
from ilmek.params import declared, kind
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.filters import JAM, REASONS, Filters, defects
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.merit import Merit, merit
from ilmek.units import format_quantity

OF_POSITIONS = ("crank_angle", "circuit", "point_error", "coupler_error", "rocker_error")
"""Quantities of each position that a solution lists; None where the task has none, or it is not reached."""

NEAR_EQUAL = 1.0005
"""Ratio of errors up to which the merit decides: 0.1 % of their squares."""

PINS = ("a0", "b0", "a", "b", "tracer")

NAMED = (
    "the best first, SI and radians: ground, crank, coupler, rocker; pins a0, b0, a, b and tracer as drawn at the "
    "first position, tracer_on_coupler (x from A to B); branch; grashof, crank_turns; of each position crank_angles, "
    "circuits, branches and errors; order; transmission [least, greatest], transmission_min; link_ratio; size"
)


def ratio_limit(default: float | None) -> Any:
    """Declare the filter `link_ratio_max` [1] with another default."""
    return field(default=default, metadata=Filters.__dataclass_fields__["link_ratio_max"].metadata)


@dataclass(frozen=True, slots=True)
class FourBarTaskParams(Filters):
    """Parameters of every machine that synthesises four-bars: its filters, and which solutions are listed and drawn."""

    link_ratio_max: float | None = ratio_limit(10.0)
    count: int = kind.count(5, at_least=1, at_most=100, doc="solutions that are listed at most")
    chosen: int = kind.count(
        1, at_least=1, at_most=1000, doc="number of the solution that is drawn and moved, from 1, the best"
    )
    link_width: float | None = kind.length(
        None, above=0.0, doc="width of the links' plates; default: a fifth of the shortest link, 6 to 40 mm"
    )
    link_thickness: float | None = kind.length(
        None, above=0.0, doc="their thickness; default: a third of the width, at least 3 mm"
    )

    def filters(self) -> Filters:
        """The filters alone."""
        return Filters(**{one.name: getattr(self, one.name) for one in declared(Filters)})


CANDIDATES = (
    "the solutions with merit and proof: as in solutions, and merit, its terms (transmission, size over the extent of "
    "the task, ratio, sensitivity), point_shift and angle_shift of links 0.1 mm off, apart: distance from the nearest "
    "better one in extents of the task (null: not computed), certified: whether it is proven to do the task exactly"
)


@record
class FourBarOption:
    """A four-bar with its check.

    made       how it was found      details  results of its method, by the names of the JSON [SI]
    certified  whether it is proven that it does its task exactly (within 1e-9 of the task's size)
    apart      distance from the nearest better answer, in extents of the task; NaN: not computed
    merit      its merit; None: not computed
    """

    candidate: Candidate
    made: str
    details: Mapping[str, Json] = field(default_factory=dict)
    certified: bool = False
    apart: float = math.nan
    merit: Merit | None = None

    def as_json(self) -> dict[str, Json]:
        """The solution, SI and radians: see NAMED."""
        one, positions = self.candidate, self.candidate.positions
        return {
            **dimensions(one.four_bar),
            "crank_turns": one.crank_turns,
            "branches": [position.branch for position in positions],
            **{f"{name}s": [_or_none(getattr(position, name)) for position in positions] for name in OF_POSITIONS},
            "order": one.order,
            "transmission": one.transmission,
            "transmission_min": one.least_transmission,
            "link_ratio": one.link_ratio,
            "size": one.size,
            "made": self.made,
            **self.details,
        }

    def with_merit(self) -> dict[str, Json]:
        """The solution with its merit and proof: see CANDIDATES."""
        return {
            **self.as_json(),
            **({} if self.merit is None else self.merit.as_json()),
            "apart": self.apart if math.isfinite(self.apart) else None,
            "certified": self.certified,
        }

    def removed_as_json(self, reasons: Mapping[str, str]) -> dict[str, Json]:
        """A removed four-bar: links, pins, how it was found, reasons by filter."""
        four_bar = self.candidate.four_bar
        pins = {name: getattr(four_bar, name) for name in PINS}
        return {**four_bar.lengths._asdict(), **pins, "made": self.made, "reasons": reasons}


def _or_none(value: float) -> float | None:
    return None if math.isnan(value) else value


def dimensions(four_bar: FourBar) -> dict[str, Json]:
    """Links [m], pins and tracer as drawn [m], branch and Grashof type of a four-bar, by the names of the JSON."""
    pins = {name: getattr(four_bar, name) for name in (*PINS, "tracer_on_coupler")}
    return {**four_bar.lengths._asdict(), **pins, "branch": four_bar.branch, "grashof": four_bar.grashof.kind}


def of_best(unit: str, doc: str, value: Callable[[Candidate], Any]) -> Any:
    """Declare a result of the solution that is drawn, of a record with `best`; left out where there is none."""
    return computed(unit, doc, lambda it: None if it.best is None else value(it.best.candidate), optional=True)


def detail_of_best(unit: str, doc: str, name: str) -> Any:
    """Declare a result that the method of synthesis reports of the solution that is drawn, by its name in `details`."""
    return computed(unit, doc, lambda it: None if it.best is None else it.best.details.get(name), optional=True)


def solutions(extra: str = "") -> Any:
    """Declare the list of all solutions of a `FourBarDesign`; extra: names of what its method reports besides."""
    doc = f"{NAMED}; {extra}" if extra else NAMED
    return computed("", doc, lambda it: [one.as_json() for one in it.choice.kept], shown=False)


@record
class SearchedFamily:
    """A family of four-bars: how many were searched, how many keep all limits, how many miss each limit."""

    searched: int
    found: int
    left_out: Mapping[str, int]


@record
class FourBarSelection:
    """The four-bars found for a task, filtered and ranked.

    kept     without defects and within the limits, the best first
    more     number of further ones that are not listed
    removed  with the reason for each filter that they failed
    other    descriptions of degenerate solutions
    number   of the one that is drawn, from 1; None where none is kept
    family   of a search of a family: what was searched; None where all four-bars were judged
    cures    single limits that give a four-bar if they are loosened, as sentences; () where there is one
    """

    kept: tuple[FourBarOption, ...]
    more: int
    removed: tuple[tuple[FourBarOption, Mapping[str, str]], ...]
    other: tuple[str, ...]
    number: int | None
    family: SearchedFamily | None = None
    cures: tuple[str, ...] = ()

    @property
    def best(self) -> FourBarOption | None:
        """The one that is drawn."""
        return None if self.number is None else self.kept[self.number - 1]

    @computed("", "how many four-bars were found, kept and removed")
    def sieve(self) -> str:
        if self.family is not None:
            return f"{self.family.searched} four-bars searched: {self.family.found} within all limits{self._jammed}"
        kept = len(self.kept) + self.more
        total = kept + len(self.removed)
        first = f"{total} four-bar{'' if total == 1 else 's'}: {kept} kept, {len(self.removed)} removed"
        return f"{first} ({self.reasons})" if self.removed else first

    @property
    def _jammed(self) -> str:
        """How many of a family were left out because they jam, as the end of a sentence."""
        count = self.left_out.get("transmits", 0)
        limit = format_quantity(JAM, "deg")
        return f"; left out: {count} whose least transmission angle is below {limit}" if count else ""

    @property
    def reasons(self) -> str:
        """The filters that four-bars failed, with the number of each, the greatest first."""
        ordered = sorted(self.left_out.items(), key=lambda one: -one[1])
        return ", ".join(f"{REASONS[name]} {count}" for name, count in ordered)

    found = computed(
        "",
        "four-bars that do the task within all limits; of a family those among the pairs of links that were searched",
        lambda it: len(it.kept) + it.more if it.family is None else it.family.found,
    )
    left_out = computed(
        "",
        "how many miss each limit; one may miss several",
        lambda it: dict(it.counts) if it.family is None else dict(it.family.left_out),
        shown=False,
    )
    candidates = computed("", CANDIDATES, lambda it: [one.with_merit() for one in it.kept], shown=False)
    loosened = computed(
        "",
        "without a solution: single limits that give one if they are loosened, and how far",
        lambda it: list(it.cures) or None,
        shown=False,
        optional=True,
    )

    ground = of_best("mm", "of the solution that is drawn: A0 to B0", lambda one: one.four_bar.lengths.ground)
    crank = of_best("mm", "A0 to A, driven", lambda one: one.four_bar.lengths.crank)
    coupler = of_best("mm", "A to B", lambda one: one.four_bar.lengths.coupler)
    rocker = of_best("mm", "B0 to B", lambda one: one.four_bar.lengths.rocker)
    grashof = of_best("", "class of the four-bar", lambda one: one.grashof.kind)
    transmission_min = of_best("deg", "least angle between coupler and rocker", lambda one: one.least_transmission)
    size = of_best("mm", "greatest extent over its motion", lambda one: one.size)
    chosen = computed("", "number of the solution that is drawn, from 1", lambda it: it.number, absent="no solution")
    removed_four_bars = computed(
        "",
        "four-bars that were removed: links, how they were found, reasons by filter",
        lambda it: [one.removed_as_json(reasons) for one, reasons in it.removed],
        name="removed",
        shown=False,
    )
    counts = computed(
        "",
        "how many failed each filter; one may fail several",
        lambda it: Counter(name for _, reasons in it.removed for name in reasons),
        name="removed_counts",
        shown=False,
    )
    no_four_bar = computed("", "what was found and is no four-bar", lambda it: it.other)


@record
class FourBarDesign:
    """Base of the designs of machines that synthesise four-bars."""

    choice: FourBarSelection
    params: FourBarTaskParams

    @property
    def best(self) -> FourBarOption | None:
        """The solution that is drawn."""
        return self.choice.best


def choose(
    options: Sequence[FourBarOption],
    other: Sequence[str],
    params: FourBarTaskParams,
    *,
    filters: Filters | None = None,
    breaches: Callable[[Candidate], Mapping[str, str]] | None = None,
    task_only: bool = False,
    rank: Callable[[FourBarOption], Any] | None = None,
) -> FourBarSelection:
    """The options filtered and ranked.

    options  four-bars found
    other    descriptions of degenerate solutions
    filters  default: those of the parameters
    breaches  a candidate's defects -> reasons; default: `filters.defects` by the filters
    task_only  see `merit`
    rank     sort key, ascending; default: the best merit first

    Raises ParameterError where there are solutions, but fewer than `params.chosen`.
    """
    required = filters or params.filters()
    judged = [
        (option, breaches(option.candidate) if breaches else defects(option.candidate, required)) for option in options
    ]
    good = [one for one, reasons in judged if not reasons]
    if rank is None:
        good = [with_merit(one, task_only=task_only) for one in good]
    kept = sorted(good, key=rank or best_first)
    listed = tuple(with_merit(one, task_only=task_only) for one in kept[: params.count])
    if listed and params.chosen > len(listed):
        raise ParameterError(
            f"chosen={params.chosen}, and there are {len(listed)} solutions",
            allowed=f"1 to {len(listed)}",
            do="set count higher" if len(kept) >= params.chosen else "",
        )
    removed = tuple((one, reasons) for one, reasons in judged if reasons)
    number = params.chosen if listed else None
    return FourBarSelection(listed, len(kept) - len(listed), removed, tuple(other), number)


def ranked_by_error(
    options: Sequence[FourBarOption],
    error: Callable[[FourBarOption], float],
    *,
    zero: float = 0.0,
    tolerated: bool = False,
) -> list[FourBarOption]:
    """Options with their merit, the least error first; equal errors by merit.

    zero       error that counts as none: those up to it are equal
    tolerated  whether all errors are equal, since each is within a limit that is given

    Errors within `NEAR_EQUAL` of the least of a group are equal.
    """
    groups: list[list[FourBarOption]] = []
    for one in sorted((with_merit(option) if option.candidate.reached else option for option in options), key=error):
        if groups and (tolerated or error(one) <= max(zero, NEAR_EQUAL * error(groups[-1][0]))):
            groups[-1].append(one)
        else:
            groups.append([one])
    return [one for group in groups for one in sorted(group, key=best_first)]


def single_cures(removed: Sequence[tuple[FourBarOption, Mapping[str, str]]]) -> tuple[str, ...]:
    """For each limit that alone removed four-bars: how many, and why the nearest of them."""
    alone: dict[str, list[tuple[float, str]]] = {}
    for at, (option, reasons) in enumerate(removed):
        if len(reasons) == 1:
            ((name, words),) = reasons.items()
            one = option.candidate
            order = {"size": one.size, "link_ratio": one.link_ratio, "transmission": -one.least_transmission}
            alone.setdefault(name, []).append((order.get(name, float(at)), words))
    return tuple(f"{name} alone removed {len(those)}, the nearest: {min(those)[1]}" for name, those in alone.items())


def with_merit(one: FourBarOption, *, task_only: bool = False) -> FourBarOption:
    """An option with its merit."""
    return one if one.merit is not None else replace(one, merit=merit(one.candidate, task_only=task_only))


def best_first(one: FourBarOption) -> float:
    """Minus the merit; 0 where it has none."""
    value = one.merit.value if one.merit is not None else math.nan
    return 0.0 if math.isnan(value) else -value


def finite(value: Json) -> float:
    """A number of `details` for a table; NaN for anything else."""
    return value if isinstance(value, float) else math.nan
