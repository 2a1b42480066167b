"""G-code of a tufting gun on a gantry: RS-274/NGC as LinuxCNC reads it, in mm and mm/min, C in degrees.

The gun works on the back of the carpet, so that the picture is mirrored: X runs from the carpet's right to its left.
The origin is a corner of the carpet, Z 0 where the foot of the gun is on the backing, C the direction in which it runs.

    G21 G90 G94 G17 G64    mm, absolute, feed a minute, plane XY, path with a tolerance
    G0  G1                 travel with the gun lifted; tufting at a feed
    S M3 M5                stitches a minute; gun on, gun off
    T M0                   number of the colour; stop until it is threaded
    M2                     end
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ilmek.machines.tufting_gun.design import Points, TuftedByGun, headings
from ilmek.units import deg, mm

BLEND = 0.1
"""Tolerance of the path at its corners [mm]."""


def write_gcode(path: Path, tufted: TuftedByGun, title: str) -> None:
    """Write the programme of a carpet. Raises OSError."""
    path.write_text("\n".join(gcode(tufted, title)) + "\n", encoding="ascii")


def gcode(tufted: TuftedByGun, title: str) -> Iterator[str]:
    """The lines of the programme."""
    params, plan = tufted.params, tufted.plan
    yield f"(ilmek: {_comment(title)}, {plan.width / mm:.0f} x {plan.length / mm:.0f} mm, seen from the back)"
    yield "(dialect: RS-274/NGC of LinuxCNC; X Y Z in mm, F in mm/min, C in degrees, S in stitches/min)"
    yield "(M3 gun on, M5 gun off, M0 after T: thread that colour; Z0: foot on the backing)"
    yield f"G21 G90 G94 G17 G64 P{BLEND:g}"
    up, feed = f"G0 Z{params.lift / mm:.3f}", f"F{60 * params.feed / mm:.0f}"
    rate = f"S{60 * params.stitch_rate:.0f} M3"
    yield f"M5\n{up}"
    turned = 0.0
    for number, colour in enumerate(plan.colours, 1):
        cone = tufted.cones[colour.label]
        yarn = f"{_comment(cone.name)} {cone.colour}, {tufted.yarn[colour.label]:.0f} m"
        yield f"T{number}\n(MSG, thread T{number}: {yarn})\nM0"
        for stroke in colour.strokes:
            mirrored = plan.width - stroke.conj()
            angles = headings(mirrored) / deg
            angles += 360 * np.round((turned - angles[0]) / 360)
            lines = _stroke(mirrored, angles, params.corner / deg, feed, rate)
            yield from (*lines, "M5", up)
            turned = float(angles[-1])
    yield "G0 X0 Y0\nM2"


def _stroke(points: Points, angles: np.ndarray, corner: float, feed: str, rate: str) -> Iterator[str]:
    """The lines of a stroke, from its travel to its last point; at a corner the gun is stopped and turned."""
    x, y = (np.round(part / mm, 3).tolist() for part in (points.real, points.imag))
    turns = np.append(0.0, np.abs(np.diff(angles))).tolist()
    yield f"G0 X{x[0]:g} Y{y[0]:g} C{angles[0]:.2f}\nG1 Z0 {feed}\n{rate}"
    for i, angle in enumerate(angles.tolist(), 1):
        if turns[i - 1] > corner:
            yield f"M5\nG0 C{angle:.2f}\n{rate}"
        yield f"G1 X{x[i]:g} Y{y[i]:g} C{angle:.2f}"


def _comment(text: str) -> str:
    """A text that a comment may hold: ASCII, without brackets."""
    return text.encode("ascii", "replace").decode().replace("(", "[").replace(")", "]")
