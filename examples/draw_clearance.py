"""Draws docs/_static/clearance-pin.svg: the force of the beat-up's rocker pin over a turn, ideal and with clearance.

Run it as `python examples/draw_clearance.py`; it prints the two greatest forces.
"""

import math
from pathlib import Path

import numpy as np

from ilmek.dynamics.clearance import ClearancePin, hertz_stiffness
from ilmek.dynamics.inertia import Inertia, bar, combined, point_mass
from ilmek.dynamics.multibody.system import System, from_motion, simulate, with_clearance
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.report import Axis, Plot, Series
from ilmek.units import mm, rpm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static" / "clearance-pin.svg"
SPEED = 150 * rpm
CLEARANCE, RADIUS = 0.08 * mm, 8 * mm
CRANK, COUPLER, ROCKER = 59.7 * mm, 200.7 * mm, 230.8 * mm


def beat_up() -> System:
    """The beat-up with a beater of 2.5 kg, behind a flywheel that keeps its speed."""
    masses = {
        "crank": Inertia(0.129, CRANK / 2 + 0j, 50.0),
        "coupler": bar(0, COUPLER, mass=0.434),
        "rocker": combined(bar(0, ROCKER, mass=0.649), point_mass(2.5, at=0.3)),
    }
    linkage = plan(four_bar(0.3, CRANK, COUPLER, ROCKER, branch=+1))
    return from_motion(solve(linkage, 0.0, SPEED), masses, gravity=-9.81j)


def figure() -> Plot:
    """The second turn of a run, after the journal has found its wall."""
    turn = 2 * math.pi / SPEED
    times = np.linspace(0.0, 2 * turn, 40001)
    pin = ClearancePin("B", "coupler", "rocker", CLEARANCE, RADIUS, hertz_stiffness(RADIUS, CLEARANCE, 207e9), 0.7, 0.1)
    ideal, loose = simulate(beat_up(), times), simulate(with_clearance(beat_up(), pin), times, rtol=1e-8)
    second = slice(20000, None)
    angle = ideal.angle("crank")[second] - 2 * math.pi
    hard, soft = np.abs(ideal.pin("B"))[second], np.abs(loose.pin("B"))[second]
    print(f"greatest force: ideal {hard.max():.1f} N, with {CLEARANCE / mm:g} mm {soft.max():.1f} N")
    return Plot(
        "clearance-pin",
        f"Force of the pin between coupler and rocker at {SPEED / rpm:g} rpm",
        Axis("crank angle", "deg"),
        Axis("pin force", "N"),
        (Series(f"clearance {CLEARANCE / mm:g} mm", angle, soft), Series("ideal pin", angle, hard)),
        note="Where the force turns, the journal leaves its wall, flies across and strikes the other side.",
    )


if __name__ == "__main__":
    OUT.write_text(svg(figure()), encoding="utf-8")
