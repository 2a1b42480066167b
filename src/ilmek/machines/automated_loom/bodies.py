"""What stands and moves in the side view of a loom, over the cyclograms of a row and of a knot."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.arrangement.clearances import ConvexPart, MovingBody, moving, standing
from ilmek.machines.arrangement.head_shape import HeadTool
from ilmek.machines.arrangement.side_view import CamPosition, RoundPart, SideBox, SideView
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, HEADS, ODD, weft_windows
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, sample
from ilmek.units import turn

GUIDE_CAMS, LEAVES, BAR, CARRIER, CARPET = "guide cams", "comb's leaves", "comb's bar", "weft's carrier", "carpet"
BACK_REST, UPPER, SPACER, LOWER = "back rest", "upper cylinder", "spacer cylinder", "lower cylinder"
Displacement: TypeAlias = Callable[[FloatArray], ComplexArray]
"""Angles of a cyclogram [rad] -> displacement [m]."""

COMPENSATOR = "tension compensator"
HEAD, RAIL, WARPS = "head", "heads' rail", "warps"


def row_bodies(side: SideView, row: Cyclogram, kind: str) -> tuple[MovingBody, ...]:
    """The bodies over the cyclogram of a row: the shed opens twice, the weft is laid, the comb beats, heads retreat.

    kind  of the beat; of guide-cams the cams go down with the comb
    """
    beater, heads = row.track(BEATER), row.track(HEADS)
    down, away = _along(beater, -1j), _along(heads, 1 + 0j)
    stack = down if kind == "guide-cams" else None
    windows = weft_windows(row)
    return (
        *_sheets(side, row),
        _cams(side, stack),
        *_comb(side, down),
        MovingBody(CARRIER, (_box(side.carrier),), windows),
        MovingBody(HEAD, (moving(_corners(side.head.body, side.head.size), away),)),
        *(MovingBody(tool.name, (moving(_corners(tool.corner, tool.size), away),)) for tool in side.head.tools),
        MovingBody(RAIL, (moving(_corners(side.rail.corner, side.rail.size), away),)),
        *_frame(side),
    )


def knot_bodies(side: SideView, knot: Cyclogram) -> tuple[MovingBody, ...]:
    """The bodies over the cyclogram of a knot: the shed is closed, the comb at rest, the heads at the warps."""
    rest = np.array([0j, 1j * side.spans.back_rest])
    return (
        MovingBody(WARPS, (standing(rest, side.room.warp / 2),)),
        _cams(side, None),
        *_comb(side, None),
        MovingBody(HEAD, (standing(_corners(side.head.body, side.head.size)),)),
        *(_tool(tool, knot) for tool in side.head.tools),
        MovingBody(RAIL, (_box(side.rail),)),
        *_frame(side),
    )


def _along(track: Track, direction: complex) -> Displacement:
    """Displacement by a track's position along a direction."""
    return lambda angle: np.asarray(direction * sample(track, np.mod(angle, turn)).position)


def _corners(corner: complex, size: complex) -> ComplexArray:
    """Corners of a rectangle, counter-clockwise."""
    return corner + np.array([0, size.real, size, 1j * size.imag])


def _box(box: SideBox) -> ConvexPart:
    return standing(_corners(box.corner, box.size))


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


def _comb(side: SideView, down: Displacement | None) -> tuple[MovingBody, ...]:
    return tuple(
        MovingBody(
            name,
            (moving(_corners(box.corner, box.size), down) if down else _box(box),),
        )
        for name, box in zip((LEAVES, BAR), side.comb, strict=True)
    )


def _tool(tool: HeadTool, knot: Cyclogram) -> MovingBody:
    """A tool of a head, moved by its track."""
    track = knot.track(tool.track)

    def displacement(angle: FloatArray) -> ComplexArray:
        return np.asarray(tool.direction * np.minimum(sample(track, np.mod(angle, turn)).position, tool.limit))

    return MovingBody(tool.name, (moving(_corners(tool.corner, tool.size), displacement),))


def _frame(side: SideView) -> tuple[MovingBody, ...]:
    """What stands: carpet, back rest and cylinders, the lower one with the whole carpet."""
    carpet = _corners(complex(-side.room.warp, side.lower.at.imag), complex(side.pile, -side.lower.at.imag))
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
