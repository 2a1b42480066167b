"""Whether motors drive all that can move, one for each degree of freedom, and whether each motor has its power."""

from ilmek.machines.automated_loom.cabinet import AMPLIFIER
from ilmek.part.drive_balance import drive_balance
from ilmek.part.tree import Tree
from ilmek.report import Check, at_least, at_most


def drive_checks(tree: Tree) -> tuple[Check, ...]:
    """Degrees of freedom against those that motors take, motors against these, and against their amplifiers."""
    free = drive_balance(tree)
    held = {body.id: body.occurrences for body in tree.bodies}
    parts = (occurrence.part.id for body in free.undriven for occurrence in held[body])
    named, passive = ", ".join(free.undriven), f"rank of joints, transmissions and motors; passive: {len(free.passive)}"
    return (
        at_most(
            "degrees of freedom", free.number, free.driven, "1", f"no motor holds: {named}" if named else passive
        ).with_cure("give the bodies named a motor, or what keeps them to a body that has one", *dict.fromkeys(parts)),
        at_most(
            "axes that motors drive",
            free.axes,
            free.driven,
            "1",
            f"in excess: {', '.join(free.excess)}"
            if free.excess
            else "motors of the tree, and the rank that each adds",
        ).with_cure("leave out the motors named, or give each a body to drive", *free.excess),
        _power(tree),
    )


def _power(tree: Tree) -> Check:
    """Each motor has a power, and an amplifier in the cabinet."""
    counted = list(tree.occurrences())
    motors = [(part, number) for part, number in counted if part.purchase is not None and part.purchase.drives]
    weak = tuple(part.id for part, _ in motors if part.purchase is not None and not part.purchase.power > 0)
    amplifiers = sum(number for part, number in counted if part.id == AMPLIFIER)
    source = f"no power: {', '.join(weak)}" if weak else "amplifiers in the cabinet, one for each motor"
    return at_least(
        "motors with power", 0 if weak else amplifiers, sum(number for _, number in motors), "1", source
    ).with_cure("give each motor its power and an amplifier", AMPLIFIER, *weak)
