"""The family of a beat-up: all crank-rockers with its swing and crank rotation, their motion and forces.

Each is sized, loaded and run at the speed like the beat-up itself, with ground, beater, and links of its section and
with its pins.
The best within limits is chosen from them; the Pareto front are the members that no other dominates in the objectives.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray, RealField
from ilmek.machines.beat_up.links import moving_masses
from ilmek.machines.beat_up.params import BEATER_RATIO, LIMITS, OBJECTIVES, BeatUpParams, front_objectives
from ilmek.num.pareto import front
from ilmek.num.periodic_maxima import periodic_maxima
from ilmek.records import computed, record
from ilmek.report import Json
from ilmek.synthesis.crank_rocker.choice import Limit, Objective, choose
from ilmek.synthesis.crank_rocker.dead_centres import (
    DeadCentres,
    LinkRatios,
    OpenInterval,
    best_ratio,
    beta_limits,
    beta_of_ratio,
    coupler_limits,
    grashof_margin,
    links_of_ratio,
    ratio_limits,
    transmission_angle_min,
)
from ilmek.synthesis.crank_rocker.family import family, link_ratio, size
from ilmek.synthesis.crank_rocker.forces import CrankRockerBodies, CrankRockerLoad, loaded
from ilmek.synthesis.crank_rocker.motion import sharp_angles
from ilmek.synthesis.crank_rocker.selection import RATIO_FLOOR
from ilmek.units import turn

Table = Mapping[str, FloatArray]
"""Quantity of `QUANTITIES` -> its values [SI], one a member."""

QUANTITIES = {
    "crank_coupler_ratio": ("crank/coupler ratio", "1"),
    "beta": ("crank angle of the beat", "deg"),
    "crank": ("crank over ground", "1"),
    "coupler": ("coupler over ground", "1"),
    "rocker": ("rocker over ground", "1"),
    "transmission_angle_min": ("least transmission angle", "deg"),
    "link_ratio": ("longest link over shortest", "1"),
    "grashof_margin": ("Grashof margin over ground", "1"),
    "size": ("size", "mm"),
    "rocker_speed_max": ("greatest speed of the rocker", "rad/s"),
    "rocker_acceleration_max": ("greatest acceleration of the rocker", "rad/s^2"),
    "beater_acceleration_max": ("greatest acceleration of the beater", "m/s^2"),
    "acceleration_at_beat": ("acceleration at the beat", "m/s^2"),
    "beater_force_max": ("greatest force on the beater", "N"),
    "force_at_beat": ("force at the beat", "N"),
    "drive_torque_max": ("greatest drive torque", "N*m"),
    "joint_force_max": ("greatest force in a pin", "N"),
}
"""Quantities of every member: their names in reports, and the unit to show them in."""

REPORTED = 25
"""Members of the front in the results."""

ROUNDING = 1e-5
"""A best ratio this small is that of the centric crank-rocker, whose cubic has its roots at 0; so is an end of it."""


@record
class FamilyResult:
    """A family: members by ascending ratio, their quantities, and the Pareto front.

    swing, rotation  of the family [rad]
    own        the beat-up's own quantities             table  those of the members
    objectives of the front                             front  whether each member is on it
    """

    swing: float
    rotation: float
    own: Mapping[str, float]
    table: Table
    objectives: tuple[str, ...]
    front: BoolArray

    pareto_weighed = computed("", "objectives of the Pareto front", lambda it: list(it.objectives))
    pareto_count = computed("", "members on the front", lambda it: int(it.front.sum()))
    own_quantities = computed(
        "", "the quantities of this beat-up; SI and radians", lambda it: dict(it.own), name="own", shown=False
    )

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
        return [dict(one) for one in self.some(REPORTED)]

    def __len__(self) -> int:
        return self.front.size

    def some(self, number: int) -> tuple[dict[str, float], ...]:
        """At most so many members of the front, evenly apart in it, the first and the last among them."""
        members = np.flatnonzero(self.front)
        if members.size > number:
            members = members[np.linspace(0, members.size - 1, number).round().astype(np.intp)]
        return tuple({name: float(values[member]) for name, values in self.table.items()} for member in members)


def _ends(interval: OpenInterval) -> list[float]:
    return [end if abs(end) > ROUNDING else 0.0 for end in (float(interval.low), float(interval.high))]


def family_of(params: BeatUpParams, links: LinkRatios, dead: DeadCentres, hole: float) -> FamilyResult:
    """The family of a beat-up with these links and dead centres; hole: diameter of the holes in its links [m]."""
    objectives = {name: Objective(*OBJECTIVES[name]) for name in front_objectives(params.front)}
    swing, rotation = float(dead.swing), float(dead.rotation)
    members = family(swing, rotation, params.members)
    table = tabulate(params, members.links, members.beta, hole)
    single = LinkRatios(*(np.array([float(link)]) for link in links))
    own = tabulate(params, single, np.array([float(dead.beta)]), hole)
    costs = np.stack([objective.cost(table) for objective in objectives.values()], axis=1)
    return FamilyResult(
        swing=swing,
        rotation=rotation,
        own={name: float(values[0]) for name, values in own.items()},
        table=table,
        objectives=tuple(objectives),
        front=front(costs),
    )


def tabulate(params: BeatUpParams, links: LinkRatios, beta: RealField, hole: float) -> Table:
    """The `QUANTITIES` of beat-ups with given links and crank angles of the beat [rad], arrays of one dimension.

    hole  diameter of the holes in the links [m]
    """
    made = bodies(params, links, hole)
    load = CrankRockerLoad(params.ground, params.speed, params.beater_mass, params.gravity_vector)
    beta = np.broadcast_to(beta, made.crank.shape)

    def curves(row: IntArray, angle: FloatArray) -> dict[str, FloatArray]:
        return loaded(load, made.rows(row), angle)

    with np.errstate(divide="ignore", invalid="ignore"):
        most = periodic_maxima(curves, sharp_angles(links))
        beat = loaded(load, made, beta)
    return {
        "crank_coupler_ratio": made.crank / made.coupler,
        "beta": np.mod(beta, turn),
        "crank": np.asarray(links.crank),
        "coupler": np.asarray(links.coupler),
        "rocker": np.asarray(links.rocker),
        "transmission_angle_min": np.asarray(transmission_angle_min(links)),
        "link_ratio": np.asarray(link_ratio(links)),
        "grashof_margin": np.asarray(grashof_margin(links)),
        "size": np.asarray(size(links, beta, made.beater / params.ground)) * params.ground,
        "rocker_speed_max": most["rocker_speed"],
        "rocker_acceleration_max": most["rocker_acceleration"],
        "beater_acceleration_max": most["beater_acceleration"],
        "acceleration_at_beat": beat["beater_acceleration"],
        "beater_force_max": most["beater_force"],
        "force_at_beat": beat["beater_force"],
        "drive_torque_max": most["drive_torque"],
        "joint_force_max": np.max(np.stack([most[pin] for pin in "ABCD"]), axis=0),
    }


def bodies(params: BeatUpParams, links: LinkRatios, hole: float) -> CrankRockerBodies:
    """Links and beater of beat-ups with given links, all else as in the parameters; hole: as of `tabulate`."""
    crank, coupler, rocker = (np.asarray(link, dtype=float) * params.ground for link in links)
    beater = np.broadcast_to(np.asarray(params.beater or BEATER_RATIO * rocker), rocker.shape)
    lengths = {"crank": crank, "coupler": coupler, "rocker": rocker, "beater": beater}
    moving = moving_masses(params, lengths, hole)
    of_coupler = moving["coupler"].zeroth, moving["coupler"].about_centre
    columns = (*moving["crank"][:2], *of_coupler, *moving["rocker"])
    return CrankRockerBodies(crank, coupler, rocker, beater, *(np.asarray(column) for column in columns))


def is_chosen(params: BeatUpParams) -> bool:
    """Whether limits or an objective choose the member."""
    return params.objective is not None or bool(limits(params))


def chosen_ratio(params: BeatUpParams, hole: float) -> float:
    """Ratio crank / coupler of the member that limits and objective choose; hole: as of `tabulate`.

    Ratios below 0.1, whose crank is a stub beside its ground, are chosen only where they are required or no other
    member is within the limits. Raises ParameterError, with the limits that clash, where no member is.
    """
    given = limits(params)
    members = family(params.rocker_swing, params.crank_rotation, params.members)
    bounds = [limit.bound for limit in given if limit.quantity == "crank_coupler_ratio"]
    ends = members.ratio[0], members.ratio[-1]
    ratios = np.unique(np.concatenate([members.ratio, [bound for bound in bounds if ends[0] < bound < ends[1]]]))

    def table(ratio: FloatArray) -> Table:
        member = params.rocker_swing, params.crank_rotation, ratio
        return tabulate(params, links_of_ratio(*member), beta_of_ratio(*member), hole)

    quantity, sign = OBJECTIVES[params.objective or next(iter(OBJECTIVES))]
    floor = Limit("crank_coupler_ratio", RATIO_FLOOR, +1, "ratio_min")
    return choose(table, ratios, Objective(quantity, sign), given, [floor] if params.ratio_min is None else [])


def limits(params: BeatUpParams) -> tuple[Limit, ...]:
    """The given limits."""
    bounds = ((name, getattr(params, name), *declared) for name, declared in LIMITS.items())
    return tuple(
        Limit(quantity, bound, sign, name, unit) for name, bound, quantity, sign, unit in bounds if bound is not None
    )
