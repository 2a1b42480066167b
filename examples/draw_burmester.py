"""Draws docs/_static/burmester-curves.svg: where links through four poses have their pivots and their pins.

Run it as `python examples/draw_burmester.py`; it ends with the greatest change of a link's length over the poses in mm.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.report import Dot, Drawing, Stroke
from ilmek.synthesis.burmester.curve import BurmesterCurve, CurveBranch, burmester_curve
from ilmek.synthesis.burmester.links import GuideKind
from ilmek.units import deg, mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "burmester-curves.svg"

POINTS = np.array([0, 40 + 22j, 78 + 12j, 92 - 28j]) * mm
ANGLES = np.array([35, 12, -22, -60]) * deg
BODY = np.array([0, 18, 9 + 9j]) * mm
"""What is drawn of the body, in its frame."""

MIDDLE, WINDOW = 45 * mm, 150 * mm
"""Centre and radius of what is drawn of the curves, which go on to infinity."""


def figure(curve: BurmesterCurve) -> Drawing:
    """The poses, both curves, the asymptote of the pivots, and one link at all poses."""
    pivots = [stroke for branch in curve.centre_branches for stroke in within(branch, "path", "pivots")]
    pins = [stroke for branch in curve.circle_branches for stroke in within(branch, "path", "pins")]
    poses = [Stroke(p + BODY * np.exp(1j * a), "outline", closed=True) for p, a in zip(POINTS, ANGLES, strict=True)]
    link = min(
        (one for one in curve.guides() if one.kind is GuideKind.CRANK), key=lambda one: abs(one.length - 60 * mm)
    )
    at = link.pins(POINTS, ANGLES)
    arms = [Stroke(np.array([link.pivot, pin]), "construction") for pin in at[1:]]
    asymptote = []
    if curve.centre_asymptote is not None:
        along = np.exp(1j * curve.centre_asymptote.angle)
        near = curve.centre_asymptote.foot + ((MIDDLE - curve.centre_asymptote.foot) * np.conj(along)).real * along
        asymptote = [Stroke(near + np.array([-WINDOW, WINDOW]) * along, "construction", "asymptote")]
    return Drawing(
        "burmester-curves",
        "Pivots and pins of all links through four poses",
        (*poses, *pivots, *pins, *asymptote, *arms, Stroke(np.array([link.pivot, at[0]]), "link", "one link")),
        (Dot(link.pivot, "m", "pivot"), Dot(complex(at[0]), "w"), *(Dot(complex(pin), "") for pin in at[1:])),
    )


def within(branch: CurveBranch, role: str, label: str) -> Iterator[Stroke]:
    """The parts of a branch within the window."""
    places = np.append(branch.points, branch.points[:1]) if branch.closed else branch.points
    for part in runs(places):
        yield Stroke(part, role, label)


def runs(places: ComplexArray) -> list[ComplexArray]:
    """The stretches of places that lie within the window."""
    inside = np.abs(places - MIDDLE) < WINDOW
    cuts = np.flatnonzero(np.diff(inside.astype(int))) + 1
    return [part for part in np.split(places, cuts) if len(part) > 1 and abs(part[0] - MIDDLE) < WINDOW]


if __name__ == "__main__":
    found = burmester_curve(POINTS, ANGLES)
    OUT.write_text(svg(figure(found)), encoding="utf-8")
    cranks = [one for one in found.guides() if one.kind is GuideKind.CRANK and one.length < 1]
    print(f"{len(cranks)} links of less than a metre")
    print(f"{max(np.ptp(one.reach(POINTS, ANGLES)) for one in cranks) / mm:.1e}")
