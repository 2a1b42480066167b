"""Masses of bought parts whose row has none: by their class, from length and power; assumed by this project.

m = each + per_m L + per_W P
"""

import math
from collections.abc import Mapping
from typing import NamedTuple


class ClassMass(NamedTuple):
    """Mass of one part of a class, with its length [kg/m] and its power [kg/W], and what the values are near to."""

    each: float = 0.0
    per_m: float = 0.0
    per_W: float = 0.0
    near: str = ""


CLASS_MASSES: Mapping[str, ClassMass] = {
    "servo": ClassMass(0.3, 0.0, 2.5e-3, "brushless servo motors: 0.55 kg of 100 W, 2.5 kg of 750 W, 4 kg of 1.5 kW"),
    "linear axis": ClassMass(1.5, 5.0, 0.0, "belt and screw axes of 50 to 60 mm: 4 to 6 kg/m and a carriage"),
    "belt": ClassMass(0.0, 0.05, 0.0, "toothed belts of polyurethane, 10 to 20 mm wide: 0.03 to 0.1 kg/m"),
    "belt and pulleys": ClassMass(0.2, 0.15, 0.0, "HTD 8M belts of 30 mm: 0.18 kg/m, and aluminium pulleys"),
    "bearing": ClassMass(0.3, 0.0, 0.0, "two cam rollers of 22 to 30 mm in a steel block"),
    "spring": ClassMass(0.1, 0.0, 0.0, "a spring to choose"),
    "control": ClassMass(
        60.0, 0.0, 0.0, "steel cabinet of 600 x 800 x 250 mm with its plate: 35 kg, and what is in it"
    ),
    "axis of the control": ClassMass(1.2, 0.0, 0.0, "amplifier of 0.1 to 1 kW: 0.8 to 1.5 kg, with its cable"),
}
"""By the kind of bought part."""


def class_mass(kind: str, length: float = 0.0, power: float = 0.0) -> float:
    """Mass of one part of a kind, of a length [m] and a power [W]: [kg]; nan for a kind without a row.

    >>> round(class_mass("servo", power=400.0), 3), class_mass("carpet")
    (1.3, nan)
    """
    row = CLASS_MASSES.get(kind)
    return math.nan if row is None else row.each + row.per_m * length + row.per_W * power
