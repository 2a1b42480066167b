"""A beat-up in use: strength of links and pins, start and stop of its crank, its travel along the carpet."""

from functools import lru_cache

from ilmek.machines.beat_up.crank_start import CrankDuty, CrankStart, crank_start, start_checks
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.strength import BeatUpStrength, beat_up_strength_checks
from ilmek.machines.beat_up.travel import BeaterTravel, travel, travel_checks
from ilmek.records import group, record
from ilmek.report import Check, Choice
from ilmek.weaving.fell import Fabric, assumed_fabric

WARP_LENGTH = 1.5
"""Length of a warp [m] from fell to beam where no loom gives it."""


@record
class BeatUpUse:
    """Strength, travel and start of a beat-up, by its own parameters."""

    strength: BeatUpStrength = group()
    travel: BeaterTravel = group()
    start: CrankStart = group()


@lru_cache(maxsize=8)
def in_use(design: BeatUp, fabric: Fabric | None = None) -> BeatUpUse:
    """The beat-up that beats along the width; fabric: at the fell, default: of the thesis' warps at their pitch."""
    params = design.params
    across = travel(design, params.travel, params.start.run_up)
    if fabric is None:
        cloth = params.cloth
        stiffness = cloth.carpet_yarns.warp.stiffness
        fabric = assumed_fabric(cloth.row_distance, cloth.warp_tension, stiffness, WARP_LENGTH)
    duty = CrankDuty(
        linkage=design,
        number=1,
        fabric=fabric,
        warps=across.stroke_warps,
        force=across.stroke_warp_force,
        strokes=across.strokes if across.mode == "through" else 1,
        starts=1 if across.mode == "through" else across.strokes,
        pause=across.pause,
        every=params.interval,
    )
    return BeatUpUse(design.strength, across, crank_start(duty, params.start))


def use_checks(found: BeatUpUse) -> tuple[Check, ...]:
    """Whether links, pins, motor and slide do their work."""
    return (*beat_up_strength_checks(found.strength), *travel_checks(found.travel), *start_checks(found.start))


def use_choices(design: BeatUp) -> tuple[Choice, ...]:
    """What was chosen of pins, start and stop."""
    found = in_use(design)
    return (*found.strength.choices, *found.start.choices)
