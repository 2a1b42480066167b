"""Figures of the family of a beat-up: its quantities over the ratio r/l, and the Pareto front."""

import numpy as np

from ilmek.arrays import BoolArray, FloatArray
from ilmek.machines.beat_up.family import QUANTITIES, FamilyResult
from ilmek.machines.beat_up.params import OBJECTIVES
from ilmek.report import Axis, Mark, Plot, Series

CURVES = (
    ("family-angle", "Transmission angle of the family", ("transmission_angle_min",)),
    ("family-beat", "Acceleration of the beater in the family", ("beater_acceleration_max", "acceleration_at_beat")),
    ("family-force", "Forces in the family", ("joint_force_max", "beater_force_max", "force_at_beat")),
    ("family-torque", "Drive torque of the family", ("drive_torque_max",)),
    ("family-rocker", "Speed of the rocker in the family", ("rocker_speed_max",)),
    ("family-alpha", "Angular acceleration of the rocker in the family", ("rocker_acceleration_max",)),
    ("family-links", "Longest link over the shortest in the family", ("link_ratio",)),
    ("family-size", "Size of the family", ("size",)),
)
"""Plots over the ratio: name, title, quantities of one unit."""

AXES = {"m/s^2": "acceleration", "N": "force"}
"""What axes of several curves are called, by their unit."""

WORTH = 4.0
"""A member is drawn while no value exceeds so many times the quantity's median: near a toggle all tend to infinity."""


def family_figures(result: FamilyResult) -> tuple[Plot, ...]:
    """Curves over the ratio, then the Pareto front: the first objective against each other one."""
    first, *others = result.objectives
    return (
        *(_curves(result, name, title, quantities) for name, title, quantities in CURVES),
        *(_front(result, first, other) for other in others),
    )


def _curves(result: FamilyResult, name: str, title: str, quantities: tuple[str, ...]) -> Plot:
    ratio = result.table["crank_coupler_ratio"]
    labels, units = zip(*(QUANTITIES[quantity] for quantity in quantities), strict=True)
    ceiling = max(WORTH * float(np.nanmedian(result.table[quantity])) for quantity in quantities)
    series = tuple(
        Series(label, ratio, _below(result.table[quantity], ceiling), dashed=number > 0 and len(quantities) == 2)
        for number, (quantity, label) in enumerate(zip(quantities, labels, strict=True))
    )
    axis = Axis(labels[0] if len(labels) == 1 else AXES[units[0]], units[0])
    marks = (Mark(result.own["crank_coupler_ratio"], "this beat-up"),)
    return Plot(name, title, Axis("crank/coupler ratio r/l", "1"), axis, series, marks)


def _front(result: FamilyResult, first: str, second: str) -> Plot:
    """The family with its front, and a ring about the beat-up itself."""
    (x, _), (y, _) = OBJECTIVES[first], OBJECTIVES[second]
    (x_label, x_unit), (y_label, y_unit) = QUANTITIES[x], QUANTITIES[y]
    kept = np.ones(len(result), dtype=bool)
    for quantity in (x, y):
        kept &= np.isfinite(_below(result.table[quantity], WORTH * float(np.nanmedian(result.table[quantity]))))
    across, up = (np.where(kept, result.table[quantity], np.nan) for quantity in (x, y))
    ring = _ring(result.own[x], result.own[y], _width(across), _width(up))
    series = [Series("Pareto front", *_where(result.front, across, up)), Series("this beat-up", *ring)]
    if not result.front.all():
        series.append(Series("other members", *_where(~_inner(result.front), across, up), dashed=True))
    names = f"{x_label} and {y_label}"
    return Plot(
        f"family-front-{second}".replace("_", "-"),
        f"Pareto front: {names}",
        Axis(x_label, x_unit),
        Axis(y_label, y_unit),
        tuple(series),
        note=f"Objectives of the front: {', '.join(result.objectives)}.".replace("_", " "),
    )


def _below(values: FloatArray, ceiling: float) -> FloatArray:
    """The values, those above the ceiling as gaps."""
    return np.where(values <= ceiling, values, np.nan)


def _where(kept: BoolArray, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A curve with gaps where it is not kept."""
    return np.where(kept, x, np.nan), np.where(kept, y, np.nan)


def _inner(front: BoolArray) -> BoolArray:
    """Members of the front whose neighbours are on it too: the others' curve reaches up to the front's ends."""
    inner = front.copy()
    inner[1:] &= front[:-1]
    inner[:-1] &= front[1:]
    return inner


def _width(values: FloatArray) -> float:
    return float(np.nanmax(values) - np.nanmin(values)) or 1.0


def _ring(x: float, y: float, width: float, height: float) -> tuple[FloatArray, FloatArray]:
    """A ring about a point, round on the page, whose axes are as 2.3 to 1."""
    around = np.linspace(0, 2 * np.pi, 37)
    return x + 0.009 * width * np.cos(around), y + 0.021 * height * np.sin(around)
