"""The cam for the workshop, and its motion for a controller."""

import math

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.pieces import infimum
from ilmek.cams.programme import TURN
from ilmek.machines.cam.design import CamDesign
from ilmek.report import CamTable, Plate
from ilmek.units import format_quantity

POINTS = 1440
"""Points of a contour, besides both sides of every knot."""


def plates(design: CamDesign) -> tuple[Plate, ...]:
    """The cam as a plate; nothing where no surface can guide its follower."""
    if design.undercut:
        return ()
    angle = outline_angles(design)
    trace, params, hub = design.cam.trace(angle), design.params, design.hub
    cutter = params.cutter_radius or design.cam.roller_radius
    reach = infimum(lambda at: np.abs(design.cam.trace(at).surface), design.programme.knots).value
    paths = {"pitch curve": trace.pitch} if design.cam.roller_radius > 0 else {}
    if cutter > 0:
        paths["cutter path"] = trace.parallel(cutter - design.cam.roller_radius)
    key = f"keyway {format_quantity(hub.key_width, 'mm')} wide, {format_quantity(hub.key_depth, 'mm')} deep, DIN 6885-1"
    notes = (f"cutter of {format_quantity(2 * cutter, 'mm')}",) if cutter > 0 else ()
    plate = Plate(
        name="cam",
        title=f"Cam, lift {format_quantity(params.lift, 'mm')}",
        outline=trace.surface,
        thickness=design.face_width,
        material=params.material,
        cutouts=(hub.contour,) if reach > hub.reach else (),
        paths=paths,
        marks={"zero": zero_mark(design)},
        area=design.area,
        notes=(*notes, f"bore {format_quantity(hub.bore, 'mm')} H7", *((key,) if hub.key_width else ())),
    )
    return (plate,)


def outline_angles(design: CamDesign) -> FloatArray:
    """Cam angles of a contour [rad], from TURN down, so that its points run counter-clockwise; the last not the first.

    Every knot is among them: the curvature jumps there.
    """
    even = np.linspace(0.0, TURN, POINTS, endpoint=False)
    knots = np.mod(design.programme.knots, TURN)
    apart = np.min(np.abs(even[:, None] - knots), axis=1) > 0.25 * TURN / POINTS
    return np.unique(np.concatenate([even[apart], knots]))[::-1]


def zero_mark(design: CamDesign) -> ComplexArray:
    """A line to scribe at the zero of the cam angle, from the hub towards the surface [m]."""
    edge = float(np.abs(design.cam.trace(np.zeros(1)).surface)[0])
    inner = min(design.hub.reach * 1.15, 0.6 * edge)
    return np.array([inner, inner + 0.6 * (edge - inner)], dtype=complex)


def cam_table(design: CamDesign) -> CamTable:
    """The follower's motion over a turn, for a controller that does without the cam."""

    def course(angle: FloatArray) -> FloatArray:
        at = design.programme.at(angle)
        return np.stack([at.s, at.ds, at.dds])

    unit = "deg" if design.params.motion == "oscillating" else "mm"
    period = TURN / design.params.speed if design.params.speed > 0 else math.inf
    return CamTable("cam", "Follower over the cam angle", course, design.programme.knots, unit, period)
