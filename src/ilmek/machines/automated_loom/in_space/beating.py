"""What beats, in space: the travelling beater on its crank-rocker, or the comb on crank-rockers or vertical axes.

The linkage's frame (`machines.beat_up.design`: D the origin, A on x) stands mirrored in the side view: its rocker
points from A to the back at the beat and swings up, so that a direction e^(i t) of it is e^(i (g - t)), g = pi + r0, r0
the rocker's angle at the beat. A is in front of the fell by the beater's arm [`machines.beat_up.crank_path`].
"""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.solve import solve
from ilmek.machines.automated_loom.bodies import beat_displacement, beat_windows
from ilmek.machines.automated_loom.cyclogram import SLIDE
from ilmek.machines.automated_loom.in_space.cams import warp_positions
from ilmek.machines.automated_loom.in_space.maker import (
    SceneGroup,
    SceneMaker,
    along_track,
    in_side_view,
    motion,
    plate_part,
)
from ilmek.machines.automated_loom.in_space.standing import GROUND
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.report import plates as link_plates
from ilmek.plane.solids import prism
from ilmek.report import Plate
from ilmek.report.scene import SceneFrame, ScenePart
from ilmek.units import turn

BEATER, CARRIED = "beater", "beater's slide"
_TABLE = 721
_BESIDE = 0.004
"""Distance of neighbouring links along their pins [m]: assumed by this project."""


def beating(made: SceneMaker) -> SceneGroup:
    """The beater with its frames, and the links where crank-rockers drive it."""
    angle, tip = _beat(made)
    parent = CARRIED if _slides(made) else GROUND
    struck = motion(made.loom.row_cyclogram, angle, shift=in_side_view(tip))
    frames = [SceneFrame(BEATER, np.zeros((1, 3)), parent, struck), _teeth(made)]
    parts = [*_beater_parts(made)]
    if _slides(made):
        frames.insert(0, _slide(made))
    linkage = linkage_of(made)
    if linkage is not None:
        found = _linkage(made, linkage, (angle, tip), parent)
        frames += found.frames
        parts += found.parts
    return SceneGroup(tuple(frames), tuple(parts))


def linkage_of(made: SceneMaker) -> BeatUp | None:
    """The crank-rocker that beats; None where axes do."""
    design = made.loom.beat.design
    if isinstance(design, BeatUp):
        return design
    return None if design.linkage is None else design.linkage.one


def _slides(made: SceneMaker) -> bool:
    return any(track.name == SLIDE for track in made.loom.row_cyclogram.tracks)


def _slide(made: SceneMaker) -> SceneFrame:
    """The slide: at angle 0 the beater stands at the left edge of the cloth."""
    wide = made.loom.beat.beaten * made.loom.params.pitch
    start = np.array([[wide / 2 - made.half, 0.0, 0.0]])
    return SceneFrame(CARRIED, start, GROUND, along_track(made.loom.row_cyclogram, SLIDE, (1.0, 0.0, 0.0)))


def _beat(made: SceneMaker) -> tuple[FloatArray, ComplexArray]:
    """Angles of the row [rad], and the beater's tip from the fell in the side view [m]."""
    row, path = made.loom.row_cyclogram, made.loom.beat.path
    inner = [start + path.share * (end - start) for start, end in beat_windows(row)]
    angle = np.unique(np.clip(np.concatenate([[0.0, turn], *inner]), 0.0, turn))
    return angle, beat_displacement(path, row)(angle) + path.tip[0]


def _beater_parts(made: SceneMaker) -> Iterator[ScenePart]:
    beat, loom = made.loom.beat, made.loom
    leaves, *bars = beat.path.outline
    wide = beat.beaten * loom.params.pitch
    machine = beat.name
    line = "beater" if isinstance(beat.design, BeatUp) else "comb of the hammer"
    checks = (f"{machine}: force", f"{machine}: stress of a leaf", f"{machine}: stress of the comb", "beat: ")
    thick = _leaf(made)
    name = f"{BEATER}'s teeth"
    tooth = prism(leaves, -thick / 2, thick / 2)
    yield made.part(
        name, name, tooth, machine=machine, line=line, checks=checks, envelope=isinstance(beat.design, BeatUp)
    )
    for bar in bars:
        solid = prism(bar, -wide / 2, wide / 2)
        yield made.part(f"{BEATER}'s bar", BEATER, solid, machine=machine, line=line, checks=checks)


def _leaf(made: SceneMaker) -> float:
    """Thickness of a leaf, or of the room of a tooth between two warps [m]."""
    design, loom = made.loom.beat.design, made.loom
    if isinstance(design, BeatUp):
        return float(max(loom.params.pitch - loom.task.yarns.warp.diameter, 0.1 * loom.params.pitch))
    return float(design.params.leaf)


def _teeth(made: SceneMaker) -> SceneFrame:
    """The teeth or leaves: one in each gap of the warps that are beaten at once."""
    pitch, number = made.loom.params.pitch, max(1, made.loom.beat.beaten - 1)
    origins = np.zeros((number, 3))
    if _slides(made):
        origins[:, 0] = (np.arange(number) - (number - 1) / 2) * pitch
    else:
        origins[:, 0] = (warp_positions(made)[:-1] + pitch / 2)[:number]
    return SceneFrame(f"{BEATER}'s teeth", origins, BEATER)


def _linkage(made: SceneMaker, one: BeatUp, beat: tuple[FloatArray, ComplexArray], parent: str) -> SceneGroup:
    """Crank, coupler and rocker, as often as there are crank-rockers."""
    row, (angle, tip) = made.loom.row_cyclogram, beat
    lengths, first = one.lengths, one.rocker_angles[0]
    mirror, arm = np.pi + first, one.lengths["beater"]
    swing = np.maximum(-np.angle(1 - tip / arm), 0.0)
    crank = crank_angles(one, swing)
    coupler = solve(one.plan, crank).angle("coupler")
    pivot = complex(arm)
    shaft = pivot + float(one.params.ground) * np.exp(1j * first)
    across = _mechanisms(made)
    step = one.params.thickness + _BESIDE
    names = ("crank", "coupler", "rocker")
    frames = (
        SceneFrame(
            "crank", _at(across, shaft, 0.0), parent, motion(row, angle, rotation=crank), np.full(len(across), -mirror)
        ),
        SceneFrame(
            "coupler",
            _at(np.zeros(1), complex(lengths["crank"]), step),
            "crank",
            motion(row, angle, rotation=np.unwrap(coupler - crank)),
        ),
        SceneFrame(
            "rocker",
            _at(across, pivot, 0.0),
            parent,
            motion(row, angle, rotation=swing),
            np.full(len(across), -np.pi),
        ),
    )
    made_plates: dict[str, Plate] = {plate.name: plate for plate in link_plates(one)}
    words = {"crank": "crank", "coupler": "coupler", "rocker": "rocker"}
    parts = tuple(
        plate_part(
            made_plates[name],
            name,
            -made_plates[name].thickness / 2,
            machine=made.loom.beat.name,
            mass=one.masses[name],
            checks=made.checked(
                f"{made.loom.beat.name}: stress of the {words[name]}",
                f"{made.loom.beat.name}: safety",
                f"{made.loom.beat.name}: transmission",
            ),
        )
        for name in names
    )
    return SceneGroup(frames, parts)


def crank_angles(one: BeatUp, swing: FloatArray) -> FloatArray:
    """Angles of the crank [rad] that follow one another for swings of the rocker from the beat [rad].

    While the swing falls the crank is before the beat, while it rises behind it.
    """
    table = one.dead_centres.beta + np.linspace(
        float(one.dead_centres.rotation) - turn, float(one.dead_centres.rotation), _TABLE
    )
    at = np.abs(np.unwrap(solve(one.plan, table).angle("rocker")) - one.rocker_angles[0])
    least = int(np.argmin(at))
    falling = np.gradient(swing) < 0
    before = np.interp(swing, at[: least + 1][::-1], table[: least + 1][::-1])
    after = np.interp(swing, at[least:], table[least:])
    return np.asarray(np.unwrap(np.where(falling, before, after)))


def _mechanisms(made: SceneMaker) -> FloatArray:
    """Positions of the crank-rockers across [m]."""
    number = max(1, made.loom.beat.crank_rockers)
    if _slides(made):
        return np.zeros(1)
    return (np.arange(number) + 0.5) / number * 2 * made.half - made.half


def _at(across: FloatArray, side: complex, beside: float) -> FloatArray:
    origins = np.repeat(in_side_view(np.array([side])), len(across), axis=0)
    origins[:, 0] = across + beside
    return origins
