"""Edges of a cam for the workshop, and its motion for a controller."""

import math

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.programme import TURN
from ilmek.cams.trace import CamRole
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.design import CamDesign
from ilmek.num.piecewise import infimum, supremum
from ilmek.report import CamTable, Contour
from ilmek.units import format_quantity

POINTS = 2880
"""Points of a contour, besides both sides of every knot."""


def rim_radius(design: CamDesign) -> float:
    """Radius [m] of the disc that a groove is cut into."""
    flank = supremum(lambda at: np.abs(design.cam.trace(at).parallel(design.cam.roller_radius)), design.cam.knots)
    return flank.value + design.params.rim


def area_of(design: CamDesign) -> float | None:
    """Area of the face [m^2], bore included; None of a barrel or end cam, and where undercut leaves no face."""
    found = developed_cams.area(design) if design.params.laid_flat else design.area
    return found if found > 0 else None


def outline_angles(cam: CamRole) -> FloatArray:
    """Cam angles of a contour [rad], downwards, so that its points run counter-clockwise; the last is not the first.

    Every knot is among them: the curvature jumps there.
    """
    even = np.linspace(0.0, TURN, POINTS, endpoint=False)
    knots = np.mod(cam.knots, TURN)
    apart = np.min(np.abs(even[:, None] - knots), axis=1) > 0.25 * TURN / POINTS
    return np.unique(np.concatenate([even[apart], knots]))[::-1]


def cutouts(design: CamDesign, cam: CamRole) -> tuple[Contour, ...]:
    """The bore, where it is smaller than the cam."""
    reach = infimum(lambda at: np.abs(cam.trace(at).surface), cam.knots).value
    return (design.hub.contour,) if reach > design.hub.reach else ()


def hub_notes(design: CamDesign) -> tuple[str, ...]:
    """What of the bore no keyway tells [`part.features`], for the workshop."""
    if not cutouts(design, design.cam):
        return ("without its bore, which does not fit",)
    return () if design.hub.key_width else (f"bore {format_quantity(design.hub.bore, 'mm')} H7",)


def zero_mark(design: CamDesign) -> ComplexArray:
    """A line to scribe at the zero of the cam angle, from the hub towards the surface [m]."""
    edge = float(np.abs(design.cam.trace(np.zeros(1)).surface)[0])
    inner = min(design.hub.reach * 1.15, 0.6 * edge)
    return np.array([inner, inner + 0.6 * (edge - inner)], dtype=complex)


def cam_tables(design: CamDesign) -> tuple[CamTable, ...]:
    """The follower's motion over a turn, for a controller that replaces the cam."""

    def motion(angle: FloatArray) -> FloatArray:
        return np.stack(design.programme.at(angle)[:3])

    unit = "deg" if design.params.motion == "oscillating" else "mm"
    period = TURN / design.params.speed if design.params.speed > 0 else math.inf
    return (CamTable("cam", "Follower over the cam angle", motion, design.programme.knots, unit, period),)
