"""What a disc cam's sheets have besides those of a plate: base and prime circle, and the table of its radii."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.part.shapes import Prism
from ilmek.plane.contours import along
from ilmek.report import Contour
from ilmek.viz.drawings.drawn_part import DrawnPart
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture
from ilmek.viz.drawings.view import DrawnView

PITCH, ZERO = "pitch curve", "zero"
"""Names of the roller's path and of the mark of the angle 0 on a cam's plate."""

_DEGREES = np.arange(360.0)
_COLUMNS, _ROWS = 8, 45


def is_cam(part: DrawnPart) -> bool:
    """Whether a part is a disc cam: a smooth outline with a mark at the angle 0."""
    return part.smooth and ZERO in part.marks and isinstance(part.shape, Prism)


def polar_radii(curve: ComplexArray | Contour, degrees: FloatArray = _DEGREES) -> FloatArray:
    """Greatest radius of a closed curve about the origin at angles [deg], NaN where a ray does not meet it [m].

    >>> from ilmek.plane.contours import circle
    >>> polar_radii(circle(0j, 0.05), np.array([0.0, 90.0])).round(6).tolist()
    [0.05, 0.05]
    """
    points = along(curve, 2e-8) if isinstance(curve, Contour) else curve
    after = np.roll(points, -1)
    radii = np.full(len(degrees), np.nan)
    for number, turn in enumerate(np.exp(-1j * np.deg2rad(degrees)).tolist()):
        start, end = points * turn, after * turn
        crossed = (start.imag > 0) != (end.imag > 0)
        share = -start.imag[crossed] / (end.imag[crossed] - start.imag[crossed])
        met = start.real[crossed] + share * (end.real[crossed] - start.real[crossed])
        if met.size and met.max() > 0:
            radii[number] = met.max()
    return radii


def cam_circles(part: DrawnPart) -> dict[str, float]:
    """Radius of the base circle, and of the prime circle where the roller's path is known [m]."""
    assert isinstance(part.shape, Prism)
    circles = {}
    for name, curve in {"base circle": part.shape.section.outline, "prime circle": part.paths.get(PITCH)}.items():
        if curve is not None:
            points = along(curve, 1e-6) if isinstance(curve, Contour) else curve
            circles[name] = float(np.abs(points).min())
    return circles


def mark_zero(view: DrawnView, part: DrawnPart) -> None:
    """The name of the mark at the angle 0."""
    line = np.asarray(part.marks[ZERO])
    view.leader("0°: zero mark", complex(line[np.argmax(np.abs(line))]) * view.scale, 0.0, kind=None)


def radius_tables(part: DrawnPart) -> tuple[SheetPicture, ...]:
    """Radii of the profile, and of the pitch curve where it is known, at each degree."""
    assert isinstance(part.shape, Prism)
    columns = [polar_radii(part.shape.section.outline)]
    header = ["θ °", "profile"]
    pitch = part.paths.get(PITCH)
    if pitch is not None:
        columns.append(polar_radii(pitch))
        header.append("pitch")
    rows = [
        (f"{degree:g}", *(f"{radius[number] * 1e3:.3f}" for radius in columns))
        for number, degree in enumerate(_DEGREES)
    ]
    widths = (11.0, *(17.5,) * len(columns))
    whole = [table(header, rows[start : start + _ROWS], row=4.6, widths=widths) for start in range(0, 360, _ROWS)]
    return tuple(picture.moved(complex(number * (sum(widths) + 1.5))) for number, picture in enumerate(whole))
