"""What stands and moves in the side view of a loom, over the cyclograms of a row and of a knot."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.arrangement.clearances import ConvexPart, MovingBody, moving, standing
from ilmek.machines.arrangement.side_view import RETREAT, CamPosition, RoundPart, SideBox, SideView, rectangle
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, HEADS, ODD, weft_windows
from ilmek.machines.beat import BeatPath
from ilmek.machines.weaver.head_shape import HeadTool
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, sample
from ilmek.units import turn

GUIDE_CAMS, LEAVES, BAR, CARRIER, CARPET = "guide cams", "comb's leaves", "comb's bar", "weft's carrier", "carpet"
BACK_REST, UPPER, SPACER, LOWER = "back rest", "upper cylinder", "spacer cylinder", "lower cylinder"
Displacement: TypeAlias = Callable[[FloatArray], ComplexArray]
"""Angles of a cyclogram [rad] -> displacement [m]."""

NODES = 40
"""Samples of a stroke of what beats, at least."""

MAGAZINE = "magazine of the yarns"
COMPENSATOR = "tension compensator"
HEAD, RAIL, WARPS = "head", "heads' rail", "warps"


def row_bodies(side: SideView, row: Cyclogram, beat: BeatPath, *, stack: bool) -> tuple[MovingBody, ...]:
    """The bodies over the cyclogram of a row: the shed opens twice, the weft is laid, the comb beats, heads retreat.

    beat   path of what beats        stack  whether the cams go down with it
    """
    down, away = beat_displacement(beat, row), _along(row.track(HEADS), RETREAT)
    windows = weft_windows(row)
    return (
        *_sheets(side, row),
        _cams(side, down if stack else None),
        *_comb(side, beat, row),
        MovingBody(CARRIER, (_box(side.carrier),), windows),
        MovingBody(HEAD, (moving(rectangle(SideBox(side.head.body, side.head.size)), away),)),
        *(
            MovingBody(tool.name, (moving(rectangle(SideBox(tool.corner, tool.size)), away),))
            for tool in side.head.tools
        ),
        MovingBody(RAIL, (moving(rectangle(side.rail), away),)),
        *_frame(side),
    )


def knot_bodies(side: SideView, knot: Cyclogram) -> tuple[MovingBody, ...]:
    """The bodies over the cyclogram of a knot: the shed is closed, the comb at rest, the heads at the warps."""
    rest = np.array([0j, 1j * side.spans.back_rest])
    return (
        MovingBody(WARPS, (standing(rest, side.room.warp / 2),)),
        _cams(side, None),
        *_comb(side),
        MovingBody(HEAD, (standing(rectangle(SideBox(side.head.body, side.head.size))),)),
        MovingBody(MAGAZINE, (standing(_magazine(side)),)),
        *(_tool(tool, knot) for tool in side.head.tools),
        MovingBody(RAIL, (_box(side.rail),)),
        *_frame(side),
    )


def beat_displacement(beat: BeatPath, row: Cyclogram) -> Displacement:
    """Displacement of what beats from its rest [m] at angles of the row [rad]."""
    windows = beat_windows(row)

    def displacement(angle: FloatArray) -> ComplexArray:
        share = np.zeros(np.shape(angle))
        for start, end in windows:
            share += np.where((angle > start) & (angle < end), (angle - start) / (end - start), 0.0)
        return np.asarray(beat(share) - beat.tip[0])

    return displacement


def beat_tip(beat: BeatPath, row: Cyclogram, angle: FloatArray) -> ComplexArray:
    """The tip of what beats from the fell [m] at angles of the row [rad]."""
    return np.asarray(beat_displacement(beat, row)(angle) + beat.tip[0])


def beat_windows(row: Cyclogram) -> tuple[tuple[float, float], ...]:
    """Angles of the row at which each beat begins and ends [rad]."""
    parts = row.track(BEATER).segments
    return tuple((first.start, last.end) for first, last in zip(parts[::2], parts[1::2], strict=True))


def beat_joints(beat: BeatPath, row: Cyclogram) -> FloatArray:
    """Angles of the row at which the first stroke down and the last stroke up of each beat are sampled [rad].

    Strokes between these, of a beat that travels along the row, run over the same path.
    """
    near = np.flatnonzero(np.abs(beat.tip) <= np.abs(beat.tip).min() + 1e-9)
    down, up = beat.share[: near[0] + 1], beat.share[near[-1] :]
    shares = np.concatenate([one[np.linspace(0, len(one) - 1, NODES).astype(int)] for one in (down, up)])
    return np.concatenate([start + shares * (end - start) for start, end in beat_windows(row)])


def _along(track: Track, direction: complex) -> Displacement:
    """Displacement by a track's position along a direction."""
    return lambda angle: np.asarray(direction * sample(track, np.mod(angle, turn)).position)


def _magazine(side: SideView) -> ComplexArray:
    return rectangle(SideBox(side.head.magazine, side.head.magazine_size))


def _at_rest(tool: HeadTool) -> ComplexArray:
    return rectangle(SideBox(tool.corner, tool.size))


def _box(box: SideBox) -> ConvexPart:
    return standing(rectangle(box))


def _sheets(side: SideView, row: Cyclogram) -> tuple[MovingBody, ...]:
    """Even and odd warps: from the fell over the point of lift at each cam shaft to the back rest."""

    def part(track: Track, cam: CamPosition, end: complex) -> ConvexPart:
        share = cam.lift / side.cams[0].lift

        def corners(angle: FloatArray) -> ComplexArray:
            lifted = share * sample(track, np.mod(angle, turn)).position + 1j * cam.at.imag
            return np.stack([lifted, np.full_like(lifted, end)], axis=-1)

        return ConvexPart(corners, side.room.warp / 2)

    ends = 0j, 1j * side.spans.back_rest
    return tuple(
        MovingBody(
            name,
            tuple(part(row.track(name), cam, end) for cam in side.cams for end in ends),
        )
        for name in (EVEN, ODD)
    )


def _cams(side: SideView, stack: Displacement | None) -> MovingBody:
    """The guide cams: discs that contain the cams too."""
    parts = (
        moving(np.array([cam.at]), stack, cam.guide_radius) if stack else standing(np.array([cam.at]), cam.guide_radius)
        for cam in side.cams
    )
    return MovingBody(GUIDE_CAMS, tuple(parts))


def _comb(side: SideView, beat: BeatPath | None = None, row: Cyclogram | None = None) -> tuple[MovingBody, ...]:
    """What beats: between the warps its leaves, in front of them its bar; at rest, or over the beats of a row."""
    if beat is None or row is None:
        leaves, *bar = (standing(polygon) for polygon in side.comb)
    else:
        leaves, *bar = (_carried(polygon, beat, row) for polygon in beat.outline)
    return MovingBody(LEAVES, (leaves,)), MovingBody(BAR, tuple(bar))


def _carried(polygon: ComplexArray, beat: BeatPath, row: Cyclogram) -> ConvexPart:
    """A polygon of the outline of what beats, moved by its path."""
    if beat.pivot is None:
        return moving(polygon + beat.tip[0], beat_displacement(beat, row))
    return ConvexPart(lambda angle: beat.carried(polygon, beat_tip(beat, row, angle)))


def _tool(tool: HeadTool, knot: Cyclogram) -> MovingBody:
    """A tool of a head, moved by its track."""
    track = knot.track(tool.track)

    def displacement(angle: FloatArray) -> ComplexArray:
        return np.asarray(tool.direction * sample(track, np.mod(angle, turn)).position)

    return MovingBody(tool.name, (moving(_at_rest(tool), displacement),))


def _frame(side: SideView) -> tuple[MovingBody, ...]:
    """What stands: carpet, back rest and cylinders, the lower one with the whole carpet."""
    carpet = rectangle(SideBox(complex(-side.room.warp, side.lower.at.imag), complex(side.pile, -side.lower.at.imag)))
    rollers: tuple[tuple[str, RoundPart, float], ...] = (
        (BACK_REST, side.back_rest, side.back_rest.radius),
        (UPPER, side.upper, side.upper.radius),
        (SPACER, side.spacer, side.spacer.radius),
        (LOWER, side.lower, side.roll),
    )
    return (
        MovingBody(CARPET, (standing(carpet),)),
        MovingBody(COMPENSATOR, (_box(side.compensator),)),
        *(MovingBody(name, (standing(np.array([roller.at]), radius),)) for name, roller, radius in rollers),
    )
