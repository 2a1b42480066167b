"""The cam for the workshop, and its motion for a controller."""

import math

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams import limits
from ilmek.cams.programme import TURN
from ilmek.cams.trace import CamRole
from ilmek.elements.materials import MATERIALS
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.round_cams import solid_plate
from ilmek.num.piecewise import infimum, integral, supremum
from ilmek.plane import contours
from ilmek.report import CamTable, Contour, Plate
from ilmek.units import format_quantity

POINTS = 1440
"""Points of a contour, besides both sides of every knot."""


def plates(design: CamDesign) -> tuple[Plate, ...]:
    """The cam as a plate, or both conjugate ones; nothing where no surface can guide the follower."""
    if design.undercut:
        return ()
    title = f"Cam, lift {format_quantity(design.params.lift, 'mm')}"
    if design.params.laid_flat:
        wedge = design.params.kind == "wedge"
        return (
            developed_cams.plate(design, title)
            if wedge
            else solid_plate(design, title, developed_cams.axial_ends(design)),
        )
    if design.params.kind == "grooved":
        return (_grooved(design, title),)
    if design.cams.pair is None:
        return (_plate(design, design.cam, "cam", title),)
    first, second = design.cams.pair.first, design.cams.pair.second
    return _plate(design, first, "cam", title), _plate(design, second, "cam-2", f"Second {title[0].lower()}{title[1:]}")


def rim_radius(design: CamDesign) -> float:
    """Radius [m] of the disc that a groove is cut into."""
    flank = supremum(lambda at: np.abs(design.cam.trace(at).parallel(design.cam.roller_radius)), design.cam.knots)
    return flank.value + design.params.rim


def area_of(design: CamDesign) -> float | None:
    """Area of the face [m^2], bore included; None of a barrel or end cam, and where undercut leaves no face."""
    found = developed_cams.area(design) if design.params.laid_flat else design.area
    return found if found > 0 else None


def mass_of(design: CamDesign) -> float | None:
    """Mass of the cam, bored, or of both [kg]; None where undercut leaves no face."""
    if design.params.laid_flat:
        found = developed_cams.mass(design)
        return found if found > 0 else None
    density, width = MATERIALS[design.params.material].density, design.face_width
    hub = design.hub.area if cutouts(design, design.cam) else 0.0
    if design.params.kind == "grooved":
        groove = 2 * design.cam.roller_radius * integral(lambda at: design.cam.trace(at).flow, design.cam.knots)
        disc = math.pi * rim_radius(design) ** 2
        return float(density * max((disc - hub) * (width + design.params.rim) - groove * width, 0.0))
    other = limits.area(design.cams.pair.second) - hub if design.cams.pair else 0.0
    face = area_of(design)
    return None if face is None or face - hub + other <= 0 else density * width * (face - hub + other)


def outline_angles(cam: CamRole) -> FloatArray:
    """Cam angles of a contour [rad], downwards, so that its points run counter-clockwise; the last is not the first.

    Every knot is among them: the curvature jumps there.
    """
    even = np.linspace(0.0, TURN, POINTS, endpoint=False)
    knots = np.mod(cam.knots, TURN)
    apart = np.min(np.abs(even[:, None] - knots), axis=1) > 0.25 * TURN / POINTS
    return np.unique(np.concatenate([even[apart], knots]))[::-1]


def _plate(design: CamDesign, cam: CamRole, name: str, title: str) -> Plate:
    trace, params = cam.trace(outline_angles(cam)), design.params
    cutter = params.cutter_radius or cam.roller_radius
    paths = {"pitch curve": trace.pitch} if cam.roller_radius > 0 else {}
    if cutter > 0:
        paths["cutter path"] = trace.parallel(cutter - cam.roller_radius)
    return Plate(
        name=name,
        title=title,
        outline=trace.surface,
        thickness=design.face_width,
        material=params.material,
        cutouts=cutouts(design, cam),
        paths=paths,
        marks={"zero": zero_mark(design)},
        area=limits.area(cam),
        notes=((f"cutter of {format_quantity(2 * cutter, 'mm')}",) if cutter > 0 else ()) + _hub_notes(design),
    )


def _grooved(design: CamDesign, title: str) -> Plate:
    """A disc with the groove's flanks as paths: it is not cut through."""
    cam, params = design.cam, design.params
    trace, disc = cam.trace(outline_angles(cam)), contours.circle(0j, rim_radius(design))
    cutter = min(params.cutter_radius or cam.roller_radius, cam.roller_radius)
    depth, width = (format_quantity(size, "mm") for size in (design.face_width, 2 * cam.roller_radius))
    inner, outer = trace.surface, trace.parallel(cam.roller_radius)
    paths = {"pitch curve": trace.pitch, "inner flank": inner, "outer flank": outer}
    paths["cutter path"] = trace.parallel(cutter - cam.roller_radius)
    return Plate(
        name="cam",
        title=title,
        outline=disc,
        thickness=design.face_width + params.rim,
        material=params.material,
        cutouts=cutouts(design, cam),
        paths=paths,
        marks={"zero": zero_mark(design)},
        area=contours.area(disc),
        notes=(f"groove {width} wide, {depth} deep", *_hub_notes(design)),
    )


def cutouts(design: CamDesign, cam: CamRole) -> tuple[Contour, ...]:
    """The bore, where it is smaller than the cam."""
    reach = infimum(lambda at: np.abs(cam.trace(at).surface), cam.knots).value
    return (design.hub.contour,) if reach > design.hub.reach else ()


def _hub_notes(design: CamDesign) -> tuple[str, ...]:
    hub = design.hub
    if not cutouts(design, design.cam):
        return ("without its bore, which does not fit",)
    width, depth = format_quantity(hub.key_width, "mm"), format_quantity(hub.key_depth, "mm")
    key = (f"keyway {width} wide, {depth} deep, DIN 6885-1",) if hub.key_width else ()
    return (f"bore {format_quantity(hub.bore, 'mm')} H7", *key)


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
