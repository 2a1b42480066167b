"""Draws docs/_static/judged-linkage.svg: the beat-up's four-bar of docs/how-to/judge-a-linkage.md, judged.

Run it as `python examples/draw_judged_linkage.py`; it ends with the least clearance in mm.
"""

from pathlib import Path

import numpy as np

from ilmek.linkage.clearance import OutlinedBody, clearance
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.coupler_curve import coupler_curve
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.one_input import one_input
from ilmek.linkage.structure import plan
from ilmek.linkage.swept_area import swept_region
from ilmek.plane.outlines import Outline
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "judged-linkage.svg"
HUB = 50 * mm


def figure() -> Drawing:
    """The linkage at the position of least clearance, the path of P, the area that the lever sweeps, and the hub."""
    points = {"rocker": {"E": 0.300 + 0j}, "coupler": {"P": 0.200 - 0.100j}}
    crank = one_input(plan(four_bar(0.300, 0.0597, 0.2007, 0.2308, branch=+1, points=points)))
    path = InputPath(crank)
    curve = coupler_curve(path, "coupler", "P")
    lever = OutlinedBody("rocker", (Outline((0, 0.300), radius=0.012),))
    near = clearance(path, lever, OutlinedBody("ground", (Outline((0,), radius=HUB),)))
    motion = crank.motion(np.array([near.input]))
    joint = {name: complex(np.ravel(motion.point(body, name).position)[0]) for body, name in _POINTS}
    line = np.asarray(crank.motion(np.linspace(-np.pi, np.pi, 361)).point("coupler", "P").position)
    circle = HUB * np.exp(1j * np.linspace(0, 2 * np.pi, 73))
    swept = [
        Stroke(outline, "construction", "", closed=True) for outline in swept_region(path, lever, cells=64).outline
    ]
    return Drawing(
        "judged-linkage",
        f"The beat-up's four-bar: {near.least / mm:.1f} mm between lever and hub at the least",
        (
            *swept,
            Stroke(circle, "outline", "hub", closed=True),
            Stroke(np.array([joint["A0"], joint["A"]]), "link", "crank"),
            Stroke(np.array([joint["A"], joint["B"], joint["P"]]), "link", "coupler", closed=True),
            Stroke(np.array([joint["B0"], joint["E"]]), "link", "lever"),
            Stroke(line, "path", "path of P", closed=True),
            Stroke(np.array(near.points), "dimension", f"{near.least / mm:.1f} mm"),
        ),
        (
            Dot(joint["A0"], "A0", "pivot"),
            Dot(joint["B0"], "B0", "pivot"),
            Dot(joint["A"], "A"),
            Dot(joint["B"], "B"),
            Dot(joint["E"], "E", "point"),
            Dot(joint["P"], "P", "point"),
            *(Dot(crossing.position, "crossing", "point") for crossing in curve.crossings()),
            *(Dot(complex(inflection.position), "inflection", "point") for inflection in curve.inflections()),
        ),
    )


_POINTS = (
    ("ground", "A0"), ("ground", "B0"), ("crank", "A"), ("coupler", "B"), ("coupler", "P"), ("rocker", "E"),
)  # fmt: skip

if __name__ == "__main__":
    drawing = figure()
    OUT.write_text(svg(drawing), encoding="utf-8")
    print(drawing.title)
