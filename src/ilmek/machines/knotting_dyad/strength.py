"""Strength of an arm's links and joints over the cycle of a knot, for the worse of both arms.

The links' lowest natural frequency is compared to that of a change of the drives' acceleration, jerk over acceleration:
a motion with limited jerk excites a link little whose period is shorter than that change.
                                                                    [Biagiotti and Melchiorri, Trajectory Planning, 7]
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ilmek.arrays import FloatArray
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.loads import Load
from ilmek.machines.linkage_strength import LinkageStrength, linkage_loads, linkage_strength, strength_checks
from ilmek.machines.strength_params import LINK_MATERIALS, StrengthParams
from ilmek.params import kind
from ilmek.records import record
from ilmek.report import Check
from ilmek.units import turn

CURE = "set a larger link_width or link_thickness, or a lower joint_acceleration"


@dataclass(frozen=True, slots=True)
class ArmStrengthParams(StrengthParams):
    """What the links and joints of an arm bear; aluminium."""

    material: str = kind.choice("aluminium alloy", LINK_MATERIALS, doc="material of the links, for their strength")
    resonance: float = kind.ratio(
        1.0,
        at_least=0.1,
        at_most=1000.0,
        doc="required ratio of the links' lowest natural frequency to jerk over acceleration of the drives",
    )


@record
class LoadedArm:
    """Forces of an arm over the cycle, and what they were computed with."""

    forces: Forces
    inertias: dict[str, Inertia]
    loads: tuple[Load, ...]


def arm_strength(
    arms: Iterable[LoadedArm], times: FloatArray, limits: StrengthParams, section: tuple[float, float], rate: float
) -> LinkageStrength:
    """Strength of the arm with the greatest stress of a link.

    times  of the samples [s]      section  width and thickness of the links [m]
    rate   of a change of acceleration, jerk over acceleration [1/s]
    """
    line_mass = section[0] * section[1] * limits.of_links.density
    links = {"link 1": (), "link 2": ("P",)}
    found = (
        linkage_strength(
            linkage_loads(
                arm.forces,
                arm.inertias,
                arm.loads,
                links,
                ("O", "E"),
                speed=turn * rate,
                line_mass=line_mass,
                times=times,
            ),
            limits,
            dict.fromkeys(links, section),
        )
        for arm in arms
    )
    return max(found, key=lambda one: max(one.link_stress.values()))


def arm_strength_checks(found: LinkageStrength, parts: Mapping[str, str]) -> tuple[Check, ...]:
    """Whether links and joints of the arms bear the cycle; parts: ids of links and pins by name."""
    return strength_checks(found, stronger=CURE, drive="that of a change of acceleration", parts=parts)
