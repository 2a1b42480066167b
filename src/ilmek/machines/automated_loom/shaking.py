"""What shakes the loom's frame, and how stiff its posts have to be.

A drive shakes the frame at most once a stroke of the beat, once a knot of each head in turn, once a pick. The frame is
stiff for it where every natural frequency is DISTANCE times higher: at a ratio r = 1 / DISTANCE the amplitude is
1 / (1 - r²) of that at rest.                                                       [Rao, Mechanical Vibrations, 3.3]

A post that is free at its end, with a mass m there, sways at sqrt(3 E I / (m h³)) / (2 pi); the feet under it give, so
that it has to be STIFFER times as quick as the whole frame.                                          [theory of beams]
"""

from collections.abc import Iterable, Mapping
from itertools import chain

from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.beat import BeatDrive
from ilmek.units import turn

DISTANCE = 2.0
"""Least natural frequency over the greatest frequency of a drive; assumed by this project."""

STIFFER = 2.0
"""Natural frequency of a post by itself over the least of the frame, wished; assumed by this project."""


def drive_frequencies(loom: LoomDesign) -> Mapping[str, float]:
    """Strokes of the beat, turns of its crank, knots of all heads in turn, picks: frequency of each [Hz]."""
    return {
        **beat_frequencies(loom.beat),
        **({"knots of the heads": loom.heads / loom.times.knot} if loom.heads else {}),
        "picks of the weft": 1 / loom.weft.passage.time,
    }


def beat_frequencies(beat: BeatDrive) -> Mapping[str, float]:
    """Strokes of a beat, and turns of its crank, if it has one [Hz]."""
    crank = {"crank of the beat": beat.task.params.beat_speed / turn} if beat.crank_rockers else {}
    return {"strokes of the beat": beat.beat.strokes / beat.beat.time, **crank}


def least_frequency(loom: LoomDesign) -> float:
    """Least natural frequency that the drives of a loom allow [Hz]."""
    return DISTANCE * max(drive_frequencies(loom).values())


def stiff_post(strong: Iterable[HollowSquare], height: float, mass: float, least: float) -> HollowSquare | None:
    """The first of the sections for a post of a height [m] that is stiff enough with a mass at its end [kg]; where none
    is, the first of them; None of none. least: natural frequency that drives allow [Hz].
    """
    needed = (turn * STIFFER * least) ** 2 * mass * height**3 / (3 * STEEL.modulus)
    strong = iter(strong)
    first = next(strong, None)
    return first and next((one for one in chain((first,), strong) if one.inertia >= needed), first)
