"""Variants of a machine of one's own: masses, loads and dimensions that differ, forces of all of them as arrays.

The machines are stacked: a number that differs becomes an array of the shape (variants, 1), and the equations of one
machine, unchanged, give the forces of all.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray, RealField
from ilmek.dynamics.inverse_run import InverseRun, inverse_run
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.dynamics.pose_block import BLOCK
from ilmek.errors import MechanismError
from ilmek.linkage.model import Mechanism
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.linkage.variants import (
    VariantResults,
    check_result_names,
    given_arrays,
    in_blocks,
    motion_result,
    result_names,
    variant_motion,
)
from ilmek.records import layout, with_fields
from ilmek.units import turn as full_turn


class MachineVariants:
    """Variants of a machine; `MechanismFile.vary` makes them.

    given     what varies, by name [SI], broadcast to one shape
    machines  of them, in the order of the arrays' entries
    """

    def __init__(self, given: Mapping[str, np.ndarray], machines: Sequence[OwnMachine]) -> None:
        self.given, self.machines = given, tuple(machines)

    @cached_property
    def _plan(self) -> Any:
        return plan(self.machines[0].mechanism)

    @property
    def stacked(self) -> OwnMachine:
        """All as one machine, see `stacked_machine`."""
        return stacked_machine(self.machines)

    def evaluate(
        self, turn: int = 73, *, want: Sequence[str], values: RealField | None = None, speed: float | None = None
    ) -> VariantResults:
        """Results of all variants over one motion of the only input at constant speed.

        turn, values, want  as of `Variants.evaluate`; want also results of the machine's forces, `drive_torque_rms`,
                            `pin_forces_max.B`, as `ilmek mechanism` reports them
        speed  of the input [rad/s; m/s]; default: that of the machine, or 1
        Raises MechanismError for other names, for several inputs, for a group without a closed form, and where the
        variants differ in more than points, masses and loads.
        """
        machine = self.machines[0]
        if len(machine.mechanism.inputs) != 1:
            raise MechanismError(f"{machine.mechanism.name} has several inputs", allowed="one", do="use a study")
        name = machine.mechanism.inputs[0].name
        law = machine.motions.get(name)
        rate = speed if speed is not None else (law.speed if law is not None and law.speed is not None else 1.0)
        samples = np.linspace(0.0, full_turn, turn) if values is None else np.atleast_1d(values).astype(float)
        if len(samples) > BLOCK:
            raise MechanismError(f"{len(samples)} samples", allowed=f"at most {BLOCK:,} of each variant")
        moved = result_names(machine.mechanism)
        check_result_names(want, (*moved, *self._loaded_names()))
        loaded = not set(want) <= set(moved)
        if loaded and (machine.frictions or machine.actuators):
            given = f"{machine.mechanism.name} has joint friction, or actuators"
            raise MechanismError(given, allowed="forces of variants without both", do="use `study`")

        def results(part: slice) -> Iterator[np.ndarray]:
            both = stacked_machine(self.machines[part])
            motion, margin = variant_motion(
                self._plan, varied_points(both, machine.mechanism, len(self.machines[part])), samples, rate
            )
            time = (samples - samples[0]) / rate if rate else None
            run = (
                inverse_run(with_fields(both, mechanism=motion.plan.mechanism), motion, name, time) if loaded else None
            )
            yield margin
            yield np.mean(motion.status == Status.OK, axis=-1)
            for one in want:
                yield motion_result(motion, one) if one in moved else run_result(run, one, len(motion))

        margin, closes, *found = in_blocks(results, self.given, len(samples), BLOCK)
        return VariantResults(self.given, samples, closes, margin, dict(zip(want, found, strict=True)))

    def _loaded_names(self) -> tuple[str, ...]:
        joints = [joint.name for joint in self.machines[0].mechanism.joints]
        names = [one.name for _, one, _ in layout(InverseRun) if one is not None and one.name != "undetermined"]
        return (*names, *(f"{name}.{joint}" for name in names for joint in joints))


def varied_machines(
    values: Mapping[str, Any], units: Mapping[str, str], machine: Callable[[Mapping[str, float]], OwnMachine]
) -> MachineVariants:
    """The variants of values by name, arrays that broadcast, in these units; machine: that of one row of values."""
    shaped = given_arrays(values, units)
    rows = zip(*(one.ravel().tolist() for one in shaped.values()), strict=True)
    return MachineVariants(shaped, [machine(dict(zip(shaped, row, strict=True))) for row in rows])


def run_result(run: InverseRun | None, name: str, variants: int) -> np.ndarray:
    """A result of a run by its name, of every variant; of a group without an entry the greatest of its entries."""
    whole, _, key = name.partition(".")
    attribute = next(attribute for attribute, one, _ in layout(InverseRun) if one is not None and one.name == whole)
    value = getattr(run, attribute)
    if isinstance(value, Mapping):
        if key and key not in value:
            raise MechanismError(f"no result {name!r}", allowed=", ".join(f"{whole}.{one}" for one in value))
        value = value[key] if key else np.fmax.reduce(list(value.values()))
    if value is None:
        raise MechanismError(f"{name} does not exist for this machine", do="leave it out")
    return np.broadcast_to(np.asarray(value, dtype=float), (variants,))


def stacked_machine(machines: Sequence[OwnMachine]) -> OwnMachine:
    """The machines as one whose numbers are arrays, (variants, 1), where they differ.

    Raises MechanismError for a difference in more than points, masses, loads and friction.
    """
    names = ("mechanism", "inertias", "gravity", "loads", "frictions")
    return with_fields(machines[0], **{name: _stacked([getattr(m, name) for m in machines], name) for name in names})


def _stacked(values: Sequence[Any], name: str) -> Any:
    first = values[0]
    kind = type(first)
    if all(value is first for value in values) or kind in (str, bool, int) or any(type(v) is not kind for v in values):
        same = all(value == first for value in values)
    elif isinstance(first, float | complex):
        return first if all(value == first for value in values) else np.array(values)[:, None]
    elif is_dataclass(first):
        parts = {f.name: _stacked([getattr(one, f.name) for one in values], f"{name}.{f.name}") for f in fields(first)}
        return with_fields(first, **parts)
    elif isinstance(first, Mapping) and all(value.keys() == first.keys() for value in values):
        return {key: _stacked([value[key] for value in values], f"{name}.{key}") for key in first}
    elif isinstance(first, tuple) and all(len(value) == len(first) for value in values):
        return tuple(_stacked(entries, f"{name}.{n}") for n, entries in enumerate(zip(*values, strict=True)))
    else:
        same = all(value == first for value in values)
    if not same:
        allowed = "points, masses and loads that vary"
        raise MechanismError(f"{name} differs between the variants", allowed=allowed, do="use `study`")
    return first


def varied_points(machine: OwnMachine, first: Mechanism, variants: int) -> dict[tuple[str, str], ComplexArray]:
    """(body, point) -> its position in each variant [m] of a stacked machine, where it differs from that of the first.

    One point at least, for their number.
    """
    points = {(body.name, name): at for body in machine.mechanism.bodies for name, at in body.points.items()}
    varied = {key: at for key, at in points.items() if np.ndim(at) or at != first.point(*key)}
    varied = varied or dict([*points.items()][:1])
    return {key: np.broadcast_to(np.ravel(np.asarray(at, dtype=complex)), variants) for key, at in varied.items()}
