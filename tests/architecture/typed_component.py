"""What a type checker proves of a component: mypy checks this file with `src`, and an ignored error that is none fails.

Each `type: ignore` below stands for a mistake that the types must refuse.
"""

from dataclasses import dataclass
from typing import assert_type

from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign
from ilmek.machines.component import Component, itself
from ilmek.params import Params
from ilmek.report import Check


@dataclass(frozen=True, slots=True)
class LampParams(Params):
    """Parameters."""


@dataclass(frozen=True, slots=True)
class Lamp:
    """A design."""

    params: LampParams


@dataclass(frozen=True, slots=True)
class Light:
    """An analysis."""

    lamp: Lamp


def checks_of_lamp(_: Lamp) -> tuple[Check, ...]:
    """Checks that take the design."""
    return ()


def checks_of_light(_: Light) -> tuple[Check, ...]:
    """Checks that take the analysis."""
    return ()


PLAIN = Component(name="lamp", title="", params=LampParams, design=Lamp, analysis=itself, checks=checks_of_lamp)
ANALYSED = Component(name="lamp", title="", params=LampParams, design=Lamp, analysis=Light, checks=checks_of_light)


def inferred() -> None:
    """Components of a design, of an analysis, and a real one; never called: only the types count."""
    assert_type(PLAIN, Component[LampParams, Lamp, Lamp])
    assert_type(ANALYSED, Component[LampParams, Lamp, Light])
    assert_type(LOOM.designed(AutomatedLoomParams()), LoomDesign)


def mistakes() -> None:
    """Checks of another record than the analysis, parameters of another machine, a design of another machine."""
    Component(  # type: ignore[misc]
        name="lamp",
        title="",
        params=LampParams,
        design=Lamp,
        analysis=Light,
        checks=checks_of_lamp,
    )
    Component(  # type: ignore[misc]
        name="lamp",
        title="",
        params=LampParams,
        design=Lamp,
        analysis=itself,
        checks=checks_of_light,
    )
    ANALYSED.designed(AutomatedLoomParams())  # type: ignore[arg-type]
    LOOM.report(Lamp(LampParams()))  # type: ignore[arg-type]
