"""The parts of a tufting machine against each other where the first needle crank lies along x."""

from functools import lru_cache

from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.tree import tree
from ilmek.part.contacts import Contacts, contacts
from ilmek.part.drive_balance import drive_balance
from ilmek.records import computed, record
from ilmek.report import Check, Table, at_most


@record
class TuftingAssembly:
    """The parts of a machine at rest: what touches, and what is through each other."""

    machine: TuftingMachine
    contacts: Contacts

    buildable = computed(
        "", "no part through another at rest, all in one group", lambda it: all(check.ok for check in it.checks)
    )
    assembly_clashes = computed(
        "1", "pairs of parts that are through each other at rest", lambda it: len(it.contacts.through)
    )
    assembly_groups = computed(
        "1", "groups of parts that touch: 1 where each is held", lambda it: len(it.contacts.groups)
    )
    degrees_of_freedom = computed(
        "1", "of all bodies: shafts and rollers", lambda it: drive_balance(tree(it.machine)).number
    )
    driven_axes = computed("1", "axes that motors drive", lambda it: drive_balance(tree(it.machine)).axes)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Parts through each other, or in the air."""
        through, groups = self.contacts.through, self.contacts.groups
        source = "; ".join(" in ".join(one.parts) for one in through[:3]) or "meshes of all parts at rest"
        return (
            at_most("parts through each other", len(through), 0, "1", source).with_cure(
                "set fewer drives, or shorter links", *dict.fromkeys(part for one in through for part in one.parts)
            ),
            at_most("groups of parts that touch", len(groups), 1, "1", "meshes of all parts at rest").with_cure(
                "set a smaller needle_bar.joint", *dict.fromkeys(part for group in groups[1:] for part in group.parts)
            ),
        )

    @property
    def tables(self) -> tuple[Table, ...]:
        """None."""
        return ()


@lru_cache(maxsize=4)
def assembly(machine: TuftingMachine) -> TuftingAssembly:
    """The parts of a machine against each other."""
    return TuftingAssembly(machine, contacts(tree(machine)))
