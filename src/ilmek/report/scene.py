"""A machine in space as plain data: its parts as solids at true size, the frames that carry them, and their motions.

Axes [m]: x along the width, to the weaver's right, 0 in the middle of the cloth; y up, 0 at the fell; z to the front,
where the weaver stands. A frame lies in its parent and is made several times; a part is fixed in its frame:

    point in the parent = origin + shift(q) + R(axis, phase + rotation(q)) point         q angle of the frame's drive
"""

import math
from collections.abc import Mapping
from dataclasses import field

import numpy as np

from ilmek.arrays import Float, FloatArray, Int
from ilmek.records import record
from ilmek.report.check import Check
from ilmek.report.json import Json

ACROSS = (1.0, 0.0, 0.0)
"""Axis of what turns in the side view: a positive angle turns from y to z, from up to the front."""


@record
class Solid:
    """A closed surface of triangles: points [m], and for each three of them, counter-clockwise seen from outside."""

    points: Float[np.ndarray, "points 3"]
    triangles: Int[np.ndarray, "triangles 3"]


@record
class SceneMotion:
    """A rigid motion over the angle of a drive, straight between its samples; it ends where it began, or goes on.

    drive     "row" or "knot"             angle   [rad], ascending from 0 to 2 pi
    shift     [m]                         rotation  about the frame's axis [rad]
    """

    drive: str
    angle: Float[np.ndarray, " samples"]
    shift: Float[np.ndarray, "samples 3"]
    rotation: Float[np.ndarray, " samples"]


@record
class SceneFrame:
    """A frame, `origins` times in each of its parents.

    parent   name of the frame that carries it; "": the ground
    origins   positions of its origin [m]       phases   its rotations at rest [rad]; default: none
    motion   default: it is fixed              axis     about which it turns
    """

    name: str
    origins: Float[np.ndarray, "origins 3"]
    parent: str = ""
    motion: SceneMotion | None = None
    phases: FloatArray | None = None
    axis: tuple[float, float, float] = ACROSS


@record
class ScenePart:
    """A part at true size.

    name, title  unique; for people             machine   that it belongs to
    frame        that carries it                solids    each in the frame, from the finest to the coarsest
    deviations   of the solids' outlines from the part [m]
    material     "" where it is not known       mass      of one [kg]; nan: not weighed
    number       of the parts list              checks    that concern it
    plate        name of its drawing for the workshop; "": none
    envelope     the solid is the room that the design keeps for it: its shape is not designed
    copies       of it in each solid
    ids          of the part, and of the body that it is on; "": it is no part of the tree
    """

    name: str
    title: str
    machine: str
    frame: str
    solids: tuple[Solid, ...]
    deviations: tuple[float, ...]
    material: str = ""
    mass: float = math.nan
    number: int = 1
    checks: tuple[Check, ...] = ()
    plate: str = ""
    envelope: bool = False
    copies: int = 1
    ids: tuple[str, str] = ("", "")

    @property
    def extents(self) -> FloatArray:
        """Of a copy along x, y and z of the frame [m]."""
        points = self.solids[0].points
        return np.asarray(np.ptp(points[: len(points) // self.copies], axis=0))


@record
class SceneBody:
    """What moves as one, what holds it, and what moves it against that.

    parent   the body that holds it, "" for the floor       joint    by which it is held
    drive    "" where none moves it
    motor    title of the motor at its joint, or of what a hand holds; "": none
    follows  ids of the bodies that move it by touch, belt or magnet, where it has no motor
    passive  what else holds it, in words
    """

    parent: str
    joint: str
    drive: str
    motor: str = ""
    follows: tuple[str, ...] = ()
    passive: str = ""


@record
class ScenePhase:
    """A motion of a cyclogram: what moves, what it does, from one angle of the drive to another [rad]."""

    drive: str
    track: str
    name: str
    start: float
    end: float


@record
class SceneYarn:
    """A yarn over the angle of a drive: points [m] in a frame at each angle [rad], (angles, points, 3).

    across  positions along x, at which it is as often [m]; default: once, at 0
    """

    name: str
    title: str
    frame: str
    drive: str
    angle: FloatArray
    points: Float[np.ndarray, "angles points 3"]
    diameter: float
    across: FloatArray | None = None


@record
class SceneCarpet:
    """The carpet: its width, the pitches, and the line of its pile's ground in the side view, from the fell down.

    line  (points, 2): z and y [m]        pile  height of the pile in front of it [m]
    """

    width: float
    columns: int
    rows: int
    column_pitch: float
    row_pitch: float
    pile: float
    line: Float[np.ndarray, "points 2"]


@record
class Assembly:
    """Parts in space without cloth; periods: time of a turn of each drive [s]."""

    title: str
    frames: tuple[SceneFrame, ...]
    parts: tuple[ScenePart, ...]
    periods: Mapping[str, float]


@record
class Scene:
    """A loom in space.

    warps     in sheets that move alike; the first is that which opens the shed in front of all others
    periods   time of a turn of each drive [s]
    heads     name of the frame of the heads, which stand anywhere on x; "": none
    phases    what moves when
    tools     what people call the tools that tie, by the frames that carry them; the first stands around the knot
    dyed      ids of the parts that have the colours of the pile yarns, one copy after the other
    guards    names of the frames of fence and doors      failures  the checks of the whole loom that fail
    bodies    by id: what holds each body of parts
    nearest   the pairs of parts that come nearest: its result `nearest_pairs`; None: they are not compared
    """

    title: str
    frames: tuple[SceneFrame, ...]
    parts: tuple[ScenePart, ...]
    warps: tuple[SceneYarn, ...]
    carpet: SceneCarpet
    periods: Mapping[str, float]
    phases: tuple[ScenePhase, ...]
    floor: float
    bodies: Mapping[str, SceneBody]
    yarns: tuple[SceneYarn, ...] = ()
    heads: str = ""
    tools: Mapping[str, str] = field(default_factory=dict)
    dyed: tuple[str, ...] = ()
    guards: tuple[str, ...] = ()
    failures: tuple[Check, ...] = ()
    nearest: Json = None
