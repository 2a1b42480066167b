"""Draws docs/_static/approximation.svg: one function, one kind of four-bar, three criteria, and the alternation.

Run it as `python examples/draw_approximation.py`; it ends with the greatest error of the minimax in degrees.
"""

from pathlib import Path

import numpy as np

from ilmek.report import Axis, Mark, Plot, Series
from ilmek.synthesis.approximation.function_generator import CRITERIA, FunctionApproximation, function_approximations
from ilmek.synthesis.function import Function
from ilmek.units import deg
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "approximation.svg"

ROOT = Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg)


def best(criterion: str) -> FunctionApproximation:
    """The best four-bar of the kind that five precision points give: its error has six extremes."""
    return next(one for one in function_approximations(ROOT, criterion).found if len(one.at) == 6)


def figure(found: dict[str, FunctionApproximation]) -> Plot:
    """The error curves of the three criteria, and the alternation of the minimax."""
    curves = [Series(name, one.curve.x, one.curve.error) for name, one in found.items()]
    least = found["minimax"]
    ends, gap = [ROOT.start, ROOT.stop], np.nan
    there_and_back = np.array([*ends, gap, *ends]), least.bound * np.array([1, 1, gap, -1, -1])
    return Plot(
        "approximation",
        "Error of a four-bar for the square root of 1 + x, three criteria",
        Axis("x"),
        Axis("error of the rocker", "deg"),
        (*curves, Series("bound of the minimax", *there_and_back, dashed=True)),
        tuple(Mark(float(x), str(k)) for k, x in enumerate(least.at, 1)),
    )


if __name__ == "__main__":
    all_three = {name: best(name) for name in CRITERIA}
    OUT.write_text(svg(figure(all_three)), encoding="utf-8")
    for name, one in all_three.items():
        print(f"{name}: greatest {one.greatest / deg:.4f} deg, rms {one.rms / deg:.4f} deg")
    print(f"{all_three['minimax'].greatest / deg:.4f}")
