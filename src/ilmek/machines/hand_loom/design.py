"""Design of the hand loom: cylinders that are wound by hand, the shed by hand, a frame; nothing but the beat is driven.

    row = knots / weavers * t_knot + 2 t_shed + wefts * t_weft + t_blows + t_wound w / advance
    row = ...                                                  + 2 (t_grip + t_beat) + ...              driven beat

t_knot by the knots of a weaver's day, which count all that she does for them; two changes of the shed a row, each moves
the rod and the levers and locks or unlocks them; t_wound: the carpet is wound on after it has grown by `advance`;
t_grip: all weavers take hold of their buttons for a driven beat.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from ilmek.machines.automated_loom.design import knotters
from ilmek.machines.automated_loom.feet import FOOT
from ilmek.machines.automated_loom.knotting import KnottingHead
from ilmek.machines.beat import BeatDrive
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Child
from ilmek.machines.hand_beat import HandBeat, HandBeatParams
from ilmek.machines.hand_loom.driven_beat import (
    BeatPosts,
    planned_drive,
    posts_for,
    row_with_weavers,
    shed_over,
    two_beats,
)
from ilmek.machines.hand_loom.layout import HandLoomLayout, laid_out
from ilmek.machines.hand_loom.params import HandLoomParams
from ilmek.machines.hand_shed import HandShed, HandShedParams
from ilmek.machines.loom_task import LoomTask, P
from ilmek.machines.warp_tension import WarpTensionDesign, WarpTensionParams
from ilmek.machines.warp_tension.design import USUAL
from ilmek.machines.weaver_hands import HAND
from ilmek.records import record
from ilmek.timing.cyclogram import Cyclogram
from ilmek.weaving.warping import WarpEnd

ACTS = 3
"""Acts of a change of the shed: rod, levers, locks."""

WEFTS = 2
"""Wefts of a row, each beaten, where the beat is driven. [Topalbekiroglu and Celik, 2.1.1]"""

WOUND = 6
"""Acts of winding the carpet on beside the turning of the wheels: locks, rod, both wheels, tension by feel; assumed."""


@record
class HandLoom:
    """A hand loom for one carpet: weavers, and the most that find room; its machines by name, its layout.

    drive  of the beat; None: the comb of the weavers, one of the machines
    """

    params: HandLoomParams
    rows: int
    columns: int
    weavers: int
    knotters_max: int
    machines: Mapping[str, Child]
    layout: HandLoomLayout
    drive: BeatDrive | None = None

    @property
    def heads_max(self) -> int:
        """Knotting heads that it can have: none."""
        return 0

    @property
    def children(self) -> tuple[Child, ...]:
        """Every machine in the loom."""
        drive = self.drive
        beats = () if drive is None else (Child(MACHINES[drive.name], drive.design, drive.number),)
        return (*beats, *self.machines.values())

    @property
    def winding(self) -> WarpTensionDesign:
        """The cylinders."""
        return self.machines["warp-tension"].design_as(WarpTensionDesign)

    @property
    def shed(self) -> HandShed:
        """Rod, heddles and levers."""
        return self.machines["hand-shed"].design_as(HandShed)

    @property
    def beat(self) -> HandBeat | BeatDrive:
        """What beats: comb and tools, or a drive."""
        return self.drive or self.machines["hand-beat"].design_as(HandBeat)

    @property
    def posts(self) -> BeatPosts | None:
        """The posts of a driven beat; None: a comb by hand has none."""
        return None if self.drive is None else posts_for(self.drive, self.layout.floor + FOOT + self.layout.base.side)

    @property
    def cyclograms(self) -> tuple[Cyclogram, ...]:
        """A row with its weavers, and its two beats; none where nothing is driven."""
        drive = self.drive
        return () if drive is None else (row_with_weavers(drive, self.row_acts), two_beats(drive.beat))

    def warp_guide(self, end: WarpEnd) -> str:
        """What lifts a warp: its string, or the rod that it passes in front."""
        return f"string heddle {(end.number + 1) // 2}" if end.odd else "shed rod"

    @property
    def row_acts(self) -> dict[str, float]:
        """Time of each act of a row [s]."""
        params, beat, hands = self.params, self.beat, self.params.hands
        wefts = beat.params.passes if isinstance(beat, HandBeat) else WEFTS
        return {
            "knots": math.ceil(self.columns / self.weavers) * params.knotted_share * params.hand_knot,
            **_of_wefts(params, wefts),
            **(
                {"blows": beat.beat_time}
                if isinstance(beat, HandBeat)
                else {"beats": wefts * (hands.act_time + beat.beat.whole)}
            ),
            "winding": self.winding_time * self.winding.params.cloth.row_distance / hands.advance,
        }

    @property
    def winding_time(self) -> float:
        """Time to wind the carpet on once [s]: both wheels one after the other."""
        winding, hands = self.winding, self.params.hands
        turned = winding.reducer.ratio * hands.advance / winding.outer_radius
        return 2 * turned / hands.crank_speed + WOUND * hands.act_time

    @property
    def row_time(self) -> float:
        """Time of a row [s]."""
        return sum(self.row_acts.values())


@lru_cache(maxsize=8)
def design(params: HandLoomParams) -> HandLoom:
    """The hand loom for a carpet. Raises CarpetError for a carpet without knots; the errors of its machines."""
    (rows, columns), cloth = params.knot_grid, params.cloth
    tying = KnottingHead(HAND, None, {})
    most = tying.most(columns, cloth.knot_pitch)
    weavers = knotters(params, most, tying)
    task, machines = LoomTask(params, rows, columns, cloth, {}), dict[str, Child]()
    hands = params.hands
    opened = HandShedParams(cloth=cloth, hands=hands, weavers=weavers, clearance=params.clearance)
    drive = None if params.beat == HAND else planned_drive(task, sum(_of_wefts(params, WEFTS).values()))
    shed: HandShed = _made("hand-shed", task, opened) if drive is None else shed_over(task, opened, drive)
    long = shed.params.free_length
    combed = HandBeatParams(cloth=cloth, hands=hands, weavers=weavers, warp_length=long)
    beat: HandBeat | BeatDrive = drive or _made("hand-beat", task, combed)
    pressed = beat.fabric.warp_rate * float(beat.fabric.fell(beat.beat_force_needed))
    wound = WarpTensionParams(
        cloth=cloth,
        width=task.width,
        winding=HAND,
        hands=hands,
        carpet_length=params.woven_size[1],
        free_length=long,
        shed_lift=shed.params.opening,
        shed_span=shed.params.heddle_height,
        tension_shed=shed.rear.tension,
        tension_shed_low=shed.front.tension,
        tension_beat=cloth.warp_tension + pressed,
        warps_beaten=min(beat.warps * weavers, cloth.warps) if isinstance(beat, HandBeat) else beat.beaten,
        rows_between=max(1, round(hands.advance / cloth.row_distance)),
        tube=USUAL,
    )
    winding: WarpTensionDesign = _made("warp-tension", task, wound)
    safety = params.column_safety, params.buckling_safety, params.column_bow
    layout = laid_out(winding, shed, params.pile.pile_height, safety)
    winding = _made("warp-tension", task, replace(wound, crank_shaft=layout.column.side))
    by_hand = {"hand-shed": shed, **({} if drive else {"hand-beat": beat}), "warp-tension": winding}
    machines = {name: Child(MACHINES[name], own) for name, own in by_hand.items()}
    return HandLoom(params, rows, columns, weavers, most, machines, layout, drive)


def _of_wefts(params: HandLoomParams, wefts: int) -> dict[str, float]:
    """Times of the changes of the shed and of the wefts of a row [s]."""
    hands = params.hands
    return {"shed": wefts * ACTS * hands.act_time, "wefts": wefts * hands.weft_time(params.cloth.width)}


def _made(name: str, task: LoomTask, derived: P) -> Any:
    """A machine for the task, with what the user set for it."""
    return MACHINES[name].design(task.parameters(name, derived))
