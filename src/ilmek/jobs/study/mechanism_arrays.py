"""Designs of a mechanism file as arrays: motion and forces of many at once, by the formulas of one.

A design belongs to the arrays if it differs from the file's own in numbers alone, closes everywhere, and stays so far
from every dead centre that none lies between two samples: at a margin of `CLEAR`, the sine of its transmission angle,
links that are in line half a step later would turn twenty times as quickly as the crank. All others are computed alone.
"""

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from ilmek.dynamics.input_loads import jumps
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.analysis import BALANCE, closes_check, dead_centres_check
from ilmek.jobs.mechanism.request import MotionRequest, driven_inputs
from ilmek.linkage.model import Rotation
from ilmek.linkage.structure import plan
from ilmek.studies.outcome import Numbers
from ilmek.units import deg

if TYPE_CHECKING:
    from ilmek.dynamics.machine_variants import MachineVariants

CLEAR, QUICKEST, STEP = 0.3, 5.0, 1.001 * deg
"""Least margin; greatest speed of a body over that of the crank; greatest step of the crank [rad]."""

RESIDUALS = ("power_residual", "frame_residual")
"""Self-tests of a machine with forces."""


def arrays_serve(machine: OwnMachine, request: MotionRequest) -> bool:
    """Whether designs like this are evaluated as arrays: one crank at constant speed; no more checks than of motion."""
    mechanism = machine.mechanism
    more = (
        *(mechanism.couplings, mechanism.redundant, machine.frictions, machine.actuators, machine.members),
        *(machine.pins, machine.forward, machine.study, machine.servo, machine.transmission),
    )
    alone = len(mechanism.inputs) == 1 and isinstance(mechanism.inputs[0], Rotation)
    if any(more) or not alone or request.fixed or request.fluctuation != "":
        return False
    driven = driven_inputs(machine, plan(mechanism), request)
    jumping = any(jumps(one.load, mechanism.inputs[0].name) for one in machine.loads)
    in_time = driven.time is not None and (driven.time[0] == 0 or not machine.loads)
    steps = float(np.abs(np.diff(driven.values)).max())
    return driven.speed is not None and in_time and not jumping and steps <= STEP


def numbers_by_arrays(
    base: OwnMachine, machines: Mapping[int, OwnMachine], request: MotionRequest, results: Sequence[str]
) -> dict[int, Numbers]:
    """The numbers of those machines, by their places, that arrays serve; base: that of the file."""
    driven = driven_inputs(base, plan(base.mechanism), request)
    moved = {place: one for place, one in machines.items() if _start(one) == _start(base)}
    alike = (
        moved if _stack(base, *moved.values()) else {place: one for place, one in moved.items() if _stack(base, one)}
    )
    if not alike:
        return {}
    turning = [f"{body} omega" for body in base.mechanism.moving]
    residuals = RESIDUALS if base.has_forces else ()
    want = tuple(dict.fromkeys((*results, *turning, *residuals)))
    try:
        found = _variants(alike).evaluate(values=driven.values, want=want, speed=driven.speed)
    except MechanismError:
        return {}
    quickest = np.max([np.abs(found[name]).max(axis=-1) for name in turning], axis=0)
    good = (found.closes == 1) & (found.margin >= CLEAR) & (quickest <= QUICKEST * abs(driven.speed or 1.0))
    for name in residuals:
        good &= found[name] <= BALANCE
    checks = (*((closes_check(1.0),) if request.over or not driven.assumed else ()), dead_centres_check(0))
    return {
        place: Numbers({name: float(found[name][n]) for name in results}, {}, checks)
        for n, place in enumerate(alike)
        if good[n]
    }


def _start(machine: OwnMachine) -> list[tuple[float | None, float]]:
    """Speed and first value of the motion that a machine gives to its input."""
    return [(one.speed, float(one.law(np.zeros(1))[0][0])) for one in machine.motions.values()]


def _stack(*machines: OwnMachine) -> bool:
    """Whether machines differ in numbers alone."""
    try:
        return bool(_variants(dict(enumerate(machines))).stacked)
    except MechanismError:
        return False


def _variants(machines: Mapping[int, OwnMachine]) -> "MachineVariants":
    kind = import_module("ilmek.dynamics.machine_variants").MachineVariants  # the compiler
    variants: MachineVariants = kind({"place": np.array([*machines])}, tuple(machines.values()))
    return variants
