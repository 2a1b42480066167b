"""Four-bars that answer a task: those kept, the best first, those removed and why, and the one that is drawn."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ilmek.errors import ParameterError
from ilmek.report import Json
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.filters import REASONS, Filters, sift


@dataclass(frozen=True, slots=True, eq=False)
class FourBarOption:
    """A judged four-bar.

    made  how it came about, in words      more  what its method says of it besides, by the names of the JSON, SI
    """

    candidate: Candidate
    made: str
    more: Mapping[str, Json] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class FourBarSelection:
    """What became of all four-bars of a task.

    kept    without defects and within limits, the best first; `more` of them are not listed
    removed with the reason for each filter that it failed, in words
    other   what is no four-bar at all, in words
    chosen  index of the one that is drawn, None where none is kept
    """

    kept: tuple[FourBarOption, ...]
    more: int
    removed: tuple[tuple[FourBarOption, Mapping[str, str]], ...]
    other: tuple[str, ...]
    chosen: int | None

    @property
    def best(self) -> FourBarOption | None:
        """The one that is drawn."""
        return None if self.chosen is None else self.kept[self.chosen]

    @property
    def counts(self) -> dict[str, int]:
        """How many failed each filter; one may fail several."""
        failed = [name for _, reasons in self.removed for name in reasons]
        return {name: failed.count(name) for name in dict.fromkeys(failed)}

    @property
    def words(self) -> str:
        """How many there were, and for what they went."""
        kept = len(self.kept) + self.more
        total = kept + len(self.removed)
        said = ", ".join(f"{REASONS[name]} {count}" for name, count in self.counts.items())
        first = f"{total} four-bar{'' if total == 1 else 's'}: {kept} kept, {len(self.removed)} removed"
        return f"{first} ({said})" if said else first


def choose(
    options: Sequence[FourBarOption],
    filters: Filters,
    *,
    number: int,
    count: int,
    other: Sequence[str] = (),
    least: Callable[[FourBarOption], tuple[float, float]] | None = None,
) -> FourBarSelection:
    """The options sieved and ranked.

    number  of the one to draw, from 1      count  that are listed at most
    least  what ranks them, ascending; unsaid: the best transmission angle first
    Raises ParameterError where there are solutions, but fewer than `number`.
    """
    of = {id(one.candidate): one for one in options}
    sifted = sift([one.candidate for one in options], filters)
    kept = [of[id(candidate)] for candidate in sifted.kept]
    if least is not None:
        kept.sort(key=least)
    listed = tuple(kept[:count])
    if listed and number > len(listed):
        raise ParameterError(
            f"chosen={number}, and there are {len(listed)} solutions",
            allowed=f"1 to {len(listed)}",
            do="set count higher" if len(kept) >= number else "",
        )
    removed = tuple((of[id(one.candidate)], one.reasons) for one in sifted.removed)
    return FourBarSelection(listed, len(kept) - len(listed), removed, tuple(other), number - 1 if listed else None)
