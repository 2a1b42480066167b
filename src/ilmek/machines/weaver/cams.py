"""The head's cams, one for every track: the programmes of their followers, and what they move.

The handler turns in one direction only: its rack drives it forward through a freewheel and returns while it stands. All
other tools move through levers. Size, loads, spring and drive: `ilmek.cams.loaded_plate_cam`.
"""

import numpy as np

from ilmek.cams.laws import LAWS
from ilmek.cams.loaded_plate_cam import LoadedPlateCam, PlateCamTask, loaded_plate_cam
from ilmek.cams.programme import CamProgramme, CamSegment, dwell
from ilmek.machines.weaver.forces import HeadForces, load_on
from ilmek.machines.weaver.motions import HANDLER, SLEY
from ilmek.machines.weaver.tool_parts import ToolBodies
from ilmek.machines.weaver.widths import roller_width
from ilmek.timing.track import Track
from ilmek.units import turn

_FIT = 1e-9
_REST = 0.03
"""Share of the rest of the turn for which the rack stands before and after its return."""


def cams_for(head: HeadForces, tools: ToolBodies) -> tuple[LoadedPlateCam, ...]:
    """The cams of a head, one for each track."""
    return tuple(_cam_for(head, track, tools.moved(track.name)) for track in head.cyclogram.tracks)


def _cam_for(head: HeadForces, track: Track, mass: float) -> LoadedPlateCam:
    """The cam of a track that moves a mass at its tool [kg]."""
    params, speed, handler_radius = head.params, head.cyclogram.speed, head.radius
    turns = track.name == HANDLER
    ratio = 1 / params.pinion if turns else params.sley_lever if track.name == SLEY else params.lever
    moved = mass * ((handler_radius * ratio) ** 2 if turns else ratio**2)
    task = PlateCamTask(
        speed=speed,
        mass=(moved, mass) if turns else (moved, moved),
        braked=turns,
        closure=params.closure,
        contact_force=params.contact_force,
        pressure_angle=params.pressure_angle_limit,
        shaft=params.shaft,
        roller_radius=params.roller_radius,
        roller_width=roller_width(params),
        thickness=params.cam_thickness,
        load=load_on(head, track.name, ratio),
    )
    return loaded_plate_cam(track.name, track.actuator, ratio, programme_of(track, ratio), task)


def programme_of(track: Track, ratio: float) -> CamProgramme:
    """The follower's programme over the turn, from its lowest position on; the rack of a tool that turns on returns.

    ratio  the tool's motion over the follower's
    """
    parts: list[CamSegment] = []
    at = 0.0
    for part in track.segments:
        parts += _still(part.start - at)
        change = (part.finish - part.begin) / ratio
        parts.append(CamSegment(part.name, part.end - part.start, change, LAWS[part.law.name]))
        at = part.end
    left = sum(part.change for part in parts)
    if abs(left) > _FIT:
        gap = _REST * (turn - at)
        parts += [*_still(gap), CamSegment("back", turn - at - 2 * gap, -left, LAWS[track.segments[0].law.name])]
        at = turn - gap
    parts += _still(turn - at)
    bases = np.cumsum([0.0, *(part.change for part in parts[:-1])])
    first = int(np.argmin(np.round(bases / _FIT)))
    start = sum(part.span for part in parts[:first])
    return CamProgramme((*parts[first:], *parts[:first]), float(start))


def _still(span: float) -> list[CamSegment]:
    return [dwell(span)] if span > _FIT else []
