"""Knotting report, section 5: joint forces and drive torque, at rest and per w1², against the machine.

The report's signs, as its Fig 5 has them: F2' = (x, -y) on link 2, F2 = (-x, -y) on link 2, F1' = (x, y) on link 3,
F1 = (-x, y) on link 1.
"""

from collections.abc import Callable
from functools import partial

from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.units import mm
from ilmek.verification.claim import Claim
from ilmek.verification.knotting_force_steps import AT_REST, BY_SPEED, JOINTS
from ilmek.verification.knotting_force_steps import torque as from_moments
from ilmek.verification.knotting_pose import quoted, vector

SIGNS = {"F2'": ("O2'", 1 - 1j), "F2": ("O2", -1 - 1j), "F1'": ("O1'", 1 + 1j), "F1": ("O1", -1 + 1j)}
"""The machine's pin and the signs of x and y, by the report's name."""

_claim = partial(Claim, "knotting")


def rest(of: Callable[[KnottingState], complex]) -> complex:
    """Values at rest."""
    return of(quoted().static)


def swing(of: Callable[[KnottingState], complex]) -> complex:
    """Values per ω1²."""
    return of(quoted().unit) - of(quoted().static)


def joint(name: str) -> Callable[[KnottingState], complex]:
    """A joint's force [N] with the report's signs."""
    pin, sign = SIGNS[name]

    def turned(state: KnottingState) -> complex:
        force = complex(state.pins[pin][0])
        return complex(sign.real * force.real, sign.imag * force.imag)

    return turned


def claims() -> tuple[Claim, ...]:
    """The forces, joint by joint, and the torque."""
    static = {"F2'": ("78.34", "-17.4"), "F2": ("78.34", "32.4"), "F1'": ("-78.34", "17.4"), "F1": ("78.34", "-32.36")}
    moving = {
        "F2'": ("7888.8", "1378.7"),
        "F2": ("7851.37", "394.43"),
        "F1'": ("6606.2", "4624.2"),
        "F1": ("7851.27", "-394.53"),
    }
    at = "5, forces"

    def torque(state: KnottingState) -> complex:
        return complex(state.torque[0]) / mm

    rows = ((AT_REST, "N", rest, static), (BY_SPEED, "N s²", swing, moving))
    return (
        *(
            component
            for what, unit, part, printed in rows
            for name in SIGNS
            for component in vector(
                f"{name} {what}",
                printed[name],
                unit,
                partial(part, joint(name)),
                at,
                **JOINTS[f"{name} {what}"].of_claim(),
            )
        ),
        _claim(
            "M1 at rest",
            "6448.4",
            "N mm",
            lambda: rest(torque).real,
            at,
            follows=partial(from_moments, what=AT_REST),
            slips=("moment of weight lost",),
            right=lambda of: from_moments(of, AT_REST) - of["link 1: moment of the weight"],
        ),
        _claim(
            "M1 by ω1²",
            "484714.7",
            "N mm s²",
            lambda: swing(torque).real,
            at,
            follows=partial(from_moments, what=BY_SPEED),
        ),
    )
