"""Results of a simulated carpet: utilisation, losses, overall equipment effectiveness, yarn, and bands over many runs.

    OEE          = availability * performance * quality
    availability = (time - planned stops - standstill for the operator) / (dressing + time + doffing)
    performance  = (ideal time of all attempts) / (that numerator)
    quality      = knots / attempts

The ideal time of an attempt is that of a carpet of knots alone, shared evenly by the heads, and of the wefts and beats,
over its knots. S. Nakajima, Introduction to TPM, 1988; ISO 22400-2:2014 has the same product, divided by the planned
busy time. A missed knot is tied again, so that quality is that of the first attempts.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.loom.operations import LoomSetup
from ilmek.loom.twin.carpet_run import USES, CarpetRun
from ilmek.loom.twin.durations import durations_of, ns
from ilmek.loom.twin.faults import CAUSES, StopParams
from ilmek.loom.twin.kernel import ALL_CALLS, COUNTS, FAILED, STOPPED, TIME, WORK
from ilmek.loom.twin.packages import PackageUse
from ilmek.records import JsonObject, computed, record
from ilmek.report import Json
from ilmek.units import BILLION, hour

CURES: Mapping[str, str] = {
    "tying": "more heads, or a shorter cycle of a knot",
    "changing": "quicker tubes, fewer colours, or neighbouring knots of one colour",
    "travelling": "a quicker carriage, or heads that sweep",
    "waiting": "rows that are shared more evenly: the slowest head of each phase sets the time",
    "row_ends": "quicker wefts, beats and take-up",
    "planned": "longer packages and bobbins, or quicker changes",
    "retrying": "grippers and yarn that fail less often",
    "stopped": "fewer faults, an operator who comes sooner, or heads that go on meanwhile",
}
"""What would shorten each use of a head's time."""

WORDS: Mapping[str, str] = {
    "tying": "tying knots",
    "changing": "colour changes",
    "travelling": "travel",
    "retrying": "further attempts",
    "stopped": "waiting for the operator",
    "waiting": "waiting for slower heads",
    "row_ends": "wefts, beats and take-up",
    "planned": "planned stops",
}
"""Each use in words."""

LOW, HIGH = 0.05, 0.95
"""Shares of runs at the ends of a band."""


def seconds(nanoseconds: float) -> float:
    """A time in seconds."""
    return float(nanoseconds) / BILLION


def calendar_time(time: float, params: StopParams) -> float:
    """Time of the calendar [s] in which a working time passes, from the begin of the first shift of a week.

    >>> calendar_time(20 * 3600.0, StopParams(hours=8 * 3600.0)) / 3600
    52.0
    """
    day, week = params.hours, params.hours * params.days
    weeks, rest = divmod(time, week)
    if rest == 0 and weeks:
        weeks, rest = weeks - 1, week
    days = min(math.ceil(rest / day) - 1, params.days - 1) if rest else 0
    return weeks * 168 * hour + days * 24 * hour + rest - days * day


@record
class Effectiveness:
    """Overall equipment effectiveness, of one run or arrays of many."""

    availability: Any
    performance: Any
    quality: Any

    @property
    def oee(self) -> Any:
        """Overall equipment effectiveness [-]."""
        return self.availability * self.performance * self.quality


def effectiveness(sums: IntArray, planned: int, setup: LoomSetup, params: StopParams) -> Effectiveness:
    """The effectiveness of runs.

    sums  (..., SUM_COLUMNS), as of `ilmek.loom.twin.kernel`      planned  time of the planned stops [ns]
    """
    durations = durations_of(setup.times)
    ideal = setup.knots * durations.knot / setup.heads + setup.rows * durations.row_end
    time, attempts = sums[..., TIME].astype(float), setup.knots + sums[..., FAILED]
    ran = time - planned - sums[..., STOPPED]
    busy = time + ns(params.dressing) + ns(params.doffing)
    return Effectiveness(ran / busy, ideal * attempts / setup.knots / ran, setup.knots / attempts)


@record
class Band:
    """Mean, median and band of a number over many runs, by order: the least value that a share of runs does not exceed.

    >>> Band(np.arange(1.0, 101.0)).as_json()["p95"]
    95.0
    """

    values: FloatArray

    def at(self, share: float) -> float:
        """The least value that a share of the runs does not exceed."""
        ordered = np.sort(self.values)
        return float(ordered[max(0, math.ceil(share * len(ordered) - 1e-9) - 1)])

    def as_json(self) -> dict[str, float]:
        """The band as plain data."""
        return {
            "mean": float(np.sort(self.values).mean()),
            "median": self.at(0.5),
            "p05": self.at(LOW),
            "p95": self.at(HIGH),
            "least": float(self.values.min()),
            "most": float(self.values.max()),
        }


@record
class CarpetStatistics:
    """A run, its loom and stops, and the sums of the runs of many seeds."""

    run: CarpetRun
    setup: LoomSetup
    params: StopParams
    seeds: IntArray

    @property
    def planned(self) -> int:
        """Time of the planned stops [ns]."""
        return int(self.run.rows[:, 3].sum())

    @property
    def by_head(self) -> FloatArray:
        """Time of each head by use [s], (heads, uses)."""
        return np.asarray(self.run.uses.sum(axis=0) / BILLION)

    @property
    def one(self) -> Effectiveness:
        """The effectiveness of the run."""
        return effectiveness(self.run.sums, self.planned, self.setup, self.params)

    time = computed(
        "h", "weaving time of the run with its seed: first knot to end of the last row", lambda it: seconds(it.run.time)
    )
    knots = computed("1", "knots tied", lambda it: it.run.knots)
    digest = computed("", "SHA-256 of all events: the same on every machine", lambda it: it.run.digest)
    utilisation = computed(
        "%", "mean share of the weaving time in which a head ties", lambda it: float(it.by_head[:, 0].mean() / it.time)
    )
    time_without_faults = computed("h", "weaving time without faults", lambda it: seconds(it.run.base))
    order_time = computed(
        "h", "working time with dressing and doffing", lambda it: it.params.dressing + it.time + it.params.doffing
    )
    calendar_time = computed(
        "d", "the same by the calendar of shifts", lambda it: calendar_time(it.order_time, it.params)
    )
    knots_per_minute = computed(
        "1", "knots a minute of all heads, all stops included", lambda it: 60 * it.knots / it.time
    )
    availability = computed(
        "%", "share of dressing, weaving and doffing in which the loom runs", lambda it: float(it.one.availability)
    )
    performance = computed(
        "%", "ideal time of all attempts over the time in which it runs", lambda it: float(it.one.performance)
    )
    quality = computed("%", "knots over attempts", lambda it: float(it.one.quality))
    oee = computed("%", "overall equipment effectiveness: the product of these three", lambda it: float(it.one.oee))

    @computed("", "the largest loss beside the tying itself, or the tying")
    def bottleneck(self) -> str:
        largest = max(self.losses, key=lambda one: one["time"])
        return f"{WORDS[largest['use']]}: {largest['share']:.0%} of the time"

    @computed("", "what would shorten it")
    def bottleneck_cure(self) -> str:
        return CURES[max(self.losses, key=lambda one: one["time"])["use"]]

    @computed(
        "",
        "uses of the time, mean of the heads, the largest first: time [s], share, what would shorten it",
        shown=False,
    )
    def losses(self) -> list[JsonObject]:
        mean = self.by_head.mean(axis=0)
        order = np.argsort(-mean, kind="stable")
        return [
            {"use": USES[k], "time": float(mean[k]), "share": float(mean[k] / self.time), "cure": CURES[USES[k]]}
            for k in order.tolist()
        ]

    @computed("", "each head: share of the weaving time by use, changes, phases that it ended last", shown=False)
    def heads(self) -> list[JsonObject]:
        shares = self.by_head / self.time
        return [
            {
                "head": head + 1,
                **{use: float(share) for use, share in zip(USES, shares[head], strict=True)},
                "changes": int(self.run.changes[head]),
                "last": int(self.run.last[head]),
            }
            for head in range(self.setup.heads)
        ]

    @computed("", "stops by cause: faults, calls of the operator, his time and standstill of the loom [s]", shown=False)
    def stops(self) -> list[JsonObject]:
        sums, lost = self.run.sums, self.run.lost
        return [
            {
                "cause": cause.value,
                "faults": int(sums[COUNTS + k]),
                "calls": int(sums[ALL_CALLS + k]),
                "operator_time": seconds(sums[WORK + k]),
                "standstill": seconds(lost[k]),
                "mean_faults": float(self.seeds[:, COUNTS + k].mean()) if len(self.seeds) else None,
            }
            for k, cause in enumerate(CAUSES)
        ]

    @computed("", "pile yarn of each colour [m]: in knots, lost with faults, left on packages", shown=False)
    def yarn(self) -> list[JsonObject]:
        found = []
        for index, yarn in enumerate(self.setup.yarns):
            own = [use for use in self.packages_used if use.yarn == index]
            knots = sum(one.knots for one in own)
            found.append(
                {
                    "name": yarn.name,
                    "knots": knots,
                    "tied": knots * self.setup.knot_yarn[index],
                    "lost": sum(one.lost for one in own),
                    "left": sum(one.left for one in own),
                    "packages": len(own),
                }
            )
        return found

    @computed("", "packages of pile yarn by head and tube [m]: length, used with what is lost, left", shown=False)
    def packages(self) -> list[JsonObject]:
        return [
            {
                "head": use.head + 1,
                "tube": use.tube + 1,
                "yarn": self.setup.yarns[use.yarn].name,
                "length": use.length,
                "used": use.used,
                "left": use.left,
            }
            for use in self.packages_used
        ]

    @property
    def packages_used(self) -> list[PackageUse]:
        """The packages in the order in which they were taken off."""
        return self.run.packages.all

    @property
    def times(self) -> Band:
        """Weaving times over the seeds [s]; those of this run alone without others."""
        sums = self.seeds if len(self.seeds) else self.run.sums[None]
        return Band(sums[:, TIME] / BILLION)

    @computed(
        "",
        "weaving time over the seeds [s]: mean, median, 5 and 95 % of the runs, least, most; number of runs",
        shown=False,
    )
    def time_band(self) -> dict[str, Json]:
        return {**self.times.as_json(), "runs": len(self.times.values)}

    @computed("", "overall equipment effectiveness over the seeds, as `time_band`", shown=False)
    def oee_band(self) -> JsonObject:
        sums = self.seeds if len(self.seeds) else self.run.sums[None]
        return Band(effectiveness(sums, self.planned, self.setup, self.params).oee).as_json()
