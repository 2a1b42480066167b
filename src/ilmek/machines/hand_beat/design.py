"""Design of the beat by hand: a comb whose leaves pass between the warps, as many blows as the rows need.

    E = m v² / 2,   n = b / p                energy of a blow, warps under the comb
    E / n + W(p(i-1)) = W(p(i)) + S(R(i))    blow i: what packing takes for good, what warps and cloth give back
    blows of a row = passes ceil(w / b) k    k: the first blow with R(k) >= R needed          [`weaving.fell`]

The weaver strikes less hard where a full blow is more than the rows need: `speed_needed` is that of a single blow.
"""

import math
from functools import lru_cache

from ilmek.elements.columns import STEEL
from ilmek.machines.hand_beat.params import HandBeatParams
from ilmek.machines.hand_beat.tools import comb_parts
from ilmek.records import computed, record, result
from ilmek.units import mm
from ilmek.weaving.fell import Fabric, assumed_fabric

LEAF_SHARE = 0.6
"""Thickness of a leaf over the gap of two warps; assumed by this project."""

_STEP = 0.05 * mm
"""Thicknesses of leaves are multiples of this [m]."""


@record
class HandBeat:
    """The beat, designed: fabric at the fell, and the forces of the blows [N]."""

    params: HandBeatParams
    fabric: Fabric
    leaf: float = result("mm", "thickness of a leaf", name="comb_leaf")
    mass: float = result("kg", "mass of the comb", name="comb_mass")
    forces: tuple[float, ...]

    blows = computed("1", "blows of a beat on a warp", lambda it: len(it.forces))
    blow_energy = computed("J", "energy of a blow", lambda it: it.mass * it.params.hands.blow_speed**2 / 2)
    blow_force = computed("N", "force of the last blow for a warp", lambda it: it.forces[-1])
    beat_force_needed = computed(
        "N",
        "force for a warp that the required row pitch needs, with the fabric as assumed",
        lambda it: float(it.fabric.resistance(it.params.cloth.row_distance)),
    )
    row_pitch_left = computed(
        "mm", "distance of the rows after these blows", lambda it: float(it.fabric.spacing(it.forces[-1]))
    )
    comb_warps = computed("1", "warps under the comb", lambda it: it.warps, least=0.0)
    stations = computed(
        "1",
        "combs beside each other across the warps",
        lambda it: math.ceil(it.params.cloth.width / it.params.comb_width * (1 - 1e-9)),
    )
    blows_per_row = computed("1", "blows of a row", lambda it: it.params.passes * it.stations * it.blows)
    leaf_stress = computed(
        "MPa",
        "stress of a leaf: 6 F a / (t h²)",
        lambda it: 6 * it.forces[-1] * it.params.reach / (it.leaf * it.params.leaf_height**2),
    )

    @computed("m/s", "speed of the comb at which one blow is enough")
    def speed_needed(self) -> float:
        return math.sqrt(2 * self.warps * self.fabric.energy(self.beat_force_needed) / self.mass)

    @computed("s", "time of the blows of a row, the weavers beside each other")
    def beat_time(self) -> float:
        return float(self.blows_per_row * self.params.hands.blow_time / self.params.weavers)

    @computed("s", "time of a weft by hand: passed from hand to hand, taken and put down")
    def weft_time(self) -> float:
        return self.params.hands.weft_time(self.params.cloth.width)

    @property
    def warps(self) -> int:
        """Warps under the comb, one for each leaf."""
        return warps_under(self.params)


def warps_under(params: HandBeatParams) -> int:
    """Warps under the comb."""
    return min(max(int(params.comb_width / params.cloth.warp_pitch * (1 + 1e-9)), 2), params.cloth.warps)


def leaf_of(params: HandBeatParams) -> float:
    """Thickness of a leaf [m]: as given, or a share of the gap of two warps in whole steps, one step at least."""
    gap = params.cloth.warp_pitch - params.cloth.carpet_yarns.warp.diameter
    return params.leaf or max(math.floor(LEAF_SHARE * gap / _STEP), 1) * _STEP


def blow_forces(fabric: Fabric, energy: float, needed: float, most: int) -> tuple[float, ...]:
    """Forces of blows of an energy [J], all for one warp [N], until one reaches the force needed, or the most blows."""
    forces: list[float] = []
    spent = 0.0
    while len(forces) < most and (not forces or forces[-1] < needed):
        forces.append(fabric.struck(energy + spent))
        spent = fabric.packing_work(float(fabric.spacing(forces[-1])))
    return tuple(forces)


@lru_cache(maxsize=8)
def design(params: HandBeatParams) -> HandBeat:
    """The comb and its blows."""
    cloth, leaf = params.cloth, leaf_of(params)
    stiffness = cloth.carpet_yarns.warp.stiffness
    fabric = assumed_fabric(cloth.row_distance, cloth.warp_tension, stiffness, params.warp_length)
    mass = sum(part.part.mass * len(part.positions) for part in comb_parts(params, leaf, warps_under(params)))
    energy = mass * params.hands.blow_speed**2 / 2 / warps_under(params)
    needed = float(fabric.resistance(cloth.row_distance))
    return HandBeat(params, fabric, leaf, mass, blow_forces(fabric, energy, needed, params.most_blows))


STRENGTH = STEEL.strength / 1.5
"""Allowed stress of leaf and shelf [Pa]: yield of S235 over 1.5; assumed by this project."""
