"""A beat-up in use: strength of links and pins, start and stop of its crank, its travel along the carpet."""

import math
from functools import lru_cache

from ilmek.machines.beat_up.beam import POST, BeatBeam, beam_for
from ilmek.machines.beat_up.carriage import BLOCK_MASS, on_slide
from ilmek.machines.beat_up.crank_start import CrankDuty, CrankStart, crank_start, start_checks, start_parts
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.strength import BeatUpStrength, beat_up_strength_checks, frame_force
from ilmek.machines.beat_up.travel import BeaterTravel, slide_length, travel, travel_checks, with_slide_mass
from ilmek.records import group, record
from ilmek.report import Check, Choice
from ilmek.weaving.fell import Fabric, assumed_fabric

_ROUNDS = 3

WARP_LENGTH = 1.5
"""Length of a warp [m] from fell to beam where no loom gives it."""


@record
class BeatUpUse:
    """Strength, travel and start of a beat-up, by its own parameters."""

    strength: BeatUpStrength = group()
    travel: BeaterTravel = group()
    start: CrankStart = group()
    beam: BeatBeam = group()


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
    return on_its_beam(design, across, crank_start(duty, params.start))


def on_its_beam(design: BeatUp, across: BeaterTravel, start: CrankStart) -> BeatUpUse:
    """The beat-up with the slide for all that stands on it, and the beam that carries both.

    A heavier beam raises the slide, whose carriage then has a larger plate; the mass follows the beam's in rounds.
    """
    length = max(across.params.beam_length or 0.0, slide_length(across) + 2 * POST)
    force, drive = frame_force(design.state), start_parts(start)
    moving = math.fsum(body.mass for body in design.bodies.values())
    high = 0.0
    for _ in range(_ROUNDS):
        standing = math.fsum(
            occurrence.part.mass * len(occurrence.positions)
            for occurrence in on_slide(design, high, drive)
            if not math.isnan(occurrence.part.mass)
        )
        mass = across.params.slide_mass or moving + standing + BLOCK_MASS
        beam = beam_for(length, mass, force)
        if beam.section.side == high:
            break
        high = beam.section.side
    return BeatUpUse(design.strength, with_slide_mass(across, mass), start, beam)


def use_checks(use: BeatUpUse) -> tuple[Check, ...]:
    """Whether links, pins, motor and slide do their work."""
    own = (*travel_checks(use.travel), *start_checks(use.start), *use.beam.checks)
    return (*beat_up_strength_checks(use.strength), *own)


def use_choices(design: BeatUp) -> tuple[Choice, ...]:
    """What was chosen of pins, start and stop."""
    use = in_use(design)
    return (*use.strength.choices, *use.start.choices, use.beam.choice)
