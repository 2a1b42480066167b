"""What the drawings and plots of crank-driven mechanisms share: positions of points, and curves over a turn."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.motion import Motion
from ilmek.report import Axis, Mark, Plot, Series

CRANK = Axis("crank angle", "deg")


def points_at(motion: Motion, points: Mapping[str, str]) -> dict[str, complex]:
    """Positions of points [m] in a motion of one sample; points: name -> body that it belongs to."""
    return {name: complex(np.ravel(motion.point(body, name).position)[0]) for name, body in points.items()}


def crank_plot(
    name: str,
    title: str,
    y: Axis,
    *,
    angle: FloatArray,
    curves: Mapping[str, FloatArray],
    marks: tuple[Mark, ...] = (),
    note: str = "",
) -> Plot:
    """Curves over the crank angle [rad], by their labels; of two the second is dashed."""
    series = tuple(
        Series(label, angle, values, dashed=number > 0 and len(curves) == 2)
        for number, (label, values) in enumerate(curves.items())
    )
    return Plot(name, title, CRANK, y, series, marks, note)
