"""Draws docs/_static/loom-scaling.svg: weaving time of the default carpet over heads, a curve for each pitch.

Run it as `python examples/draw_loom_scaling.py`; it ends with the time of the default loom.
"""

from pathlib import Path

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.estimate import estimated_time
from ilmek.machines.automated_loom.figures import time_against_pitch
from ilmek.units import format_quantity
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"


def drawn() -> str:
    """The figure of the default loom."""
    return svg(time_against_pitch(design(AutomatedLoomParams()))) + "\n"


if __name__ == "__main__":
    (OUT / "loom-scaling.svg").write_text(drawn(), encoding="utf-8")
    print(format_quantity(estimated_time(design(AutomatedLoomParams())), "h", 4))
