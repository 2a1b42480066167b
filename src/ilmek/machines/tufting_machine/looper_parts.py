"""What a looper drive carries: the bar with its hooks, one beside each needle.

In the axes of the machine about the looper shaft, in the middle of the swing, the hook's point is at y = arm.
"""

import numpy as np

from ilmek.linkage.model import Mechanism
from ilmek.machines.tufting_machine.looper import LooperDrive
from ilmek.machines.tufting_machine.needle_parts import needle_heights
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.rocker_parts import NAME, STEEL, RockerParts, rocker_parts
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import polygon
from ilmek.records import record
from ilmek.units import mm

LOOPER, LOOPER_BAR = f"{NAME}/looper", f"{NAME}/looper-bar"

STEM, FREE = 8 * mm, 12 * mm
"""Width of a looper's stem, and length of its beak before that in loop pile; assumed by this project."""


def free_beak(params: TuftingMachineParams) -> float:
    """Length of a hook's beak before its stem [m]: in cut pile its knife stays beside it over the whole swing."""
    if params.pile == "loop":
        return FREE
    return params.looper.reach + params.looper.retreat + params.knife.width + 2 * params.knife.beside


@record
class LooperParts:
    """The parts of a looper drive; needles: of the whole machine."""

    params: TuftingMachineParams
    needles: int
    rocker: RockerParts
    hook: Part

    def carried(self, number: int) -> tuple[Occurrence, ...]:
        """What the rocker of a drive, counted from 0, carries in its frame beside its plate."""
        hooks = tuple(placement(y=self.params.looper.arm, z=z) for z in hook_heights(self.params, self.needles, number))
        return self.rocker.carried(Occurrence(self.hook, hooks))


def hook_heights(params: TuftingMachineParams, needles: int, number: int) -> list[float]:
    """Near sides of the hooks of a drive, counted from 0, along z from its middle [m]."""
    looper, pitch = params.looper, params.width / params.drives
    first, ahead = -pitch * (number + 0.5), looper.needle / 2 + looper.gap
    between = (0.0,) if params.looper_gauge == params.gauge else (0.0, params.looper_gauge)
    beside = [first + float(place.origin[2]) + ahead for place in needle_heights(params, needles)]
    return [z + step for z in beside for step in between if -pitch / 2 <= z + step + looper.thickness / 2 < pitch / 2]


def looper_parts(params: TuftingMachineParams, drive: LooperDrive, mechanism: Mechanism, needles: int) -> LooperParts:
    """The parts of a looper drive; needles: of the whole machine. The bar is under the hooks' stems."""
    looper, beak = params.looper, free_beak(params) + STEM
    square = complex(drive.sense * (STEM / 2 - beak), looper.arm - looper.stem - looper.bar / 2)
    made = rocker_parts(drive.rocker, mechanism, looper, params.width / params.drives, (square, looper.bar, 1.0))
    return LooperParts(params, needles, made, _hook(params, drive.sense, beak))


def _hook(params: TuftingMachineParams, sense: int, beak: float) -> Part:
    """A looper: its stem on the bar, its beak forward to the point at the origin; along z its thickness."""
    looper = params.looper
    slope = min(2 * looper.height, FREE * 5 / 6)
    corners = np.array(
        [
            0,
            -beak,
            -beak - 1j * looper.stem,
            -beak + STEM - 1j * looper.stem,
            -beak + STEM - 1j * looper.height,
            -slope - 1j * looper.height,
        ]
    )
    outline = polygon(corners if sense > 0 else -np.conj(corners))
    shape = Prism(Profile(outline), looper.thickness)
    return Part(LOOPER, "looper", "laser-cut part", shape, STEEL, joins=(LOOPER_BAR,))
