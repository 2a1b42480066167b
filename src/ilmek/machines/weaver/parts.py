"""The parts in a head's case: side plates, cam shaft with cams and spacers, and its motors.

What stands in the case lies about the cam shaft's axis, z to the weaver's left, 0 in the middle of the head. From side
plate to side plate: gap and cam in turn, in the order of the stations, and a gap. So the case is as wide as its cams.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ilmek.cams.loaded_plate_cam import STEEL, LoadedPlateCam
from ilmek.cams.profile_tolerance import BAND, increment_tolerance
from ilmek.elements.bearing_table import DEEP_GROOVE, ROLLING_BEARINGS, THIN_BEARINGS, RollingBearing
from ilmek.elements.bearings import life
from ilmek.elements.plates import round_bore, zero_mark
from ilmek.machines.weaver.case import ALUMINIUM
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.hub_keys import STACK_KEY, cam_key, groove_half, grooved, hub_diameter, keyed_ring
from ilmek.machines.weaver.stations import belt_station, sheet, station
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import case_width
from ilmek.machines.weaver.yarn_lead import STEM, guide_at
from ilmek.part import catalogue
from ilmek.part.part import CUTTER, PITCH, CamMaking, Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Drilling, Placed, Prism, Sum, bar, rectangle, tube
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon
from ilmek.sentences import Sentence
from ilmek.units import deg, in_mm, mm, turn

BEARING_LIFE = 1e8
"""Turns of the cam shaft, one for each knot, that its bearings must last; assumed by this project."""

SAMPLES = 720
"""Angles of the turn at which the force on the bearings is summed."""

LIP, LEAST_LIP, LIP_ROOM, AXIAL_PLAY = 1.5 * mm, 1 * mm, 3 * mm, 0.2 * mm
"""Thickness of the lips of the side plates behind the bearings' outer rings, and the least one; by how much the bore of
a lip is smaller than a ring; play of the cam shaft with its rings between the lips [m]; assumed by this project.
"""

LEAST_SPACER = 0.01 * mm
"""Length below which no ring between the cams is made [m]; assumed by this project."""


def cam_id(track: str) -> str:
    """Id of the cam of a track."""
    return part_id(f"{track.replace(' ', '-')}-cam")


SHAFT, BEARING = part_id("cam-shaft"), part_id("bearing")
SIDE_PLATES = part_id("right-side-plate"), part_id("left-side-plate")
MOTOR, TUBE = part_id("motor"), part_id("yarn-tube")


def case_plates(weaver: Weaver) -> tuple[str, ...]:
    """Ids of the side plates, where the head has them."""
    return SIDE_PLATES if weaver.params.side_plate > 0 else ()


def bearing_of(weaver: Weaver) -> RollingBearing | None:
    """The lightest deep-groove bearing that fits on the cam shaft and lasts under all forces of the cams, if any."""
    load = _bearing_load(weaver)
    bore = max((row.bore for row in _deep_groove() if row.bore <= weaver.params.shaft * (1 + 1e-9)), default=0.0)
    enough = (row for row in _deep_groove() if row.bore == bore and life(row.dynamic, load, row.kind) >= BEARING_LIFE)
    return min(enough, key=lambda row: row.mass, default=None)


def bearing_life(weaver: Weaver) -> tuple[RollingBearing | None, float]:
    """That bearing and its life in turns of the cam shaft; 0 without one."""
    row = bearing_of(weaver)
    return row, 0.0 if row is None else life(row.dynamic, _bearing_load(weaver), row.kind)


def _bearing_load(weaver: Weaver) -> float:
    """Each bearing is taken to bear the sum of the cams' forces, by its cubic mean over the turn [N].     [ISO 281]"""
    angle = np.linspace(0.0, turn, SAMPLES, endpoint=False)
    force = sum(np.interp(angle, cam.angle, cam.contact, period=turn) for cam in weaver.cams)
    load: float = float(np.mean(force**3)) ** (1 / 3)
    return load


def _deep_groove() -> Iterator[RollingBearing]:
    return (row for row in (*THIN_BEARINGS.values(), *ROLLING_BEARINGS.values()) if row.kind == DEEP_GROOVE)


def case_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """What stands in the case about the cam shaft: the side plates with its bearings."""
    params, shape, wide = weaver.params, weaver.shape, case_width(weaver.params)
    row, plate, flat = bearing_of(weaver), params.side_plate, sheet(weaver)
    if plate > 0:
        middle = shape.body + (shape.size + flat) / 2 - shape.axis
        deep, high = shape.size.real - flat, shape.size.imag
        bore = 0.0 if row is None or row.outer >= deep else row.outer
        eye = circle(guide_at(weaver) - shape.axis, STEM / 2)
        outline, lip = polygon(rectangle(deep, high).points + middle), max(lip_of(weaver), 0.0) if bore else 0.0
        hole = (circle(0j, (bore - (LIP_ROOM if lip else 0.0)) / 2),) if bore else ()
        inside = placement(z=plate, about=(1.0, 0.0, 0.0), angle=turn / 2), placement()
        for side, name, mouth in zip((-1, 1), SIDE_PLATES, inside, strict=True):
            eyes = (eye,) if side < 0 else ()  # the stem of the yarn's guide is in the right one
            seats = (Drilling(mouth, ((bore, plate - lip),), bore - LIP_ROOM),) if lip else ()
            title = f"{'right' if side < 0 else 'left'} side plate of the head"
            solid = Prism(Profile(outline, (*hole, *eyes)), plate, seats)
            part = Part(name, title, "machined link", solid, ALUMINIUM, notes=_play_note())
            yield Occurrence(part, (placement(z=-wide / 2 if side < 0 else wide / 2 - plate),))
    if row is not None:
        face = wide / 2 - plate - _into_gap(weaver)
        part = catalogue.bearing(BEARING, "bearing of the head's cam shaft", row)
        yield Occurrence(part, (placement(z=-face - row.width), placement(z=face)))


def _play_note() -> tuple[Sentence, ...]:
    low, high = (in_mm(share * AXIAL_PLAY) for share in (0.5, 1.5))
    return (Sentence("sheet.axial-play", low=low, high=high),)


def lip_of(weaver: Weaver) -> float:
    """Thickness of the lip of a side plate that is left behind its bearing [m]."""
    row = bearing_of(weaver)
    return 0.0 if row is None else weaver.params.side_plate + _into_gap(weaver) - row.width - AXIAL_PLAY / 2


def _into_gap(weaver: Weaver) -> float:
    """How far a bearing before its side plate's lip stands into the gap to the first cam, at most half of it [m]."""
    row, params = bearing_of(weaver), weaver.params
    deep = 0.0 if row is None else row.width + AXIAL_PLAY / 2 + LIP
    return min(max(deep - params.side_plate, 0.0), params.cam_gap / 2)


def shaft_parts(weaver: Weaver) -> Iterator[Occurrence]:
    """What turns: the shaft, a cam for each track, and spacers between cams, pulley and bearings."""
    params, wide = weaver.params, case_width(weaver.params)
    end = wide / 2 - params.side_plate - _into_gap(weaver)
    half, key = groove_half(weaver), cam_key(weaver)
    journal, seats = wide / 2 - half, (placement(z=-wide / 2), placement(z=half))
    journals = (Placed(bar(params.shaft, journal), seats),) if journal > 0 else ()
    middle = Placed(grooved(params.shaft, 2 * half), (placement(z=-half),))
    title = "cam shaft of the head"
    yield Occurrence(Part(SHAFT, title, "turned part", Sum((*journals, middle)), STEEL, notes=_play_note()))
    begins = [-station(weaver, cam.name) - params.cam_thickness / 2 for cam in weaver.cams]
    for cam, z in zip(weaver.cams, begins, strict=True):
        yield Occurrence(_cam(weaver, cam), (placement(z=z),))
    pulley = -belt_station(weaver) - weaver.belt.width
    yield catalogue.keys(STACK_KEY, "key of the head's cam shaft", key, placement(z=-key.length / 2))
    places = [
        (-end, -end),
        (pulley, pulley + weaver.belt.width),
        *((z, z + params.cam_thickness) for z in sorted(begins)),
        (end, end),
    ]
    yield from _spacers(params.shaft, places, half)


def _spacers(shaft: float, places: list[tuple[float, float]], half: float) -> Iterator[Occurrence]:
    """Rings between neighbours along the shaft, the key through those within its groove; a part for each length."""
    gaps: dict[tuple[float, bool], list[float]] = {}
    for (_, begin), (end, _) in pairwise(places):
        if end - begin > LEAST_SPACER:
            keyed = max(-begin, end) < half + LEAST_SPACER
            gaps.setdefault((round(end - begin, 9), keyed), []).append(begin)
    outer = hub_diameter(shaft)
    for number, ((length, keyed), starts) in enumerate(sorted(gaps.items()), 1):
        ring = keyed_ring(shaft, length) if keyed else tube(outer, (outer - shaft) / 2, length)
        title = f"spacer of the cam shaft, {in_mm(length)}"
        part = Part(part_id(f"spacer-{number}"), title, "turned part", ring, STEEL)
        yield Occurrence(part, tuple(placement(z=z) for z in starts))


def _cam(weaver: Weaver, cam: LoadedPlateCam) -> Part:
    """The plate of a cam; its room where no surface can guide the roller."""
    shaft, thickness = weaver.params.shaft, cam.thickness
    bore = round_bore(shaft)
    title = f"cam of the {cam.name}"
    if cam.undercut:
        room = Prism(drilled(circle(0j, cam.radius), bore.holes, bore.cutouts), thickness)
        return Part(cam_id(cam.name), title, "cam plate", room, STEEL, envelope=True)
    surface, pitch = cam.trace.surface[::-1], cam.trace.pitch[::-1]
    holes = drilled(polygon(surface[:-1]), bore.holes, bore.cutouts).holes
    return Part(
        cam_id(cam.name),
        title,
        "cam plate",
        Prism(Profile(polygon(surface[:-1]), holes, smooth=True), thickness),
        STEEL,
        paths={PITCH: pitch, CUTTER: pitch},
        marks=zero_mark(float(np.abs(surface[-1]))),
        cam=_making(cam),
    )


def _making(cam: LoadedPlateCam) -> CamMaking:
    """How a cam is cut: by a cutter as large as its roller, so that both take the same path."""
    radius, spare = cam.cam.roller_radius, cam.spare_acceleration
    increment = increment_tolerance(spare, cam.speed, deg)
    return CamMaking(radius, cam.concave_radius + radius, BAND, increment, spare, cam.speed)
