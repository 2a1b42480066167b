"""What the parts of a scene are made from: the loom, its parts list and report, and the motions of its tracks."""

from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.plane.solids import plate_solid
from ilmek.records import record
from ilmek.report import BillLine, Check, Plate
from ilmek.report.scene import SceneFrame, SceneMotion, ScenePart, Solid
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track, laid, sample
from ilmek.units import mm, turn

ROW, KNOT = "row", "knot"
FINE, COARSE, COARSEST = 0.05 * mm, 1 * mm, 4 * mm
"""Deviations of the outlines of a plate's solids [m]."""

_STEPS = 24
"""Samples of each motion of a track."""


@record
class SceneGroup:
    """Frames and parts of one machine of the scene."""

    frames: tuple[SceneFrame, ...]
    parts: tuple[ScenePart, ...]


@record
class SceneMaker:
    """A loom, the lines of its parts list by name, and all checks of its report."""

    loom: LoomDesign
    lines: Mapping[str, BillLine]
    checks: tuple[Check, ...]

    @property
    def half(self) -> float:
        """Half of the cloth's width [m]."""
        return self.loom.task.cloth_width / 2

    @property
    def width(self) -> float:
        """Distance of the bearings [m]."""
        return self.loom.task.width

    def checked(self, *words: str) -> tuple[Check, ...]:
        """The checks whose names begin with any of the words."""
        return tuple(check for check in self.checks if check.name.startswith(words))

    def part(
        self,
        name: str,
        frame: str,
        solids: Solid | Sequence[Solid],
        *,
        machine: str,
        line: str = "",
        checks: Sequence[str] = (),
        envelope: bool = False,
        title: str = "",
    ) -> ScenePart:
        """A part with material, mass and number from a line of the parts list; default: its own name's."""
        found = self.lines.get(line or name)
        return ScenePart(
            name=name,
            title=title or name,
            machine=machine,
            frame=frame,
            solids=(solids,) if isinstance(solids, Solid) else tuple(solids),
            deviations=(0.0,),
            material=found.material if found else "",
            mass=found.mass if found else np.nan,
            number=found.number if found else 1,
            checks=self.checked(*checks) if checks else (),
            envelope=envelope,
        )


def maker_of(loom: LoomDesign, checks: tuple[Check, ...]) -> SceneMaker:
    """The maker of a loom's scene, with all checks of its report."""
    return SceneMaker(loom, {line.name: line for line in parts_of_loom(loom).parts}, checks)


def plate_part(
    plate: Plate,
    frame: str,
    low: float,
    *,
    machine: str,
    mass: float,
    checks: tuple[Check, ...],
    deviations: tuple[float, ...] = (FINE,),
    title: str = "",
) -> ScenePart:
    """A plate of the workshop files in a frame, from `low` across [m]."""
    return ScenePart(
        name=f"{machine} {plate.name}",
        title=title or plate.title,
        machine=machine,
        frame=frame,
        solids=tuple(plate_solid(plate, low, deviation) for deviation in deviations),
        deviations=deviations,
        material=plate.material,
        mass=mass,
        number=plate.number,
        checks=checks,
        plate=f"{machine}-{plate.name}",
    )


def track_angles(*tracks: Track) -> FloatArray:
    """Angles at which tracks are sampled [rad]: both ends of the turn, and each of their motions in even parts."""
    spans = [
        np.linspace(max(one.start, 0.0), min(one.end, turn), _STEPS + 1) for track in tracks for one in laid(track)
    ]
    return np.unique(np.concatenate([[0.0, turn], *spans]))


def along_track(
    cyclogram: Cyclogram, name: str, direction: tuple[float, float, float], limit: float = np.inf
) -> SceneMotion:
    """A motion along a direction (x, y, z) by a track, up to a limit of its position [m]."""
    track = cyclogram.track(name)
    angle = track_angles(track)
    position = np.minimum(sample(track, angle).position, limit)
    return motion(cyclogram, angle, shift=position[:, None] * np.array(direction))


def motion(
    cyclogram: Cyclogram,
    angle: FloatArray,
    *,
    shift: Float[np.ndarray, "samples 3"] | None = None,
    rotation: FloatArray | None = None,
) -> SceneMotion:
    """A motion over the angle of a cyclogram of a row or a knot."""
    drive = ROW if cyclogram.name == "row" else KNOT
    still = np.zeros(len(angle))
    return SceneMotion(
        drive,
        angle,
        np.zeros((len(angle), 3)) if shift is None else shift,
        still if rotation is None else rotation,
    )


def in_side_view(points: np.ndarray) -> Float[np.ndarray, "points 3"]:
    """Points of the side view [m] in the middle of the width: (0, up, front)."""
    points = np.atleast_1d(points)
    return np.stack([np.zeros(len(points)), points.imag, points.real], axis=1)
