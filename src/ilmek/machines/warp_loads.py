"""What all warps pull in the three cases of a loom: standing, shed open, beat. What bears them is checked by the worst.

standing    n T
shed open   n/2 (T' + T''): the lifted half and the other one, after the tension compensator
beat        n (T + kw x): the fell yields by x under the force R that the required rows need     [`weaving.fell`]
"""

from ilmek.machines.loom_task import LoomTask
from ilmek.records import computed, record, result
from ilmek.weaving.fell import Fabric
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import RATE_SHARE, TENSION_LEAST, TENSION_MOST, bars_needed, compensated_tension

STANDING, SHED, BEAT = "standing", "shed open", "beat"


@record
class WarpLoads:
    """Tensions of a warp in the three cases [N]; `beaten`: warps that are beaten at once."""

    warps: int
    beaten: int
    rest: float
    lifted: float = result("N", "tension of a lifted warp, the shed open", name="tension_lifted")
    others: float = result("N", "tension of the other warps then", name="tension_not_lifted")
    beat: float = result("N", "tension of a warp that is beaten", name="tension_beat")

    pulls = computed("kN", "pull of all warps, by case", lambda it: {case: it.pull(case) for case in it.cases})
    worst_case = computed("", "case of the greatest pull", lambda it: max(it.cases, key=it.pull))
    worst_pull = computed("kN", "greatest pull of all warps", lambda it: it.worst)
    worst_tension = computed("N", "greatest tension of a warp", lambda it: max(it.rest, it.lifted, it.beat))

    @property
    def cases(self) -> dict[str, float]:
        """Mean tension of a warp by case [N]."""
        even = (self.warps + 1) // 2 / self.warps
        shed = even * max(self.lifted, self.others) + (1 - even) * min(self.lifted, self.others)
        beat = self.rest + (self.beat - self.rest) * self.beaten / self.warps
        return {STANDING: self.rest, SHED: shed, BEAT: beat}

    def pull(self, case: str) -> float:
        """Pull of all warps in a case [N]."""
        return self.warps * self.cases[case]

    @property
    def worst(self) -> float:
        """Greatest pull of all warps [N]."""
        return max(map(self.pull, self.cases))


def beat_tension(fabric: Fabric, row_pitch: float) -> float:
    """Tension of a warp [N] while the fell resists with the force that rows at a pitch [m] need.

    >>> from ilmek.weaving.fell import assumed_fabric
    >>> round(beat_tension(assumed_fabric(4e-3, 15.0, 1800.0, 1.5), 4e-3), 9)
    17.5
    """
    needed = float(fabric.resistance(row_pitch))
    return fabric.tension + fabric.warp_rate * float(fabric.fell(needed))


def planned_compensation(task: LoomTask, gain: float) -> float:
    """Share of a lifted warp's lengthening that the compensator will give to it, before it is designed.

    gain  of the warp's tension in the open shed on a fixed back rest [N]
    """
    tension, share = task.cloth.warp_tension, _planned(task)[0]
    number = planned_bars(task, gain)
    return 1 - (compensated_tension(tension, gain, number, share)[0] - tension) / gain if gain > 0 else 0.0


def planned_bars(task: LoomTask, gain: float) -> int:
    """Bars that the compensator will have; gain as above."""
    *limits, bars = _planned(task)
    return int(bars) or bars_needed(task.cloth.warp_tension, gain, *limits)


def _planned(task: LoomTask) -> tuple[float, float, float, float]:
    """Rate of the compensator over its warps', greatest and least tension over that at rest; bars, 0: as required."""
    given = task.params.machines.of("tension-compensator")
    usual = {"rate_share": RATE_SHARE, "tension_most": TENSION_MOST, "tension_least": TENSION_LEAST, "bars": 0.0}
    share, most, least, bars = (_number(given.get(name), value) for name, value in usual.items())
    return share, most, least, bars


def _number(value: object, usual: float) -> float:
    return float(value) if isinstance(value, int | float) else usual


def loads_in_loom(task: LoomTask) -> WarpLoads:
    """The loads of a loom's warps; with the tensions that its compensator leaves, where it is among the designs.

    For the beat the compensator is taken as fixed: that stretches the warps most.
    """
    side, tension, stiffness = task.side, task.cloth.warp_tension, task.yarns.warp.stiffness
    assert side is not None
    compensator = task.compensator
    if compensator is None:
        longer = float(shed_lengthening(side.lift, side.front_span, side.back_span))
        lifted, others = tension + stiffness / side.warp_length * longer, tension
    else:
        lifted, others = compensator.tension_open, compensator.tension_low
    if task.beat is None:
        return WarpLoads(task.cloth.warps, task.cloth.warps, tension, lifted, others, tension)
    return WarpLoads(task.cloth.warps, task.beat.beaten, tension, lifted, others, tension + task.beat.warp_force_extra)
