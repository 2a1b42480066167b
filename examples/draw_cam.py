"""Draws docs/_static/cam.svg: the cam of docs/how-to/design-a-cam.md, to scale with its roller and pitch curve.

Run it as `python examples/draw_cam.py`; it ends with the prime radius in mm.
"""

from pathlib import Path

from ilmek.machines.cam import CamDesign, CamParams, design
from ilmek.machines.cam.figures import drawing
from ilmek.units import deg, mm, rpm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "cam.svg"


def cam() -> CamDesign:
    """Lift of 40 mm in 100 degrees at 300 rpm, at most 30 degrees of pressure angle."""
    return design(
        CamParams(
            law="modified-sine",
            lift=40 * mm,
            rise=100 * deg,
            dwell=30 * deg,
            pressure_angle_limit=30 * deg,
            speed=300 * rpm,
            mass=2.0,
            load=50.0,
        )
    )


if __name__ == "__main__":
    made = cam()
    OUT.write_text(svg(drawing(made)), encoding="utf-8")
    print(f"{made.cam.prime_radius / mm:.3f}")
