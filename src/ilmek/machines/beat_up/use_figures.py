"""Figures of a beat-up in use: start and stop of its crank, its strokes along the carpet."""

import numpy as np

from ilmek.machines.beat_up.crank_path import crank_path
from ilmek.machines.beat_up.crank_start import CrankStart
from ilmek.machines.beat_up.travel import BeaterTravel
from ilmek.report import Axis, Mark, Plot, Series
from ilmek.units import format_quantity

STROKES = 4
"""Strokes drawn."""

_SAMPLES = 600
_TIME = Axis("time", "s")


def start_plots(start: CrankStart, prefix: str = "beat-up") -> tuple[Plot, Plot]:
    """Speed of the crank and torque on its shaft over a turn from rest to rest."""
    beat = float(start.time[int(np.argmin(start.travel))])
    marks = (Mark(beat, "beat"),)
    fell = -start.fell_force * np.gradient(start.travel, start.angle)
    up, total = format_quantity(start.run_up_time, "s"), format_quantity(float(start.time[-1]), "s")
    note = f"run-up {up}, a turn from rest to rest {total}, by {start.drive}"
    speed = (Series("crank", start.time, start.speed),)
    torque = (Series("shaft", start.time, start.torque), Series("the fell's part", start.time, fell, dashed=True))
    return (
        Plot(
            f"{prefix}-start-speed",
            "Speed of the crank from rest to rest",
            _TIME,
            Axis("speed", "rad/s"),
            speed,
            marks,
            note,
        ),
        Plot(
            f"{prefix}-start-torque",
            "Torque on the crank shaft from rest to rest",
            _TIME,
            Axis("torque", "N*m"),
            torque,
            marks,
        ),
    )


def stroke_plot(travel: BeaterTravel, start: CrankStart) -> Plot:
    """Height of the beater over the fell, and steps of the slide, over the first strokes."""
    path, strokes = crank_path(start, ()), min(STROKES, travel.strokes)
    period = start.duty.linkage.period if start.duty.starts == 1 else float(start.time[-1]) + start.duty.pause
    until = min(start.beat_time, (strokes + 0.5) * period)
    time = np.linspace(0.0, until, _SAMPLES)
    height = path(time / start.beat_time).imag
    first = float(start.time[int(np.argmin(start.travel))])
    slide = np.zeros(_SAMPLES)
    for number in range(travel.strokes - 1 if travel.strokes <= strokes else strokes):
        # A step is in the middle between two beats, where the beater is farthest from the fell.
        begin = first + (number + 0.5) * period - travel.step.time / 2
        slide += travel.step.at(np.clip(time - begin, 0.0, travel.step.time))[0]
    series = (Series("beater over the fell", time, height), Series("slide", time, slide, dashed=True))
    width, beat = format_quantity(travel.beater_width, "mm"), format_quantity(start.beat_time, "s")
    note = f"{travel.strokes} strokes of {travel.stroke_warps} warps, {width}: {beat} a beat"
    return Plot("beat-up-strokes", "First strokes along the width", _TIME, Axis("distance", "mm"), series, note=note)
