"""What was looked at in the choice of a loom: the finite choices that are open, their bounds, and what was lost why."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.params import AUTO, TIME, AutomatedLoomParams
from ilmek.machines.weaver_hands import HAND
from ilmek.records import record
from ilmek.report import Check, Choice, Json
from ilmek.report.choice import failing
from ilmek.units import format_number, format_quantity

_SAME = 1e-9


@dataclass(frozen=True, slots=True)
class LoomOffer:
    """Finite choices of a loom, and the least that it has: weaving time [s], price of its parts, value of the aim.

    cycle  time of a knot [s]      heads  number of heads, or of weavers
    """

    knotting: str
    cycle: float
    weft: str
    beat: str
    heads: int
    time: float
    price: float
    value: float

    def of(self, params: AutomatedLoomParams) -> AutomatedLoomParams:
        """The parameters with these choices."""
        kinds = replace(params, knotting=self.knotting, weft=self.weft, beat=self.beat)
        if self.knotting == HAND:
            return replace(kinds, weavers=self.heads)
        return replace(kinds, knot_cycle=self.cycle, heads=self.heads)

    @property
    def key(self) -> tuple[object, ...]:
        """The choices alone."""
        return self.knotting, self.cycle, self.weft, self.beat, self.heads

    @property
    def names(self) -> Mapping[str, str]:
        """The choices as texts, by the names of their parameters."""
        kinds = {"beat": self.beat, "knotting": self.knotting}
        if self.knotting == HAND:
            return {**kinds, "weft": self.weft}
        cycle = format_quantity(self.cycle, "s")
        return {**kinds, "knot_cycle": cycle, "weft": self.weft, "heads": str(self.heads)}


@record
class LoomSearch:
    """The search of a loom.

    params  as given        offers  all that can be chosen        costs  of a carpet on each loom that was designed
    lost    offers that were refused, each with its heaviest check, the better ones first
    chosen  the offer of the loom      value  that its loom has
    slack   share by which bounds allow frame and equipment to be cheaper with more heads, or quicker knots
    rival   the best of all others: its loom has the value, or no loom of it can have less where `rival_designed` is not
    """

    params: AutomatedLoomParams
    offers: tuple[LoomOffer, ...]
    costs: tuple[tuple[LoomOffer, CarpetCost], ...]
    lost: tuple[tuple[LoomOffer, Check], ...]
    chosen: LoomOffer
    value: float
    slack: float
    rival: LoomOffer | None = None
    rival_value: float = field(default=float("nan"))
    rival_designed: bool = False

    @property
    def others(self) -> tuple[tuple[LoomOffer, CarpetCost], ...]:
        """The other looms that were designed and not refused, with the cost of a carpet, the least first."""
        refused = {self.chosen.key, *(offer.key for offer, _ in self.lost)}
        good = (cost for cost in self.costs if cost[0].key not in refused)
        return tuple(sorted(good, key=lambda one: float(one[1].cost_per_carpet)))

    @property
    def open(self) -> tuple[str, ...]:
        """Names of the parameters that were left open, and have more than one value among the offers."""
        return tuple(name for name in self.chosen.names if len({offer.names[name] for offer in self.offers}) > 1)

    def label(self, offer: LoomOffer) -> str:
        """An offer as a text: what was open."""
        return ", ".join(f"{name}={offer.names[name]}" for name in self.open)

    def unlike(self, offer: LoomOffer) -> str:
        """An offer as a text: what it has that the chosen one has not."""
        own = self.chosen.names
        return ", ".join(f"{name}={value}" for name, value in offer.names.items() if value != own[name])

    @property
    def choices(self) -> tuple[Choice, ...]:
        """The choice of each parameter that was left open."""
        given = self.params
        left = {"beat": given.beat == AUTO, "knotting": given.knotting == AUTO, "heads": given.heads is None}
        left |= {name: name in self.open for name in ("knot_cycle", "weft")}
        return tuple(self._choice(name) for name in self.chosen.names if left[name])

    def _choice(self, name: str) -> Choice:
        chosen = self.chosen.names[name]
        better = [(offer, check) for offer, check in self.lost if offer.names[name] != chosen]
        if better:
            offer, check = better[-1]
            return Choice(name, chosen, check.name, offer.names[name], failing(check))
        return Choice(name, chosen, self.params.aim)

    def as_json(self) -> Json:
        """Bound of all looms that were not designed, the chosen one, the runner-up and why it lost."""
        found: dict[str, Json] = {"aim": self.params.aim, "looms": len(self.offers), "designed": len(self.costs)}
        found |= {"chosen": self.label(self.chosen), "value": self.value}
        if self.rival is None:
            return found
        if self.lost:
            offer, check = self.lost[0]
            found |= {"refused": self.label(offer), "refused_for": f"{check.name}: {failing(check)}"}
        found |= {"bound": self.rival_value, "slack": self.slack}
        return {**found, "runner_up": self.label(self.rival), "why": self.why}

    @property
    def why(self) -> str:
        """Why the runner-up lost."""
        more = self.rival_value - self.value
        if more <= _SAME * self.value:
            return f"the same {self.params.aim}, dearer" if self.params.aim == TIME else f"the same {self.params.aim}"
        shown = format_quantity(more, "h", 3) if self.params.aim == TIME else format_number(more, 3)
        return f"{self.params.aim}: {'' if self.rival_designed else 'at least '}{shown} more"


@dataclass(slots=True, eq=False)
class SearchJournal:
    """What a search leaves to the looms that it designs: they are made before it ends."""

    search: LoomSearch | None = None
