"""Draws the figures of two how-to pages: docs/_static/motion-four-bar*.svg and function-four-bar.svg.

Run it as `python examples/draw_four_bars.py`; it ends with the greatest error of the function's rocker in degrees.
"""

from pathlib import Path

from ilmek.machines.function_four_bar import MACHINE as FUNCTION_FOUR_BAR
from ilmek.machines.motion_four_bar import MACHINE as MOTION_FOUR_BAR
from ilmek.report import Figure, Report
from ilmek.units import deg
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"

FLAP = {"poses": "(0mm,0mm,35deg) (40mm,22mm,12deg) (78mm,12mm,-22deg) (92mm,-28mm,-60deg)", "size_max": "200mm"}
POWER = {
    "function": "x^1.5",
    "start": "1",
    "stop": "4",
    "crank_swing": "90deg",
    "rocker_swing": "90deg",
    "criterion": "minimax",
}


def motion() -> Report:
    """A flap that goes through four poses."""
    return MOTION_FOUR_BAR.report_for(FLAP)


def function() -> Report:
    """x^1.5 from 1 to 4, crank and rocker turning by 90 deg."""
    return FUNCTION_FOUR_BAR.report_for(POWER)


def figure(report: Report, name: str) -> Figure:
    """A report's figure."""
    return next(one for one in report.figures if one.name == name)


if __name__ == "__main__":
    flap, power = motion(), function()
    (OUT / "motion-four-bar.svg").write_text(svg(figure(flap, "motion-four-bar")), encoding="utf-8")
    (OUT / "motion-four-bar-curves.svg").write_text(svg(figure(flap, "motion-four-bar-curves")), encoding="utf-8")
    (OUT / "function-four-bar.svg").write_text(svg(figure(power, "function-four-bar-error")), encoding="utf-8")
    print(flap.as_json()["results"]["sieve"])
    print(f"{power.as_json()['results']['error_max'] / deg:.4f}")
