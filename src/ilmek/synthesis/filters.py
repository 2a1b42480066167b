"""Filters of candidates: against defects, and by given limits.

Each filter against a defect is active by default; a limit is active where it is given.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ilmek.params import Params, kind
from ilmek.report import snap_to_limit
from ilmek.synthesis.candidate import Candidate
from ilmek.units import deg, format_quantity

JAM = 1 * deg
"""Transmission angle below which a four-bar counts as jammed [rad]: 57 times the force, and play decides the motion."""


@dataclass(frozen=True, slots=True)
class Filters(Params):
    """Requirements on a candidate in addition to its task (to close at all positions, within the tolerances).

    Raises ParameterError for a limit that no four-bar can meet.
    """

    one_circuit: bool = kind.flag(True, doc="remove four-bars that must be disassembled between two positions")
    one_branch: bool = kind.flag(
        True, doc="remove four-bars that pass a dead centre of the crank between two positions"
    )
    in_order: bool = kind.flag(True, doc="remove four-bars whose crank meets the positions in another order")
    transmits: bool = kind.flag(True, doc="remove four-bars that jam: least transmission angle below 1 deg")
    full_turn: bool = kind.flag(False, doc="remove four-bars whose crank does not rotate fully")
    transmission_min: float = kind.angle(
        0.0, at_least=0.0, below=90 * deg, doc="least angle between coupler and rocker over the motion"
    )
    link_ratio_max: float | None = kind.ratio(
        None, at_least=1.0, at_most=1e6, doc="greatest ratio of the longest to the shortest link"
    )
    size_max: float | None = kind.length(
        None, above=0.0, at_most=1e3, doc="greatest overall size of the four-bar over its motion"
    )

    @property
    def transmits_only(self) -> bool:
        """Whether no transmission angle is required but that of a four-bar that does not jam."""
        return self.transmits and self.transmission_min <= JAM

    @property
    def least_transmission(self) -> float:
        """Least transmission angle that is kept [rad]: `transmission_min`, or that of a four-bar that does not jam."""
        return max(self.transmission_min, JAM if self.transmits else 0.0)


REASONS = {
    "closes": "does not close at a position",
    "met": "misses a position",
    "one_circuit": "positions on two circuits",
    "one_branch": "positions on two branches",
    "in_order": "positions out of order",
    "transmits": f"least transmission angle below {format_quantity(JAM, 'deg')}",
    "full_turn": "crank does not turn fully",
    "transmission": "transmission angle too small",
    "link_ratio": "links too unequal",
    "size": "too large",
    "crank_region": "crank's pivot outside its region",
    "rocker_region": "rocker's pivot outside its region",
    "crank_swing": "rotation of the crank out of range",
    "rocker_swing": "swing of the rocker out of range",
    "keep_out": "touches the region to keep clear",
}
"""Short name of the defect of each filter."""


LISTED_POSITIONS = 12
"""Greatest number of positions whose order is reported completely."""


def defects(one: Candidate, filters: Filters | None = None, *, task_only: bool = False) -> dict[str, str]:
    """Filters that a candidate fails -> reason as a sentence; a limit that is met but for rounding is kept.

    filters    default: `Filters()`
    task_only  whether the transmission angle is that from the first to the last position, also of a crank that turns

    >>> from ilmek.synthesis.candidate import judge
    >>> from ilmek.synthesis.four_bar import FourBar
    >>> from ilmek.synthesis.task import PrecisionTask
    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    >>> list(defects(judge(drawn, PrecisionTask(points=np.array([2 + 3j, 0j])))))
    ['met']
    """
    filters = filters or Filters()
    found = _of_positions(one) | _of_motion(one, filters, one.transmission_over(task_only=task_only))
    return {name: words for name, words in found.items() if getattr(filters, name, True)}


def _of_positions(one: Candidate) -> dict[str, str]:
    """Failures to perform the task."""
    of_positions = {}
    circuits = {k: met.circuit for k, met in enumerate(one.positions, 1)}
    branches = {k: met.branch for k, met in enumerate(one.positions, 1)}
    open_positions = [str(k) for k, met in enumerate(one.positions, 1) if not met.reached]
    if open_positions:
        of_positions["closes"] = f"does not close at position {', '.join(open_positions)}"
    elif not one.met:
        of_positions["met"] = f"misses {_worst(one)}"
    if not one.one_circuit:
        of_positions["one_circuit"] = f"must be disassembled: positions {_grouped(circuits)} are on circuits 1 and 2"
    elif not one.one_branch:
        of_positions["one_branch"] = (
            f"passes a dead centre of the crank: positions {_grouped(branches)} are on two branches"
        )
    elif not open_positions and not one.in_order:
        of_positions["in_order"] = _out_of_order(one.order)
    return of_positions


def _of_motion(one: Candidate, filters: Filters, transmission: float) -> dict[str, str]:
    """Limits that are not met; transmission  least angle [rad]."""
    found = {}
    if not one.crank_turns:
        found["full_turn"] = f"the crank does not turn fully: {one.grashof.kind}"
    found |= _of_transmission(one, filters, transmission)
    if (
        filters.link_ratio_max is not None
        and snap_to_limit(one.link_ratio, filters.link_ratio_max) > filters.link_ratio_max
    ):
        found["link_ratio"] = (
            f"longest link {one.link_ratio:.4g} times the shortest, allowed at most {filters.link_ratio_max:g}"
        )
    if filters.size_max is not None and snap_to_limit(one.size, filters.size_max) > filters.size_max:
        size, limit = (format_quantity(length, "mm") for length in (one.size, filters.size_max))
        found["size"] = f"size {size}, allowed at most {limit}"
    return found


def _of_transmission(one: Candidate, filters: Filters, least: float) -> dict[str, str]:
    """The jam, or the transmission angle below the required one; a passed dead centre is named as such alone."""
    shown = format_quantity(round(least, 6), "deg")
    if filters.transmits and one.one_branch and snap_to_limit(least, JAM) < JAM:
        return {"transmits": f"jams: transmission angle {shown}, below {format_quantity(JAM, 'deg')}"}
    required = filters.transmission_min
    if required and not snap_to_limit(least, required) >= required:
        limit = format_quantity(required, "deg")
        return {"transmission": f"transmission angle {shown}, required at least {limit}"}
    return {}


def _out_of_order(order: tuple[int, ...]) -> str:
    if len(order) <= LISTED_POSITIONS:
        return f"the crank meets the positions in the order {', '.join(map(str, order))}"
    early, late = next(pair for pair in pairwise(order) if pair[1] < pair[0])
    return f"the crank meets position {early} before {late}"


def _grouped(values: Mapping[int, int]) -> str:
    """Positions grouped by their common value, such as "1, 3 and 2"."""
    kinds = sorted({value for value in values.values() if value}, key=lambda kind: list(values.values()).index(kind))
    return " and ".join(", ".join(str(k) for k, value in values.items() if value == kind) for kind in kinds)


def _worst(one: Candidate) -> str:
    """The position with the greatest error relative to its tolerance, and this error."""
    near, angle = one.task.point_limit, one.task.angle_tolerance
    errors = [(met.point_error / near, met.coupler_error / angle, met.rocker_error / angle) for met in one.positions]
    table = np.nan_to_num(np.array(errors), nan=-1.0)
    position, what = (int(k) for k in np.unravel_index(np.argmax(table), table.shape))
    met = one.positions[position]
    missed = (
        f"point by {format_quantity(met.point_error, 'mm')}",
        f"coupler angle by {format_quantity(met.coupler_error, 'deg')}",
        f"rocker angle by {format_quantity(met.rocker_error, 'deg')}",
    )
    return f"position {position + 1}: {missed[what]}"
