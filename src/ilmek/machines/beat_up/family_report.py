"""What a beat-up design says of its family: limits, best transmission angle, its own place, and Pareto's front."""

from collections.abc import Mapping

from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.family import QUANTITIES, FamilyResult, limits
from ilmek.records import record
from ilmek.report import Check, Column, Json, Table, at_least, at_most, columns, computed
from ilmek.synthesis.crank_rocker.dead_centres import (
    OpenInterval,
    best_ratio,
    beta_limits,
    coupler_limits,
    links_of_ratio,
    ratio_limits,
    transmission_angle_min,
)

REPORTED, SHOWN = 25, 9
"""Members of the front in the results, and in the table."""

ROUNDING = 1e-5
"""A best ratio this small is that of the centric crank-rocker, whose cubic has its roots at 0; so is an end of it."""

COLUMNS = (
    "crank_coupler_ratio",
    "transmission_angle_min",
    "force_at_beat",
    "beater_acceleration_max",
    "drive_torque_max",
    "joint_force_max",
    "size",
)
"""Quantities of the table."""


@record
class FamilyResults:
    """Ends of the family, the cubic's member, the design's own quantities, and members of the front.

    swing, rotation  of the family [rad]
    """

    weighed: FamilyResult
    swing: float
    rotation: float

    pareto_weighed = computed("", "objectives of the Pareto front", lambda it: list(it.weighed.weighed))
    pareto_count = computed("", "members on the front", lambda it: int(it.weighed.front.sum()))
    own = computed("", "the quantities of this beat-up; SI and radians", lambda it: dict(it.weighed.own), shown=False)

    @computed("", "ends of the family of this swing and crank rotation, themselves excluded; beta in radians")
    def family_limits(self) -> Json:
        return {
            "crank_coupler_ratio": _ends(ratio_limits(self.swing, self.rotation)),
            "coupler": _ends(coupler_limits(self.swing, self.rotation)),
            "beta": _ends(beta_limits(self.swing, self.rotation)),
        }

    @computed("1", "crank/coupler ratio of the family's best transmission angle; 0: never reached")
    def best_ratio(self) -> float:
        best = float(best_ratio(self.swing, self.rotation))
        return 0.0 if best < ROUNDING else best

    @computed("deg", "that angle, by the cubic")
    def best_transmission_angle(self) -> float:
        return float(transmission_angle_min(links_of_ratio(self.swing, self.rotation, self.best_ratio)))

    @computed("", "members of the front, by their ratio", shown=False)
    def pareto(self) -> Json:
        return [dict(one) for one in self.weighed.some(REPORTED)]


def _ends(limits_: OpenInterval) -> list[float]:
    return [end if abs(end) > ROUNDING else 0.0 for end in (float(limits_.low), float(limits_.high))]


def limit_checks(design: BeatUp, weighed: FamilyResult) -> tuple[Check, ...]:
    """The limits by which the beat-up was chosen."""
    return tuple(
        (at_least if limit.sign > 0 else at_most)(
            f"{QUANTITIES[limit.quantity][0]}, {limit.name}",
            weighed.own[limit.quantity],
            limit.bound,
            limit.unit,
            "given",
        )
        for limit in limits(design.params)
    )


def front_table(weighed: FamilyResult) -> Table:
    """Some members of the front, and the beat-up itself."""
    heads = columns("member", *(Column(*QUANTITIES[name]) for name in COLUMNS))
    rows = (*(_row("front", one) for one in weighed.some(SHOWN)), _row("this", weighed.own))
    return Table("beat-up-front", "Members on Pareto's front, and this beat-up", heads, rows)


def _row(label: str, member: Mapping[str, float]) -> tuple[float | int | str, ...]:
    return (label, *(member[name] for name in COLUMNS))
