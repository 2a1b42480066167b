"""The beam across the loom that carries crank-rockers: fixed on plates, or on a slide along it.

    F = m g + F_f,   s = F l³ / (48 E I) + 5 q l⁴ / (384 E I),   M = F l / 4 + q l² / 8

F_f is the greatest force of the beat on the frame, whatever its direction, in the middle of the span l, with the mass m
that the beam carries; q its own weight.                                       [`elements.columns`]
The lightest square hollow section that keeps both limits, the largest of the table where none does. It lies in front of
the pivot of the rocker, A, beyond its round end, its lower side level with that of the rocker at the beat.
"""

from functools import lru_cache

from ilmek.elements.columns import STEEL, HollowSquare, ascending, mid_loaded
from ilmek.elements.materials import GRAVITY
from ilmek.part.part import Part
from ilmek.part.shapes import square_tube
from ilmek.records import computed, record, result
from ilmek.report import Alternative, Check, Choice, at_most, choose
from ilmek.units import mm

BEAM = "beat-up/beam"
"""Id of the beam's part."""

BEFORE_PIVOT = 10 * mm
"""From the round end of the rocker to the beam [m]: assumed by this project."""

POST = 80 * mm
"""Room for a post under each end of the beam, beside the cylinders [m]: assumed by this project."""

PAST_RAIL = 130 * mm
"""From the end of the room of a rail of heads to that of the beam [m]: axes of the rail's retreat, and then a post, lie
under it; assumed by this project.
"""

SAFETY = 2.0
"""Of the beam against yielding; assumed by this project."""

SAG_SHARE = 1 / 2000
"""Allowed deflection over the span; assumed by this project."""


@record
class BeatBeam:
    """The beam; length: of it [m], span: between its posts [m], carried: force in its middle [N]."""

    section: HollowSquare
    length: float
    span: float
    carried: float
    choice: Choice
    sag: float = result("mm", "deflection of the beam that carries the beat", name="beat_beam_sag")
    stress: float = result("MPa", "stress of the beam that carries the beat", name="beat_beam_stress")

    beat_beam = computed("", "square hollow section of the beam that carries the beat", lambda it: it.section.name)

    @property
    def part(self) -> Part:
        """The beam, along z from z = 0."""
        shape = square_tube(self.section.side, self.section.wall, self.length)
        return Part(BEAM, "beam of the beat-up", "welded frame", shape, STEEL, machined=True)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Stress and deflection."""
        return beam_checks(self.section, self.span, self.carried)


@lru_cache(maxsize=16)
def beam_for(length: float, mass: float, force: float) -> BeatBeam:
    """The beam of a length [m] on its posts for a mass that it carries [kg] and a force of the beat [N]."""
    carried, span = mass * GRAVITY + force, length - POST
    sections = ascending()
    named = [Alternative(section.name, beam_checks(section, span, carried)) for section in sections]
    index, choice = choose("beat_beam", named)
    section = sections[index] if not named[index].failed else sections[-1]
    return BeatBeam(section, length, span, carried, choice, *mid_loaded(section, span, carried))


def beam_checks(section: HollowSquare, span: float, carried: float) -> tuple[Check, Check]:
    """Whether a section bears a force in the middle of a span, and how far it bends."""
    sag, stress = mid_loaded(section, span, carried)
    cure = "set a lower speed of the crank, or a narrower carpet"
    return (
        at_most(
            "deflection of the beat's beam", sag, SAG_SHARE * span, "mm", "span over 2000, assumed by this project"
        ).with_cure(cure, BEAM),
        at_most(
            "stress of the beat's beam",
            stress,
            STEEL.strength / SAFETY,
            "MPa",
            "yield of S235 over 2, assumed by this project",
        ).with_cure(cure, BEAM),
    )
