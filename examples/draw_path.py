"""Draws docs/_static/path-four-bar.svg: a four-bar for a stroke of 60 mm that goes straight and comes back over a bow.

Run it as `python examples/draw_path.py`; it prints what holds the four-bar, and ends with its greatest error in mm.
"""

import math
from pathlib import Path

import numpy as np

from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.report import Dot, Drawing, Stroke
from ilmek.synthesis.path.fit import PathFit
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask
from ilmek.units import deg, mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "path-four-bar.svg"

STRAIGHT = np.linspace(0, 60, 9) + 0j
BOW = 30 + 30 * np.cos(np.linspace(0, math.pi, 9)[1:-1]) + 18j * np.sin(np.linspace(0, math.pi, 9)[1:-1])
POINTS = np.concatenate([BOW, STRAIGHT]) * mm
LINKS = dict.fromkeys(("ground", "crank", "coupler", "rocker"), (10 * mm, 120 * mm))
TASK = PathTask(POINTS, closed=True, bounds=LINKS, transmission=40 * deg)


def figure(fit: PathFit) -> Drawing:
    """The four-bar where its tracer meets the first point, the tracer's path, and the points."""
    four_bar, turn = fit.four_bar, np.linspace(0, 2 * math.pi, 361)
    path = np.asarray(solve(plan(four_bar.mechanism()), turn).point("coupler", "P").position)
    a0, b0, a, b, p = four_bar.a0, four_bar.b0, four_bar.a, four_bar.b, complex(four_bar.tracer or 0)
    return Drawing(
        "path-four-bar",
        f"A four-bar for {len(TASK.points)} points: nearest to {fit.greatest_error / mm:.2f} mm",
        (
            Stroke(np.array([a0, a]), "link", "crank"),
            Stroke(np.array([a, b, p]), "link", "coupler", closed=True),
            Stroke(np.array([b0, b]), "link", "rocker"),
            Stroke(path, "path", "path of P", closed=True),
        ),
        (
            Dot(a0, "A0", "pivot"),
            Dot(b0, "B0", "pivot"),
            Dot(a, "A"),
            Dot(b, "B"),
            Dot(p, "P", "point"),
            *(Dot(complex(point), "", "point") for point in TASK.points[1:]),
        ),
    )


if __name__ == "__main__":
    best = path_four_bars(TASK, count=1)[0]
    OUT.write_text(svg(figure(best)), encoding="utf-8")
    print("held by:", ", ".join(best.active) or "nothing")
    print(f"least transmission angle {best.least_transmission / deg:.1f} deg")
    print(f"{best.greatest_error / mm:.3f}")
