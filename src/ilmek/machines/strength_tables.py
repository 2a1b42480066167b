"""Tables of the strength of a machine's links and pins (`machines.linkage_strength`)."""

import math

from ilmek.dynamics.link_strength import LinkStrength
from ilmek.elements.flat_section import FlatSection
from ilmek.machines.linkage_strength import LinkageStrength
from ilmek.report import Table, columns
from ilmek.units import MPa, format_quantity, mm, turn


def strength_table(strength: LinkageStrength, name: str) -> tuple[Table, ...]:
    """Links with stress, safeties and natural frequency; pins with force, stresses and wear."""
    links = tuple(
        (
            body,
            _size(strength.sections[body]),
            link.stress,
            _where(link),
            *(_finite(v) for v in (link.fatigue, link.buckling, link.frequency / turn)),
        )
        for body, link in strength.links.items()
    )
    pins = tuple(
        (pin, one.diameter, one.force, one.shear, one.bending, one.pressure, one.wear / MPa)
        for pin, one in strength.pins.items()
    )
    heads = columns("link | section | stress [MPa] | at | safety, fatigue | safety, buckling | natural frequency [Hz]")
    of_pins = columns("pin | diameter [mm] | force [N] | shear [MPa] | bending [MPa] | pressure [MPa] | p v in MPa m/s")
    return (
        Table(f"{name}-link-strength", "Strength of the links", heads, links),
        Table(f"{name}-pin-strength", "Strength of the pins", of_pins, pins),
    )


def _size(section: FlatSection) -> str:
    return f"{format_quantity(section.width / mm, '')} x {format_quantity(section.thickness, 'mm')}"


def _finite(value: float) -> float | str:
    return value if math.isfinite(value) else "-"


def _where(link: LinkStrength) -> str:
    start, end, at = link.position
    return f"{start} to {end}, {format_quantity(at, 'mm', 3)}" if start else ""
