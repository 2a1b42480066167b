"""Draws docs/_static/nine-points.svg: a four-bar through nine points and its cognate.

Run it as `python examples/draw_nine_points.py`; it ends with the greatest distance of the best one from a point in mm.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ilmek.report import Dot, Drawing, Stroke
from ilmek.synthesis.alt_burmester.defects import best_drive
from ilmek.synthesis.alt_burmester.four_bars import complete_four_bars
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "nine-points.svg"

POINTS = np.array([18 + 66j, 30 + 88j, 21 + 94j, 6 + 90j, -9 + 78j, -21 + 59j, -24 + 42j, -18 + 34j, -4 + 41j]) * mm


def figure(one: FourBar, cognate: FourBar) -> Drawing:
    """Two cognates at the first point, the curve of both, and the points."""
    circuit = judge(one, PrecisionTask(points=POINTS)).positions[0].circuit
    path = circuit_loops(one)[circuit - 1].at(np.linspace(0, 2 * np.pi, 361)).tracer
    return Drawing(
        "nine-points",
        "Two of the four-bars that meet nine points exactly: cognates, with one curve",
        (Stroke(path, "path", "path of P", closed=True), *links(one, "link"), *links(cognate, "construction")),
        (
            Dot(one.a0, "A0", "pivot"),
            Dot(one.b0, "B0", "pivot"),
            *(Dot(pivot, "", "pivot") for pivot in (cognate.a0, cognate.b0)),
            *(Dot(complex(point), str(number), "point") for number, point in enumerate(POINTS, 1)),
        ),
    )


def links(one: FourBar, role: str) -> tuple[Stroke, ...]:
    """Crank, coupler and rocker; their names where they are drawn as links."""
    corners = {
        "crank": [one.a0, one.a],
        "coupler": [one.a, one.b, complex(one.tracer or 0)],
        "rocker": [one.b0, one.b],
    }
    named = role == "link"
    return tuple(Stroke(np.array(at), role, name if named else "", closed=len(at) > 2) for name, at in corners.items())


def without_defects(task: PosesAndPoints) -> Sequence[FourBar]:
    """The four-bars of a task without defects, the best transmission angle first."""
    drives = [best_drive(one, task.points) for one in complete_four_bars(task).found]
    judged = [judge(drawn, PrecisionTask(points=task.points)) for drawn, defect in drives if defect is None]
    return [one.four_bar for one in sorted(judged, key=lambda one: -one.least_transmission)]


if __name__ == "__main__":
    found = without_defects(PosesAndPoints(POINTS, np.full(len(POINTS), np.nan)))
    OUT.write_text(svg(figure(found[0], found[1])), encoding="utf-8")
    print(f"{len(found)} four-bars without defects")
    print(f"{judge(found[0], PrecisionTask(points=POINTS)).point_error / mm:.0e}")
