"""A carpet on a tufting gun: time, yarn, cost, and whether gun and gantry make it.

    t = L / v + sum over stops |turn| / w + n lift + sum over travels t(d) + c change
    t(d) = d / v' + v' / a,   2 sqrt(d / a) where v' is not reached
    yarn of a colour = L / s (2 (h + t) + s) + 2 waste n

L length of n strokes, v feed, w turning speed, v' travel speed, a acceleration, c colours, s stitch, h pile, t backing.
A yarn in piles of two heights counts as two colours: the gun is set between them.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.machines.tufting_gun.params import LOWEST, TALLEST, TuftingGunParams
from ilmek.records import JsonObject, computed, record, result
from ilmek.report import Check, at_least, at_most
from ilmek.units import format_quantity
from ilmek.weaving.gun.plan import ColourPlan, GunPlan
from ilmek.weaving.tufts import Cone, tuft_yarn

Points = Complex[np.ndarray, " points"]


def travel_time(distance: FloatArray, speed: float, acceleration: float) -> FloatArray:
    """Time from rest to rest [s].

    >>> travel_time(np.array([0.0, 0.5, 2.0]), 1.0, 2.0).tolist()
    [0.0, 1.0, 2.5]
    """
    reached = distance >= speed**2 / acceleration
    return np.where(reached, distance / speed + speed / acceleration, 2 * np.sqrt(distance / acceleration))


def headings(stroke: Points) -> Float[np.ndarray, " pieces"]:
    """Direction of each piece of a stroke, without jumps of a whole turn [rad]."""
    return np.unwrap(np.angle(np.diff(stroke)))


@record
class TuftedByGun:
    """A plan on a gun and gantry.

    cones  by the label of each colour                  yarn      of each colour [m], by its label
    heights  of the pile of each label [m]
    clock  beginning and end of each stroke, and the end of the carpet [s]
    """

    params: TuftingGunParams
    plan: GunPlan
    cones: tuple[Cone, ...]
    heights: tuple[float, ...]
    yarn_per_stitch: float = result("mm", "yarn of a stitch: both legs and the back stitch")
    yarn: Mapping[int, float]
    clock: Float[np.ndarray, " moments"]
    deadline: float | None

    row_length = computed("m", "length of outlines and rows", lambda it: it.plan.tufted)
    row_bound = computed("m", "least length of strokes with these outlines", lambda it: it.plan.least_tufted)
    travel = computed("m", "travel with the gun lifted", lambda it: it.plan.travel)
    travel_bound = computed("m", "least travel of any order of the strokes", lambda it: it.plan.least_travel)
    strokes = computed("1", "strokes: the gun is set down and lifted once for each", lambda it: it.plan.strokes)
    coverage = computed("%", "least covered share of a region", lambda it: it.plan.coverage)
    covered = computed("%", "covered share of the carpet", lambda it: it.plan.covered)
    detail_changed = computed("%", "share of the picture finer than the smallest feature", lambda it: it.plan.changed)
    stitches = computed("1", "stitches", lambda it: round(it.plan.tufted / it.params.stitch))
    gun_yarn = computed("m", "yarn, with what is cut off at the strokes' ends", lambda it: sum(it.yarn.values()))
    gun_yarn_mass = computed("kg", "its mass", lambda it: sum(it.yarn.values()) * it.params.yarn_density)
    tufting_time = computed("h", "time on the gantry, changes of colour included", lambda it: float(it.clock[-1]))

    @computed("", "yarn, strokes and time of each colour, in their order")
    def gun_colours(self) -> list[JsonObject]:
        """Name, strokes, length of rows and of yarn [m], mass [kg], price."""
        return [
            {
                "name": self.cones[colour.label].name,
                "strokes": len(colour.strokes),
                "rows": colour.length,
                "yarn": self.yarn[colour.label],
                "mass": self.yarn[colour.label] * self.params.yarn_density,
                "price": self._price(colour),
            }
            for colour in self.plan.colours
        ]

    @computed("", "cost by cause [EUR]; null: no price is known")
    def gun_cost(self) -> JsonObject:
        """Yarn, backing, machine, person and their sum."""
        prices = [self._price(colour) for colour in self.plan.colours]
        known = [price for price in prices if price is not None]
        time, params = self.clock[-1], self.params
        causes = {
            "yarn": sum(known) if len(known) == len(prices) else None,
            "backing": params.backing_price * self.plan.width * self.plan.length,
            "machine": params.machine_rate * time,
            "person": params.wage * params.attendance * time,
        }
        known = [cost for cost in causes.values() if cost is not None]
        return {**causes, "sum": sum(known) if len(known) == len(causes) else None}

    def _price(self, colour: ColourPlan) -> float | None:
        return self.cones[colour.label].price_of(self.yarn[colour.label] * self.params.yarn_density)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Coverage, detail, colours, piles, gantry, deadline."""
        params, plan = self.params, self.plan
        yarns = {self.cones[own.label].colour for own in plan.colours}
        piles = "set heights of the pile from {} to {}".format(
            *(format_quantity(side, "mm") for side in (LOWEST, TALLEST))
        )
        lost = ", ".join(self.cones[label].name for label in plan.lost)
        finer = "set a smaller row_spacing or smallest, take fewer colours, or a larger carpet"
        bed = "set a larger room_width or room_length, or turn the picture, or take a smaller carpet"
        checks = (
            at_least("coverage of each region", plan.coverage, params.least_coverage, "%", "least_coverage").with_cure(
                finer
            ),
            at_least("coverage of the carpet", plan.covered, params.least_covered, "%", "least_covered").with_cure(
                finer
            ),
            at_most("rows beyond the border", plan.beyond, 1 - params.least_coverage, "%", "least_coverage").with_cure(
                finer
            ),
            at_most("detail finer than the gun", plan.changed, params.most_lost, "%", "most_lost").with_cure(finer),
            at_most("colours without a row", len(plan.lost), 0, "1", lost or "every colour has one").with_cure(finer),
            at_most("colours on the creel", len(yarns), params.cones, "1", "cones").with_cure(
                f"take at most {params.cones} colours, or set more cones"
            ),
            at_least("lowest pile", min(self.heights), LOWEST, "mm", "the gun").with_cure(piles),
            at_most("highest pile", max(self.heights), TALLEST, "mm", "the gun").with_cure(piles),
            at_most("width on the gantry", plan.width, params.room_width, "mm", "room_width").with_cure(bed),
            at_most("length on the gantry", plan.length, params.room_length, "mm", "room_length").with_cure(bed),
        )
        if self.deadline is None:
            return checks
        late = "set a higher stitch_rate, a longer stitch or a larger row_spacing"
        return (
            *checks,
            at_most("tufting time", float(self.clock[-1]), self.deadline, "h", "deadline").with_cure(late),
        )


def tufted_by_gun(
    params: TuftingGunParams,
    plan: GunPlan,
    cones: tuple[Cone, ...],
    heights: tuple[float, ...] = (),
    deadline: float | None = None,
) -> TuftedByGun:
    """A plan on a gun and gantry.

    heights  of the pile by label [m]; default: pile_height for all      deadline  for the whole carpet [s]
    """
    heights = heights or (params.pile_height,) * len(cones)
    piles = np.array([params.pile_height, *heights])
    usual, *of_stitch = np.asarray(tuft_yarn(piles, params.backing_thickness, params.stitch)).tolist()
    yarn = {
        colour.label: colour.length * of_stitch[colour.label] / params.stitch + 2 * params.waste * len(colour.strokes)
        for colour in plan.colours
    }
    return TuftedByGun(params, plan, cones, heights, usual, yarn, np.cumsum([*_spans(params, plan)]), deadline)


def _spans(params: TuftingGunParams, plan: GunPlan) -> Iterator[float]:
    """Time to each stroke and of it, in turn, and of the way back [s]."""
    here = 0j

    def travel(to: complex) -> float:
        return float(travel_time(np.asarray(abs(to - here)), params.travel_speed, params.acceleration))

    for colour in plan.colours:
        wait = params.change_time
        for stroke in colour.strokes:
            yield wait + travel(complex(stroke[0])) + params.lift_time
            turns = np.abs(np.diff(headings(stroke)))
            stops = turns[turns > params.corner]
            starts = (len(stops) + 1) * params.feed / params.acceleration
            length = float(np.abs(np.diff(stroke)).sum())
            yield length / params.feed + float(stops.sum()) / params.turning_speed + starts
            here, wait = complex(stroke[-1]), 0.0
    yield travel(0j)
