"""The looper's crank-rocker: synthesised by its dead centres so that the hook keeps the loop's windows.

The hook's point is on an arm R on the looper shaft P, the tip of the arm upward; forward it moves in the sense s, +1
along x (loop pile: with the backing), -1 against it (cut pile: the loops move onto the hook). The swing follows from
the way of the point, 2 R sin(psi / 2) = reach + retreat, and the crank-rockers of that swing form a family
(`synthesis.crank_rocker`), here mirrored in the ground link, so that it hangs under the bed plate. Its crank turns with
the main shaft, by a toothed belt 1:1. Of the rotations of the crank between the dead centres that one is chosen which
keeps the greatest distance from the ends of the window in which the hook has to leave, with a transmission angle that
is allowed; the phase of the crank puts the hook's entry into the middle of its window.
"""

import cmath
import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.machines.tufting_machine.loop import LoopGeometry, LoopWindow
from ilmek.machines.tufting_machine.params import LooperParams
from ilmek.num.piecewise import roots_of_turn
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least
from ilmek.synthesis.crank_rocker.dead_centres import (
    beta_of_ratio,
    links_of_ratio,
    ratio_limits,
    transmission_angle_min,
)
from ilmek.synthesis.crank_rocker.motion import moved
from ilmek.synthesis.crank_rocker.selection import Member, require_rotation
from ilmek.units import deg, format_quantity, turn

ROTATIONS = tuple(angle * deg for angle in range(140, 225, 5))
"""Rotations of the crank between the dead centres that are tried [rad]."""

MOST_SWING = 60 * deg
"""Greatest swing of the looper shaft; assumed by this project."""


@record
class LooperDrive:
    """A looper drive.

    linkage   link lengths over its ground link                offset  crank angle where the main shaft's is 0 [rad]
    sense     of the hook forward along x, +1 or -1
    passing   main crank angles at which the point passes the needle's line [rad]: forward, then backward
    """

    params: LooperParams
    linkage: Member
    sense: int
    offset: float
    passing: tuple[float, float]
    swing: float = result("deg", "swing of the looper shaft", name="looper_swing")
    rotation: float = result("deg", "crank between the ends of the swing", name="looper_crank_rotation")

    looper_links = computed("mm", "lengths of the looper's crank-rocker", lambda it: it.lengths)
    looper_transmission = computed(
        "deg", "least acute angle of its coupler and rocker", lambda it: float(transmission_angle_min(it.linkage.links))
    )
    looper_phase = computed("deg", "angle of its crank where the main shaft's is 0", lambda it: it.offset % turn)

    @property
    def lengths(self) -> dict[str, float]:
        """Lengths of its links [m]."""
        scale, links = self.params.ground, self.linkage
        return {
            "ground": scale,
            "crank": scale * links.crank,
            "coupler": scale * links.coupler,
            "rocker": scale * links.rocker,
        }

    @property
    def forward(self) -> float:
        """Swing of the arm from its middle at which the point is on the needle's line [rad], forward positive."""
        return _on_line(self.params, self.swing)

    def deviation(self, angle: FloatArray) -> FloatArray:
        """Swing of the arm from its middle, forward positive [rad], at crank angles of the main shaft [rad]."""
        return _deviation(self.linkage, self.swing, self.sense, np.asarray(angle) + self.offset)

    def ahead(self, angle: FloatArray) -> FloatArray:
        """The hook's point past the needle's line [m] at crank angles of the main shaft [rad]."""
        return np.asarray(self.params.arm * (np.sin(self.deviation(angle)) - math.sin(self.forward)))

    @property
    def checks(self) -> tuple[Check, ...]:
        """Transmission angle."""
        limit = self.params.transmission
        check = at_least(
            "transmission angle of the looper's rocker", self.looper_transmission, limit, "deg", "parameter looper"
        )
        return (
            check.with_cure(
                "set a longer looper.ground, or leave looper.crank_rotation open", "tufting-machine/looper-rocker"
            ),
        )


def _on_line(params: LooperParams, swing: float) -> float:
    return math.asin(math.sin(swing / 2) - params.reach / params.arm)


def _deviation(linkage: Member, swing: float, sense: int, angle: FloatArray) -> FloatArray:
    """Swing of the arm forward: s (alpha(-theta) - alpha_0), as the rocker of a mirror image turns the other way.

    angle  of the crank [rad], from the ground link
    """
    rocker = moved(linkage.links, -angle).rocker
    return np.asarray(sense * np.angle(rocker * np.exp(-1j * rocker_angle(linkage, swing))))


def rocker_angle(linkage: Member, swing: float) -> float:
    """Direction alpha_0 of the rocker in the middle of its swing, against the ground link [rad], before mirroring."""
    extended = (linkage.crank + linkage.coupler) * cmath.exp(1j * linkage.beta) - 1
    return cmath.phase(extended) + swing / 2


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
    ends = roots_of_turn(lambda angle: _deviation(linkage, swing, sense, angle) - line, samples=90)
    rising = _deviation(linkage, swing, sense, ends + 1e-6) > line
    (forward,), (backward,) = ends[rising].tolist(), ends[~rising].tolist()
    entry = window.middle + params.late
    passing = entry, entry + (backward - forward) % turn
    return LooperDrive(params, linkage, sense, forward - entry, passing, swing, rotation)


def _chosen(params: LooperParams, swing: float, sense: int, window: LoopWindow) -> float:
    """The crank's rotation between the dead centres [rad] with the best timing of the release.

    The hook holds the loop for the share of a turn in which it is past the needle's line, to a sample of 1 deg here.
    """
    angle, line = np.arange(360) * deg, _on_line(params, swing)
    tried = []
    for rotation in (params.crank_rotation,) if params.crank_rotation else ROTATIONS:
        linkage = _member(params, swing, rotation)
        allowed = bool(transmission_angle_min(linkage.links) >= params.transmission)
        release = window.middle + turn * float(np.mean(_deviation(linkage, swing, sense, angle) > line))
        tried.append((allowed, min(release - window.out, window.back - release), rotation))
    return max(tried)[2]


def _member(params: LooperParams, swing: float, rotation: float) -> Member:
    """The crank-rocker of a swing and a rotation of the crank [rad], of the given ratio or the next that exists."""
    require_rotation(swing, rotation)
    ratio = max(params.coupling, 1.05 * float(ratio_limits(swing, rotation).low))
    crank, coupler, rocker = (float(link) for link in links_of_ratio(swing, rotation, ratio))
    return Member(crank, coupler, rocker, float(beta_of_ratio(swing, rotation, ratio)))
