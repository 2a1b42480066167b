"""Check of an own machine over an inverse run: its drive keeps it moving."""

from ilmek.dynamics.inverse_run import InverseRun
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
            format_quantity(float(one), "deg" if run.turning else "mm") for one in (values.min(), values.max())
        )
        where = f"; it locks at {run.driving} from {first} to {last}"
    source = f"the drive keeps it moving against the friction of its joints{where}"
    cure = "lower the friction, lengthen the guides, or improve the transmission angle there"
    return (must("not self-locking", not run.locked.any(), source, cure=cure),)
