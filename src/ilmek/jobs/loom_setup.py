"""What a programme states of its loom, its carpet and its yarns, from the loom's design and the chart."""

import hashlib
import json
import math
from collections.abc import Sequence

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import EMPTY, LoomSetup, OperationTimes
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign
from ilmek.machines.automated_loom.cyclogram import row_ends

WISHES = ("deadline", "price_limit")
"""Parameters that limit what was chosen for the first carpet; they do not change the loom."""


def loom_digest(params: AutomatedLoomParams) -> str:
    """SHA-256 of all parameters of a loom but its WISHES: the identity of the loom, in hexadecimal digits."""
    values = {name: value for name, value in params.as_dict().items() if name not in WISHES}
    return hashlib.sha256(json.dumps(values, sort_keys=True, default=str).encode()).hexdigest()


def loom_setup(
    made: LoomDesign, chart: Chart, heads: int, knot_yarns: Sequence[float], wefts: tuple[Bobbin, ...]
) -> LoomSetup:
    """The setup of a chart's programme on a loom.

    heads  that are used      knot_yarns  pile yarn of a knot of each yarn [m]      wefts  bobbins of weft
    """
    params, times = made.params, made.times
    tubes = max(params.head_tubes, len(chart.yarns))
    loading = np.full((heads, tubes), EMPTY, np.uint8)
    loading[:, : len(chart.yarns)] = np.arange(len(chart.yarns))
    lengths = [params.package_mass / yarn.linear_density for yarn in chart.yarns]
    packages = np.zeros((heads, tubes))
    packages[:, : len(lengths)] = lengths
    return LoomSetup(
        loom=loom_digest(params),
        size=chart.size,
        quality=chart.quality,
        knot=chart.knot,
        yarns=chart.yarns,
        warp_pitch=params.pitch,
        rows=chart.rows,
        columns=chart.columns,
        heads=heads,
        tubes=tubes,
        spacing=max(1, math.ceil(made.head_width / made.knot_pitch - 1e-9)),
        times=OperationTimes(
            times.knot, times.colour_change, times.travel, row_ends(made.row_cyclogram), params.tube_change
        ),
        loading=loading,
        packages=packages,
        knot_yarn=tuple(knot_yarns),
        wefts=wefts,
        cyclograms=made.cyclograms,
    )
