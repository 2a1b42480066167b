"""The energy of weaving: the work of each act at its drive, none of it recovered, and the standby power.

    energy = sum of (work of an act) * (number of acts) / efficiency + standby power * time

The works are those that the machines report. The efficiency of the drives and the standby power are parameters assumed
by this project: 70 % from the mains to the shaft, 10 W for the electronics of each axis. Friction in the mechanisms is
within the efficiency.
"""

from collections.abc import Iterable, Mapping

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.estimate import estimated_time
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.records import computed, record
from ilmek.report import Work


@record
class Energy:
    """Energy of the whole carpet [J] by consumer, the weaving time [s] and the carpet's area [m^2]."""

    shares: Mapping[str, float]
    time: float
    area: float

    total = computed("kWh", "energy for the carpet", lambda it: sum(it.shares.values()), name="energy")
    power = computed("W", "mean power from the mains while it weaves", lambda it: it.total / it.time, name="power_mean")
    power_shares = computed(
        "W", "of it, by consumer", lambda it: {name: joules / it.time for name, joules in it.shares.items()}
    )
    per_area = computed(
        "kWh/m^2", "energy for a square metre of carpet", lambda it: it.total / it.area, name="energy_per_area"
    )


def energy_of(loom: LoomDesign, axes: int) -> Energy:
    """The energy of weaving the loom's carpet at the estimated weaving time, with a number of driven axes."""
    params, knots = loom.params, loom.params.knots
    acts = {
        "knot": knots,
        "colour change": knots * params.changes_per_knot,
        "row": loom.rows,
        "pass": 2 * loom.rows,
        "beat": 2 * loom.rows,
        "carpet": 1,
    }
    return energy_of_acts(loom, axes, acts, estimated_time(loom), params.width * params.length)


def energy_of_acts(loom: LoomDesign, axes: int, acts: Mapping[str, float], time: float, area: float) -> Energy:
    """The energy of weaving a carpet on a loom; parameters as of `energy_of_works`."""
    works = (work for child in loom.machines.values() for work in child.work)
    return energy_of_works(loom.params, (*works, *loom.beat.work), axes, acts, time, area)


def energy_of_works(  # noqa: PLR0917
    params: AutomatedLoomParams,
    works: Iterable[Work],
    axes: int,
    acts: Mapping[str, float],
    time: float,
    area: float,
) -> Energy:
    """The energy of weaving a carpet.

    axes  number of driven axes      acts  number of each act: knot, colour change, row, pass, beat, carpet
    time  of weaving [s]             area  of the carpet [m^2]
    """
    shares: dict[str, float] = {}
    for work in works:
        shares[work.name] = shares.get(work.name, 0.0) + work.energy * acts[work.per] / params.drive_efficiency
    shares["standing by"] = params.standby_power * axes * time
    return Energy(shares, time, area)
