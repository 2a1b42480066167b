"""The beat-up paper's own machine: a crank-rocker on its carriage beats before warps that weavers tie and shed by hand.

The linkage follows the hand that beats from the height of the laid weft (`hands.weft_laid`), its slide lies on posts on
the front feet, and it stands beside the cloth while weavers work. Rod, strings and levers of the shed have their room
above all that beats; the levers lie, and hands lift them.

Source: Topalbekiroglu and Celik, 2.1.1 and Fig 1; it prints neither frame nor slide.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.columns import HollowSquare
from ilmek.machines import BEATS
from ilmek.machines.arrangement.side_view import HANDS
from ilmek.machines.automated_loom.cyclogram import LOOM, WEAVERS, beat_tracks, weavers_row
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.beating import beat_branch
from ilmek.machines.automated_loom.in_space.machines import joined
from ilmek.machines.automated_loom.joints import post_seam
from ilmek.machines.automated_loom.shaking import DISTANCE, beat_frequencies
from ilmek.machines.automated_loom.supports import beat_beam, post_checks, post_for
from ilmek.machines.beat import Beat, BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.hand_shed import HandShed, HandShedParams
from ilmek.machines.hand_shed.tree import SHED
from ilmek.machines.hand_shed.tree import tree as shed_tree
from ilmek.machines.loom_task import LoomTask
from ilmek.part.extents import around, extents
from ilmek.records import record
from ilmek.report import Check, at_least
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import deg, mm, turn

BEAT = "beat"
"""Cyclogram of both beats of a row, and the drive of the scene: the slide runs across, and back in the second."""

LYING = 110 * deg
"""Tilt of the shed's levers over what beats [rad]: they lie, and rise as hands lift them; assumed by this project."""

_REST = 1.0
"""Rest between two beats in their cyclogram [s]; weavers make it longer."""

_ROUNDS = 4


def planned_drive(task: LoomTask, wefts: float) -> BeatDrive:
    """The drive of the beat for a loom without a side view; wefts: time of a row without knots and beats [s]."""
    component = MACHINES[BEATS[task.params.beat]]
    assert component.beat is not None
    plan: PlannedBeat = component.beat(task, task.params.beat)
    return plan.drive(replace(task, period=wefts + 2 * plan.beat.whole))


@lru_cache(maxsize=8)
def two_beats(beat: Beat) -> Cyclogram:
    """The cyclogram of the two beats of a row, with a rest between them in the place of the weavers' acts."""
    period = 2 * (beat.whole + _REST)
    return Cyclogram(BEAT, period, beat_tracks(beat, period, turn * (0.5 - 0.5 * _REST / period)))


def row_with_weavers(drive: BeatDrive, acts: dict[str, float]) -> Cyclogram:
    """A row in its order: the first weft goes through the shed of the pulled rod, the second through that of strings.

    acts  times of a row [s], with both wefts, both changes of the shed and both beats in one each
    """
    grip = acts["beats"] / 2 - drive.beat.whole
    half = {name: acts[name] / 2 for name in ("shed", "wefts")}
    beats = ((WEAVERS, "hands on the buttons", grip), (LOOM, "beat", drive.beat.whole))
    first = (WEAVERS, "weft", half["wefts"]), *beats
    second = (WEAVERS, "shed of strings", half["shed"]), (WEAVERS, "second weft", half["wefts"])
    back = (WEAVERS, "shed of the rod", half["shed"]), *((who, f"{act} again", time) for who, act, time in beats)
    return weavers_row(
        ((WEAVERS, "knots", acts["knots"]), *first, *second, *back, (WEAVERS, "winding on", acts["winding"]))
    )


@lru_cache(maxsize=8)
def top_of(drive: BeatDrive) -> float:
    """How far what beats reaches over the fell in both beats [m], its carriage among it."""
    return float(around(extents(joined((beat_branch(drive, two_beats(drive.beat)),)), (BEAT,)))[1][1])


@lru_cache(maxsize=8)
def lowest_of(shed: HandShed) -> float:
    """The lowest of the shed's parts over the fell in a change [m]."""
    return float(around(extents(shed_tree(shed), (SHED,)))[0][1])


def shed_over(task: LoomTask, derived: HandShedParams, drive: BeatDrive) -> HandShed:
    """The shed whose parts are above what beats: its heights raised by whole millimetres where they are too low."""
    derived, machine = replace(derived, lever_tilt=LYING), MACHINES["hand-shed"]
    shed: HandShed = machine.design(task.parameters("hand-shed", derived))
    for _ in range(_ROUNDS):
        up = top_of(drive) + task.params.clearance - lowest_of(shed)
        if up <= 0:
            break
        step = math.ceil(up / mm) * mm
        heights = {name: getattr(derived, name) + step for name in _HEIGHTS}
        derived = replace(derived, **heights, rod_high=max(derived.rod_high, heights["rod_low"] + _STROKE))
        shed = machine.design(task.parameters("hand-shed", derived))
    return shed


_HEIGHTS = ("weft_height", "heddle_height", "rod_low", "free_length")
_STROKE = 0.3
"""Stroke of the rod at least [m]: pushed up it stays within the reach of weavers who stand; assumed by this project."""


@record
class BeatPosts:
    """The posts of the beat's beam on the front feet: section, height and depth of their axis [m], force of
    one [N], and whether it is across.
    """

    section: HollowSquare
    height: float
    depth: float
    force: float
    across: bool

    @property
    def checks(self) -> tuple[Check, ...]:
        """Strength and stiffness of a post, and its weld."""
        side, wall, moment = self.section.side, self.section.wall, self.force * self.height if self.across else 0.0
        weld = post_seam("post of the beat", "beat-post", side, wall, self.force, moment)
        return (*post_checks(self.section, self.height, self.force, across=self.across), weld.check)


def posts_for(drive: BeatDrive, level: float) -> BeatPosts:
    """The lightest posts that are strong and stiff; level: upper side of the feet under them [m]."""
    (beam, corner), across = beat_beam(drive), drive.crank_rockers > 0
    height, force = corner.imag - level, beam.carried / 2 if across else beam.carried
    least = DISTANCE * max(beat_frequencies(drive).values())
    section = post_for(height, force, sum(part.mass_all for part in drive.parts) / 2, least, across=across)
    return BeatPosts(section, height, corner.real + beam.section.side / 2, force, across)


def room_checks(drive: BeatDrive, shed: HandShed) -> Iterator[Check]:
    """Whether the shed is above what beats, the front warps behind it, and hands that tie below what is not beside."""
    path, clearance = drive.path, drive.task.params.clearance
    beating = np.concatenate([path.carried(one, path.tip).ravel() for one in path.outline[1:]])  # all but the teeth
    slope, half = shed.rod.outer / 2 / shed.params.rod_low, shed.params.cloth.carpet_yarns.warp.diameter / 2
    before = float(np.min(beating.real - slope * np.maximum(beating.imag, 0.0))) - half
    yield at_least(
        "what beats before the front warps", before, clearance, "mm", "parameter clearance; teeth are between them"
    ).with_cure("set a larger bar_distance or reach", *drive.striking)
    if not drive.beat.park:
        yield at_least(
            "what beats over the hands that tie",
            path.rise - HANDS.imag,
            clearance,
            "mm",
            "parameter clearance; assumed",
        ).with_cure("set a higher hands.weft_laid", *drive.striking)
    yield at_least(
        "shed over what beats",
        lowest_of(shed) - top_of(drive),
        drive.task.params.clearance * (1 - 1e-9),
        "mm",
        "parameter clearance; boxes of all parts over a change and over both beats",
    ).with_cure("leave the heights of hand-shed open", part_id("beat-post"), *drive.striking)
