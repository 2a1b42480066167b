"""Draws docs/_static/cyclogram.svg: a press and its feeder, their motions overlapped as far as they may be.

Run it as `python examples/draw_cyclogram.py`; it ends with how many times less the largest acceleration is.
"""

from pathlib import Path

from ilmek.io.cyclogram_file import read_cyclogram
from ilmek.report import Timing
from ilmek.timing.figures import draw
from ilmek.timing.solver import Solution, least_acceleration
from ilmek.viz.svg import svg

FILE = Path(__file__).parent / "press.toml"
OUT = Path(__file__).parents[1] / "docs" / "_static" / "cyclogram.svg"


def solved() -> Solution:
    """The press of the example file with the least acceleration."""
    return least_acceleration(read_cyclogram(FILE))


def figure(solution: Solution) -> Timing:
    """Its cyclogram."""
    return draw(solution.cyclogram, "A press and its feeder, overlapped")


if __name__ == "__main__":
    found = solved()
    OUT.write_text(svg(figure(found)), encoding="utf-8")
    print(f"{found.before / found.after:.3f}")
