"""What a beat-up design says of its family: limits, best transmission angle, its own place, and Pareto's front."""

from collections.abc import Mapping

from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.family import QUANTITIES, Weighed, limits
from ilmek.report import Check, Column, Result, Table, at_least, at_most
from ilmek.report.limits import snap_to_limit
from ilmek.synthesis.crank_rocker.dead_centres import (
    Limits,
    best_ratio,
    beta_limits,
    coupler_limits,
    links_of_ratio,
    ratio_limits,
    transmission_angle_min,
)

TOLD, SHOWN = 25, 9
"""Members of the front that the results tell, and that the table shows."""

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


def family_results(design: BeatUp, weighed: Weighed) -> tuple[Result, ...]:
    """Ends of the family, the cubic's member, the design's own quantities, and members of the front."""
    place = float(design.dead_centres.swing), float(design.dead_centres.rotation)
    best = float(best_ratio(*place))
    best = 0.0 if best < ROUNDING else best
    angle = float(transmission_angle_min(links_of_ratio(*place, best)))
    return (
        Result(
            "family_limits",
            {
                "crank_coupler_ratio": _ends(ratio_limits(*place)),
                "coupler": _ends(coupler_limits(*place)),
                "beta": _ends(beta_limits(*place)),
            },
            "",
            "ends of the family of this swing and crank rotation, themselves excluded; beta in radians",
        ),
        Result(
            "best_ratio", best, "1", "crank/coupler ratio of the family's best transmission angle; 0: never reached"
        ),
        Result("best_transmission_angle", angle, "deg", "that angle, by the cubic"),
        Result("own", dict(weighed.own), "", "the quantities of this beat-up; SI and radians", shown=False),
        Result("pareto_weighed", list(weighed.weighed), "", "what Pareto's front weighs"),
        Result("pareto_count", int(weighed.front.sum()), "", f"members on the front, of {len(weighed)}"),
        Result(
            "pareto", [dict(one) for one in weighed.some(TOLD)], "", "members of the front, by their ratio", shown=False
        ),
    )


def _ends(limits_: Limits) -> list[float]:
    return [end if abs(end) > ROUNDING else 0.0 for end in (float(limits_.low), float(limits_.high))]


def limit_checks(design: BeatUp, weighed: Weighed) -> tuple[Check, ...]:
    """The limits by which the beat-up was chosen."""
    return tuple(
        (at_least if limit.sign > 0 else at_most)(
            f"{QUANTITIES[limit.quantity][0]}, {limit.name}",
            snap_to_limit(weighed.own[limit.quantity], limit.bound),
            limit.bound,
            limit.unit,
            "asked",
        )
        for limit in limits(design.params)
    )


def front_table(weighed: Weighed) -> Table:
    """Some members of the front, and the beat-up itself."""
    columns = (Column("member"), *(Column(*QUANTITIES[name]) for name in COLUMNS))
    rows = (*(_row("front", one) for one in weighed.some(SHOWN)), _row("this", weighed.own))
    return Table("beat-up-front", "Members on Pareto's front, and this beat-up", columns, rows)


def _row(said: str, member: Mapping[str, float]) -> tuple[float | int | str, ...]:
    return (said, *(member[name] for name in COLUMNS))
