"""Electronic cams in structured text: position of a track over the master angle, from a table of its cyclogram.

    position = p_k + (p_k+1 - p_k) (q - q_k) / (q_k+1 - q_k),      q_k <= q <= q_k+1

The points of a table are even within each motion and none within a dwell. Their number in a motion is the least power
of two from 16 on at which the error stays below a share of the stroke; the error is stated with the table.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.io.plc.units import PlcArray, PlcSection, PlcUnit, PlcVariable
from ilmek.timing.cyclogram import Cyclogram, Track
from ilmek.timing.track import laid, sample
from ilmek.units import turn

ERROR = 2e-3
"""Largest error of a table, as a share of the stroke."""

LEAST_PARTS, MOST_PARTS = 16, 256
"""Parts of a motion."""

_BETWEEN = 8
"""Positions between two points at which the error is taken."""


@dataclass(frozen=True, slots=True)
class CamTableText:
    """The table of a track: its name in the program, its angles [rad], positions there [SI], and largest error [SI]."""

    name: str
    track: str
    angles: tuple[float, ...]
    points: tuple[float, ...]
    error: float


def cam_tables(cyclograms: tuple[Cyclogram, ...]) -> tuple[CamTableText, ...]:
    """The tables of all tracks, those of a knot before those of a row."""
    return tuple(_table(cyclogram, track) for cyclogram in cyclograms for track in cyclogram.tracks)


def cam_units(tables: tuple[CamTableText, ...]) -> tuple[PlcUnit, ...]:
    """A function block for each table: angle [rad] -> position [SI]."""
    return tuple(_unit(table) for table in tables)


def variable_name(text: str) -> str:
    """A text as a name of a variable: words with capitals, without other signs.

    >>> variable_name("side-gripper motion")
    'SideGripperMotion'
    """
    words = "".join(letter if letter.isalnum() and letter.isascii() else " " for letter in text).split()
    return "".join(word[:1].upper() + word[1:] for word in words)


def _table(cyclogram: Cyclogram, track: Track) -> CamTableText:
    parts = LEAST_PARTS
    while True:
        angles = _angles(track, parts)
        points, fine = sample(track, angles).position, _angles(track, parts * _BETWEEN)
        error = float(np.max(np.abs(np.interp(fine, angles, points) - sample(track, fine).position)))
        if error <= ERROR * track.stroke or parts == MOST_PARTS:
            break
        parts *= 2
    name = f"Cam{variable_name(cyclogram.name)}{variable_name(track.name)}"[:31]
    label = f"{cyclogram.name}: {track.name}"
    return CamTableText(name, label, tuple(angles.tolist()), tuple(points.tolist()), error)


def _angles(track: Track, parts: int) -> FloatArray:
    """Both ends of the turn, and each motion in equal parts [rad]."""
    spans = (np.linspace(max(segment.start, 0.0), min(segment.end, turn), parts + 1) for segment in laid(track))
    return np.unique(np.concatenate([[0.0, turn], *spans]))


def _unit(table: CamTableText) -> PlcUnit:
    last = len(table.points) - 1
    inner = (
        PlcVariable("Low", "INT"),
        PlcVariable("High", "INT"),
        PlcVariable("Middle", "INT"),
        PlcVariable("Angles", PlcArray(last + 1, "REAL"), "master angles [rad]", _numbers(table.angles)),
        PlcVariable("Points", PlcArray(last + 1, "REAL"), "positions [m or rad]", _numbers(table.points)),
    )
    sections = (
        PlcSection("VAR_INPUT", (PlcVariable("Angle", "REAL", "master angle [rad], 0 to 2 pi"),)),
        PlcSection("VAR_OUTPUT", (PlcVariable("Position", "REAL", "position [m or rad]"),)),
        PlcSection("VAR", inner),
    )
    body = f"""\
Low := 0;
High := {last};
WHILE High - Low > 1 DO
    Middle := (Low + High) / 2;
    IF Angles[Middle] > Angle THEN
        High := Middle;
    ELSE
        Low := Middle;
    END_IF;
END_WHILE;
Position := Points[Low] + (Points[High] - Points[Low]) * (Angle - Angles[Low]) / (Angles[High] - Angles[Low]);
"""
    meaning = f"cam of {table.track}; largest error {table.error:.3g}"
    return PlcUnit("FUNCTION_BLOCK", table.name, meaning, sections, body)


def _numbers(values: tuple[float, ...]) -> tuple[str, ...]:
    return tuple(f"{value:.9f}" for value in values)
