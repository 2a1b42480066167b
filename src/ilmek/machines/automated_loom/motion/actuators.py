"""Speed and force of every actuator over a knot and over a row.

    v = x'(q) w,   a = x''(q) w^2        q master angle, w its speed, x the position by the cyclogram

Forces of a knot are those on the tools, as the head's cams take them (`machines.weaver.forces`). Over a row:

    lifted warps   n T'(x): the pull of the sheet across, by its lift                          [`weaving.shed`]
    carrier, rail  m a: their masses, of the rail with the heads
    beater         the fabric's resistance to rows at the required distance, while it presses  [`weaving.fell`]
    take-up        the pull of all warps at rest
"""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, HEADS, ODD, TAKE_UP
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.motion.knot_views import DRIVE as KNOT_DRIVE
from ilmek.machines.automated_loom.motion.row_views import DRIVE as ROW_DRIVE
from ilmek.machines.automated_loom.own_parts import mass_of_rail
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.shedding.warp import warp_force
from ilmek.machines.weaver.forces import HeadForces, tool_force
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.tree import head_mass
from ilmek.report import Axis, Plot, Series
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import laid, sample
from ilmek.units import turn

_PARTS = 41

_PRESSED = 1e-6
"""Share of the stroke short of its end at which the beater counts as at the fell."""


def knot_speeds(loom: LoomDesign) -> Plot:
    """Speeds of a head's tools and carriage; of the handler at its tip."""
    series = _speeds(loom.cyclograms[0], {HANDLER: loom.weaver.handler_radius})
    note = "the pile handler at its tip"
    return Plot("loom-knot-speeds", "Speeds over a knot", KNOT_DRIVE, Axis("speed", "m/s"), series, note=note)


def knot_forces(loom: LoomDesign) -> Plot:
    """Forces on a head's tools; of the handler at its tip."""
    weaver = loom.weaver
    head = HeadForces(weaver.params, weaver.cyclogram, weaver.opener, weaver.handler_radius)
    angle = _angles(weaver.cyclogram)
    own = [cam.name for cam in weaver.cyclogram.tracks if cam.name in weaver.peaks]
    series = tuple(
        Series(name, angle, tool_force(head, name, angle) / (weaver.handler_radius if name == HANDLER else 1.0))
        for name in own
    )
    note = "against the tool's motion forward; negative: the yarn pulls with it; the pile handler at its tip"
    return Plot("loom-knot-forces", "Forces over a knot", KNOT_DRIVE, Axis("force", "N"), series, note=note)


def row_speeds(loom: LoomDesign) -> Plot:
    """Speeds of everything that moves over a row."""
    series = _speeds(loom.row_cyclogram, {})
    return Plot("loom-row-speeds", "Speeds over a row", ROW_DRIVE, Axis("speed", "m/s"), series)


def row_forces(loom: LoomDesign) -> Plot:
    """Forces of warps, carrier, beater, take-up and rail over a row."""
    row = loom.row_cyclogram
    angle = _angles(row)
    even = (loom.warps + 1) // 2
    sheets = {EVEN: even, ODD: loom.warps - even}
    cams = loom.shedding.first.params
    series = [
        Series(name, angle, number * warp_force(cams, sample(row.track(name), angle).position))
        for name, number in sheets.items()
    ]
    masses = {loom.row_timing.carrier: loom.weft.axis.mass}
    if loom.heads:
        masses[HEADS] = loom.heads * head_mass(loom.weaver) + mass_of_rail(loom, parts_of_loom(loom).frame)
    for name, mass in masses.items():
        bend = sample(row.track(name), angle).bend
        series.append(Series(name, angle, mass * bend * row.speed**2))
    series += [Series(BEATER, angle, _beat(loom, angle)), Series(TAKE_UP, angle, _take_up(loom, angle))]
    note = "lifted warps across; carrier and rail by their masses; beater on the fabric; take-up against all warps"
    return Plot("loom-row-forces", "Forces over a row", ROW_DRIVE, Axis("force", "N"), tuple(series), note=note)


def _angles(cyclogram: Cyclogram) -> FloatArray:
    """Master angles [rad]: both ends, and each motion in even parts, however short it is."""
    parts = (part for track in cyclogram.tracks for part in laid(track))
    spans = (np.linspace(max(part.start, 0.0), min(part.end, turn), _PARTS) for part in parts)
    return np.unique(np.concatenate([[0.0, turn], *spans]))


def _speeds(cyclogram: Cyclogram, radii: dict[str, float]) -> tuple[Series, ...]:
    """The speed of each track over its angle; of one that turns, at a radius [m]."""
    angle = _angles(cyclogram)
    return tuple(
        Series(track.name, angle, radii.get(track.name, 1.0) * sample(track, angle).slope * cyclogram.speed)
        for track in cyclogram.tracks
    )


def _beat(loom: LoomDesign, angle: FloatArray) -> FloatArray:
    """Force of the beater [N] on all warps that it beats at once, while it is at the fell."""
    track = loom.row_cyclogram.track(BEATER)
    at = sample(track, angle).position
    pressing = at >= track.stroke * (1 - _PRESSED)
    return np.where(pressing, min(loom.beat.beat_force_warp, loom.beat.beat_force_needed) * loom.beat.beaten, 0.0)


def _take_up(loom: LoomDesign, angle: FloatArray) -> FloatArray:
    """Pull of all warps [N] while the carpet is taken up."""
    part = loom.row_cyclogram.track(TAKE_UP).segments[0]
    return np.where((angle > part.start) & (angle < part.end), loom.warps * loom.task.cloth.warp_tension, 0.0)
