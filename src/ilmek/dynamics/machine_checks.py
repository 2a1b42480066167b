"""Checks of an own machine over an inverse run: its drive keeps it moving, and what is judged is determined."""

from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.report import Check, must
from ilmek.units import format_quantity


def locking(run: InverseRun) -> tuple[Check, ...]:
    """That the drive keeps the machine moving against the friction of its joints; nothing without friction."""
    forces = run.forces
    if not forces.frictions:
        return ()
    where = ""
    if run.locked.any() and run.driving is not None:
        values = forces.motion.drives[run.driving].value[run.locked]  # type: ignore[index]
        first, last = (
            format_quantity(float(end), "deg" if run.turning else "mm") for end in (values.min(), values.max())
        )
        where = f"; it locks at {run.driving} from {first} to {last}"
    source = f"the drive keeps it moving against the friction of its joints{where}"
    cure = "lower the friction, lengthen the guides, or improve the transmission angle there"
    return (must("not self-locking", not run.locked.any(), source).with_cure(cure),)


def determined(machine: OwnMachine, run: InverseRun) -> tuple[Check, ...]:
    """That the forces of pins and links with a strength, and the drives, do not depend on what is open."""
    unknown = run.forces.undetermined
    source = f"depends on {unknown.cause}, which is not given"
    cure = (
        "leave it out of the strength; in place of a belt give gears of another ratio; set a redundant constraint free"
    )
    names = [f"pin {name}: force is determined" for name in machine.pins if name in unknown.joints]
    names += [f"{name}: forces are determined" for name in machine.members if name in unknown.bodies]
    drives = [f"drive of {name} is determined" for name in sorted(unknown.inputs)]
    alone = "leave out the friction of the joints with open forces"
    return tuple(must(name, False, source).with_cure(cure) for name in names) + tuple(
        must(name, False, source).with_cure(alone) for name in drives
    )
