"""What a programme states of its loom, its carpet and its yarns, from the loom's design and the chart."""

import hashlib
import json
import math

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.loom.operations import LoomSetup, OperationTimes
from ilmek.loom.programme import Programme
from ilmek.loom.tube_plan import YarnSupply
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign
from ilmek.machines.automated_loom.cyclogram import row_ends
from ilmek.records import record

WISHES = ("deadline", "price_limit", "knotted_share")
"""Parameters by which the loom was chosen for its first carpet; they do not change the loom."""


def loom_digest(params: AutomatedLoomParams) -> str:
    """SHA-256 of all parameters of a loom but its WISHES: the identity of the loom, in hexadecimal digits."""
    values = {name: value for name, value in params.as_dict().items() if name not in WISHES}
    return hashlib.sha256(json.dumps(values, sort_keys=True, default=str).encode()).hexdigest()


@record
class CarpetPile:
    """A chart, and the pile yarn of a knot of each of its yarns [m]."""

    chart: Chart
    knot_yarns: tuple[float, ...]

    def supply(self, params: AutomatedLoomParams) -> YarnSupply:
        """Tubes of a loom's heads, and the packages of this carpet's yarns."""
        packages = tuple(params.package_mass / yarn.linear_density for yarn in self.chart.yarns)
        return YarnSupply(params.head_tubes, packages, self.knot_yarns)


def _row_knots(chart: Chart) -> tuple[int, ...]:
    """Knots of each row, from the bottom edge."""
    return tuple(np.count_nonzero(chart.knots[::-1] != NO_KNOT, axis=1).tolist())


def knotted_share(chart: Chart) -> float:
    """Share of a chart's cells that are knots."""
    return sum(_row_knots(chart)) / chart.knots.size


def knots_saved(chart: Chart, weavers: int, share: float = 1.0) -> float:
    """Knots in turn that a number of weavers has less than by a share of the cells: each row is shared evenly."""
    if chart.cells is None:
        return 0
    knots = np.array(_row_knots(chart))
    return float((-(-chart.columns // weavers) * share - -(-knots // weavers)).sum())


def loom_setup(made: LoomDesign, carpet: CarpetPile, programme: Programme) -> LoomSetup:
    """The setup of a carpet's programme on a loom."""
    params, times, chart = made.params, made.times, carpet.chart
    return LoomSetup(
        loom=loom_digest(params),
        size=chart.size,
        quality=chart.quality,
        knot=chart.knot,
        yarns=chart.yarns,
        warp_pitch=made.task.cloth.warp_pitch,
        rows=chart.rows,
        columns=chart.columns,
        heads=programme.heads,
        tubes=params.head_tubes,
        spacing=max(1, math.ceil(made.head_width / made.knot_pitch - 1e-9)),
        times=OperationTimes(
            times.knot, times.colour_change, times.travel, row_ends(made.row_cyclogram), params.tube_change
        ),
        loading=programme.tubes.loading,
        packages=programme.tubes.packages,
        knot_yarn=carpet.knot_yarns,
        wefts=programme.bobbins,
        cyclograms=made.cyclograms,
        row_knots=None if chart.tally().knots == chart.knots.size else _row_knots(chart),
    )
