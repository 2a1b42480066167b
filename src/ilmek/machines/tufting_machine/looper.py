"""The looper's crank-rocker: synthesised by its dead centres so that the hook keeps the loop's windows.

The hook's point is on an arm R on the looper shaft P, the tip of the arm upward; forward it moves in the sense s, +1
along x (loop pile: with the backing), -1 against it (cut pile: the loops move onto the hook). The swing follows from
the way of the point, 2 R sin(psi / 2) = reach + retreat, and the crank-rockers of that swing form a family
(`synthesis.crank_rocker`), here mirrored in the ground link, so that it hangs under the bed plate. Its crank turns with
the main shaft, by a toothed belt 1:1. Of the rotations of the crank between the dead centres that one is chosen which
keeps the greatest distance from the ends of the window in which the hook has to leave, with a transmission angle that
is allowed; the phase of the crank puts the hook's entry into the middle of its window.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.tufting_machine.loop import LoopGeometry, LoopWindow
from ilmek.machines.tufting_machine.params import LooperParams
from ilmek.machines.tufting_machine.rocker_drive import RockerDrive, coupled, deviation
from ilmek.num.piecewise import roots_of_turn
from ilmek.records import group, record
from ilmek.report import Check, at_least
from ilmek.synthesis.crank_rocker.dead_centres import links_of_ratio, ratio_limits, transmission_angle_min
from ilmek.synthesis.crank_rocker.selection import Member, require_rotation
from ilmek.units import deg, format_quantity, turn

ROTATIONS = tuple(angle * deg for angle in range(140, 225, 5))
"""Rotations of the crank between the dead centres that are tried [rad]."""

MOST_SWING = 60 * deg
"""Greatest swing of the looper shaft; assumed by this project."""


@record
class LooperDrive:
    """A looper drive.

    passing   main crank angles at which the point passes the needle's line [rad]: forward, then backward
    """

    params: LooperParams
    rocker: RockerDrive = group("looper_")
    passing: tuple[float, float]

    @property
    def sense(self) -> int:
        """Of the hook forward along x, +1 or -1."""
        return self.rocker.sense

    @property
    def forward(self) -> float:
        """Swing of the arm from its middle at which the point is on the needle's line [rad], forward positive."""
        return _on_line(self.params, self.rocker.swing)

    def ahead(self, angle: FloatArray) -> FloatArray:
        """The hook's point past the needle's line [m] at crank angles of the main shaft [rad]."""
        return np.asarray(self.params.arm * (np.sin(self.rocker.deviation(angle)) - math.sin(self.forward)))

    def shaft(self, line: float, hook: float) -> complex:
        """The looper shaft [m]; line: of the needles along x, hook: height of its upper edge there [m]."""
        arm, forward = self.params.arm, self.forward
        return complex(line - self.sense * arm * math.sin(forward), hook - arm * math.cos(forward))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Transmission angle."""
        limit = self.params.transmission
        check = at_least(
            "transmission angle of the looper's rocker", self.rocker.transmission, limit, "deg", "parameter looper"
        )
        return (
            check.with_cure(
                "set a longer looper.ground, or leave looper.crank_rotation open", "tufting-machine/looper-rocker"
            ),
        )


def _on_line(params: LooperParams, swing: float) -> float:
    return math.asin(math.sin(swing / 2) - params.reach / params.arm)


def looper_drive(params: LooperParams, geometry: LoopGeometry, window: LoopWindow) -> LooperDrive:
    """The looper drive for the windows of a loop. Raises ParameterError for an arm that is too short."""
    sense = 1 if geometry.params.pile == "loop" else -1
    share = (params.reach + params.retreat) / (2 * params.arm)
    if share >= math.sin(MOST_SWING / 2):
        needed = (params.reach + params.retreat) / (2 * math.sin(MOST_SWING / 2))
        raise ParameterError(
            f"a looper on an arm of {format_quantity(params.arm, 'mm')} cannot reach its stroke",
            allowed=f"arm at least {format_quantity(needed, 'mm')} for a swing of 60 deg",
            do="set a longer looper.arm, or a smaller reach and retreat",
        )
    swing = 2 * math.asin(share)
    rotation = _chosen(params, swing, sense, window)
    linkage, line = _member(params, swing, rotation), _on_line(params, swing)
    ends = roots_of_turn(lambda angle: deviation(linkage, swing, sense, angle) - line, samples=90)
    rising = deviation(linkage, swing, sense, ends + 1e-6) > line
    (forward,), (backward,) = ends[rising].tolist(), ends[~rising].tolist()
    entry = window.middle + params.late
    passing = entry, entry + (backward - forward) % turn
    drive = RockerDrive("looper", linkage, params.ground, 0.0, sense, forward - entry, swing, rotation)
    return LooperDrive(params, drive, passing)


def _chosen(params: LooperParams, swing: float, sense: int, window: LoopWindow) -> float:
    """The crank's rotation between the dead centres [rad] with the best timing of the release.

    The hook holds the loop for the share of a turn in which it is past the needle's line, to a sample of 1 deg here.
    """
    angle, line = np.arange(360) * deg, _on_line(params, swing)
    tried = []
    for rotation in (params.crank_rotation,) if params.crank_rotation else ROTATIONS:
        linkage = _member(params, swing, rotation)
        allowed = bool(transmission_angle_min(linkage.links) >= params.transmission)
        release = window.middle + turn * float(np.mean(deviation(linkage, swing, sense, angle) > line))
        tried.append((allowed, min(release - window.out, window.back - release), rotation))
    return max(tried)[2]


def _member(params: LooperParams, swing: float, rotation: float) -> Member:
    """The crank-rocker of a swing and a rotation of the crank [rad], of the given ratio or the next that exists."""
    require_rotation(swing, rotation)
    ratio = max(params.coupling, 1.05 * float(ratio_limits(swing, rotation).low))
    return coupled(links_of_ratio(swing, rotation, ratio), swing, rotation)
