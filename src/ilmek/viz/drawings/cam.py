"""What a disc cam's sheets have besides those of a plate: base and prime circle, and the table of its radii."""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.profile_tolerance import FLANK
from ilmek.part.part import CUTTER, PITCH, ZERO, CamMaking
from ilmek.part.shapes import Prism
from ilmek.plane.contours import along
from ilmek.report import Contour
from ilmek.report.sheet import LineKind, arrowhead
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, um
from ilmek.viz.drawings.drawn_part import DrawnPart
from ilmek.viz.drawings.features import SAME
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture, millimetres
from ilmek.viz.drawings.view import DrawnView

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
    """Radius of the base circle, and of the prime circle where the roller's path is known, by keys of words [m]."""
    assert isinstance(part.shape, Prism)
    circles = {}
    for name, curve in {
        "sheet.base-circle": part.shape.section.outline,
        "sheet.prime-circle": part.paths.get(PITCH),
    }.items():
        if curve is not None:
            circles[name] = float(np.nanmin(polar_radii(curve)).round(6))  # as in the table
    return circles


def mark_cam(view: DrawnView, part: DrawnPart) -> None:
    """The name of the mark at the angle 0, the direction in which the cam turns, and the tolerance of its radii."""
    line = np.asarray(part.marks[ZERO])
    view.leader(Sentence("sheet.zero-mark"), complex(line[np.argmax(np.abs(line))]) * view.scale, 0.0, kind=None)
    if part.cam is None:
        return
    _turning(view, min(cam_circles(part).values()) * _WITHIN, part.cam.speed < 0)
    assert isinstance(part.shape, Prism)
    curve = part.shape.section.outline
    points = along(curve, 1e-6)
    foot = complex(points[int(np.argmin(np.abs(np.angle(points * np.exp(-1j * _CALLED)))))])
    radius, step = (millimetres(size) for size in (part.cam.tolerance, part.cam.increment))
    hard = part.stated is not None and part.stated.hardening is not None
    finish = Sentence("sheet.ground-hard" if hard else "sheet.ground")
    datum = next((feature.datum for feature in part.features if feature.datum), "")
    about = Sentence("sheet.about-datum", datum=datum) if datum else ""
    if hard:
        points_out = points * (1 + _BESIDE / view.scale / np.abs(points))
        view.line(LineKind.HARDENED, np.append(points_out, points_out[:1]), body=False)
    sizes = {"tolerance": radius, "increment": step, "rough": f"{FLANK / um:g}"}
    words = Sentence("sheet.radii-called", about=about, finish=finish, **sizes)
    view.leader(words, foot * view.scale, 0.0, kind=None)


def _turning(view: DrawnView, radius: float, clockwise: bool) -> None:
    """An arrow along a circle about the axis [m]."""
    turns = np.linspace(*_ARC, 40)[:: -1 if clockwise else 1]
    arc = radius * np.exp(1j * turns)
    view.line(LineKind.DIMENSION, arc, body=False)
    tip, before = complex(arc[-1]) * view.scale, complex(arc[-3]) * view.scale
    view.line(LineKind.DIMENSION, np.array([*arrowhead(tip, tip - before), tip]) / view.scale, body=False)
    view.leader(Sentence("sheet.turns"), complex(arc[20]) * view.scale, 0.0, kind=None)


_BESIDE = 1.2
"""From a hardened profile to the line that marks it [mm of the paper]."""

_WITHIN, _CALLED = 0.7, math.radians(300)
_ARC = math.radians(215), math.radians(260)
"""Radius of the arrow over that of the base circle, its ends, and where the profile is called out."""


def cam_notes(cam: CamMaking) -> Iterator[str]:
    """What the workshop must know of the cutter, and why the radii are as tight."""
    if cam.cutter > 0:
        hollow = f"⌀{millimetres(2 * cam.largest_cutter)}"
        largest = hollow if math.isfinite(cam.largest_cutter) else Sentence("sheet.any-cutter")
        yield Sentence("sheet.cutter", size=millimetres(2 * cam.cutter), largest=largest)
    if math.isfinite(cam.spare):
        spare, speed = format_quantity(cam.spare, "m/s^2", 3), format_quantity(abs(cam.speed), "rpm", 3)
        yield Sentence("sheet.spare", spare=spare, speed=speed)


def radius_tables(part: DrawnPart) -> tuple[SheetPicture, ...]:
    """Radii of the profile at each degree, and of the paths of roller and cutter where they are known and differ."""
    assert isinstance(part.shape, Prism)
    columns = [polar_radii(part.shape.section.outline)]
    header = ["θ °", Sentence("sheet.profile")]
    for name, path in (("sheet.roller-path", PITCH), ("sheet.cutter-path", CUTTER)):
        radii = polar_radii(part.paths[path]) if path in part.paths else columns[-1]
        if np.abs(radii - columns[-1]).max() > SAME:
            columns.append(radii)
            header.append(Sentence(name))
    rows = [
        (f"{degree:g}", *(f"{radius[number] * 1e3:.3f}" for radius in columns))
        for number, degree in enumerate(_DEGREES)
    ]
    widths = (11.0, *(17.5,) * len(columns))
    whole = [table(header, rows[start : start + _ROWS], row=4.6, widths=widths) for start in range(0, 360, _ROWS)]
    return tuple(picture.moved(complex(number * (sum(widths) + 1.5))) for number, picture in enumerate(whole))
