"""What a kilim takes: weft of each colour, warp, mass, time and cost; and whether its slits are short enough."""

from dataclasses import replace

from ilmek.carpet.chart import Chart
from ilmek.carpet.ground import GroundParams, GroundYarn, warp_need
from ilmek.carpet.kilim import SLIT, KilimParams, KilimWork, Slit, is_too_long, kilim_work, slit_length, slits
from ilmek.elements.carpet_yarns import carpet_yarns
from ilmek.records import JsonObject, computed, record
from ilmek.report import Check, at_most
from ilmek.sentences import Sentence
from ilmek.units import format_quantity


@record
class KilimPrices:
    """Prices of a kilogram of each yarn and of the warp, None: not known; and the wage of a weaver [1/s]."""

    yarns: tuple[float | None, ...]
    warp: float | None
    wage: float


@record
class KilimCloth:
    """A chart as a kilim, with its work.

    slits     the longest first      deadline  for the whole carpet [s]; None: none
    """

    chart: Chart
    params: KilimParams
    ground: GroundParams
    prices: KilimPrices
    work: KilimWork
    slits: tuple[Slit, ...]
    deadline: float | None = None

    slit_length = computed("mm", "length of the longest slit of the design", lambda it: it.longest)
    slits_joined = computed("1", "slits that are too long to be open", lambda it: len(it.too_long))
    bobbins_per_row = computed("1", "most bobbins of a row, one for each run", lambda it: int(it.work.bobbins.max()))
    mean_bobbins = computed("1", "bobbins of a row, mean", lambda it: float(it.work.bobbins.mean()))
    picks_woven = computed("1", "picks of all runs", lambda it: it.work.picks)
    joins_woven = computed("1", "dovetails or interlocks of all picks", lambda it: it.work.joins)
    weft_length = computed("m", "weft of the whole carpet", lambda it: float(it.work.weft.sum()))
    weft_mass = computed("kg", "mass of the weft", lambda it: sum(it.masses))
    warp_mass = computed("kg", "mass of the warps, ends and loom waste included", lambda it: it.warp.mass)
    cloth_mass = computed("kg/m^2", "mass of the carpet over its area", lambda it: it.mass / it.area)
    kilim_time = computed("h", "time of one weaver", lambda it: it.work.time)

    @computed("", "weft of each colour, in the order of the list")
    def kilim_colours(self) -> list[JsonObject]:
        """Name, weft [m], mass [kg], price."""
        columns = zip(self.chart.yarns, self.work.weft.tolist(), self.masses, self.prices.yarns, strict=True)
        return [
            {"name": yarn.name, "yarn": length, "mass": mass, "price": None if price is None else price * mass}
            for yarn, length, mass, price in columns
            if mass
        ]

    @computed("", "cost of the carpet by cause; null: a price is not known")
    def kilim_cost(self) -> dict[str, float | None]:
        """Weft, warp, wage, and their sum."""
        colours: list[JsonObject] = self.kilim_colours
        wefts, warp = [row["price"] for row in colours], self.prices.warp
        weft = None if None in wefts else sum(wefts)
        parts = {
            "weft": weft,
            "warp": None if warp is None else warp * self.warp.mass,
            "wage": self.prices.wage * self.work.time,
        }
        known = [part for part in parts.values() if part is not None]
        return {**parts, "sum": sum(known) if len(known) == len(parts) else None}

    @property
    def checks(self) -> tuple[Check, ...]:
        """That no slit is open that is too long; and the time, where there is a deadline."""
        names = Sentence("check.kilim-slit"), Sentence("check.kilim-slit-source")
        found, limit = self.too_long, self.params.longest_slit
        if not found or self.params.join != SLIT:
            open_slits = [slit for slit in self.slits if slit not in set(found)]
            longest = slit_length(open_slits[0], self.params) if open_slits else 0.0
            slit_check = at_most(names[0], longest, limit, "mm", names[1])
        else:
            where = "; ".join(map(str, found[:_NAMED])) + (f"; … ({len(found)})" if len(found) > _NAMED else "")
            cure = Sentence("check.kilim-slit-cure", places=where)
            slit_check = at_most(names[0], self.longest, limit, "mm", names[1]).with_cure(cure)
        if self.deadline is None:
            return (slit_check,)
        cure = Sentence("check.kilim-time-cure")
        in_time = at_most(Sentence("check.kilim-time"), self.work.time, self.deadline, "h", Sentence("check.kilim-one"))
        return slit_check, in_time.with_cure(cure)

    @property
    def longest(self) -> float:
        """Length of the longest slit of the design [m]."""
        return slit_length(self.slits[0], self.params) if self.slits else 0.0

    @property
    def too_long(self) -> tuple[Slit, ...]:
        """The slits that may not be open."""
        return tuple(slit for slit in self.slits if is_too_long(slit, self.params))

    @property
    def masses(self) -> list[float]:
        """Mass of the weft of each yarn [kg]."""
        masses: list[float] = (self.work.weft * self.params.yarn_density).tolist()
        return masses

    @property
    def warp(self) -> GroundYarn:
        """The warps: those of the cells, none beside them."""
        yarn = carpet_yarns(self.ground.yarns, 1 / self.params.warps).warp
        return warp_need(self.chart.columns, self.chart.size.length, yarn, replace(self.ground, selvedge_warps=0))

    @property
    def mass(self) -> float:
        """Mass of the carpet [kg], without the waste of the loom and what is cut away outside of the shape."""
        return sum(self.masses) + self.warp.kept * self.warp.mass * self.area / self.chart.size.area

    @property
    def area(self) -> float:
        """Area of the cells that are woven [m²]."""
        return self.chart.size.area * self.chart.tied.total / self.chart.knots.size

    @property
    def in_words(self) -> str:
        """Size, warps, picks and joins."""
        params = self.params
        warps, picks = (format_quantity(count, "1/dm") for count in (params.warps, params.picks))
        return f"{self.chart.size}, {warps} warps, {picks} picks, {params.step} a row; {params.join}"


_NAMED = 3
"""Slits that a check names, the longest."""


def kilim_cloth(
    chart: Chart, params: KilimParams, ground: GroundParams, prices: KilimPrices, deadline: float | None = None
) -> KilimCloth:
    """The kilim of a chart at the quality of the parameters."""
    work = kilim_work(chart.knots, len(chart.yarns), params, ground)
    return KilimCloth(chart, params, ground, prices, work, slits(chart.knots), deadline)
