"""Whether the parts of a loom make one machine: what is through each other, what is too near, what stands apart."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.nearest_parts import machines_of_bodies, nearest_parts
from ilmek.machines.automated_loom.report import LoomVerdict
from ilmek.part.clearances import Approach
from ilmek.part.colliders import DEVIATION
from ilmek.part.contacts import Contacts, TouchingParts, contacts
from ilmek.records import computed, record
from ilmek.report import Check, Json, Report, Table, at_least, at_most, columns, results_of
from ilmek.units import deg, format_quantity

NEAREST = 10
"""Pairs of parts that are reported."""


@record
class LoomAssembly:
    """The parts of a loom against each other.

    nearest   least distances of parts that move against each other, the nearest first
    contacts  what touches, and what is through each other at all angles
    """

    loom: LoomDesign
    nearest: tuple[Approach, ...]
    contacts: Contacts

    clashes = computed(
        "1",
        "pairs of parts that are through each other at an angle of a row or a knot",
        lambda it: len(it.through),
        name="assembly_clashes",
    )
    number_of_groups = computed(
        "1",
        "groups of parts that touch: 1 where nothing hangs in the air",
        lambda it: len(it.groups),
        name="assembly_groups",
    )

    @computed("", "the nearest pairs of parts that move against each other", shown=False)
    def nearest_pairs(self) -> list[Json]:
        return [_as_json(pair) for pair in self.nearest[:NEAREST]]

    @property
    def groups(self) -> tuple[TouchingParts, ...]:
        """Groups of parts that touch, the largest first."""
        return self.contacts.groups

    @property
    def through(self) -> tuple[Approach, ...]:
        """Pairs of parts that are through each other: of each two parts the worst."""
        worst: dict[frozenset[str], Approach] = {}
        every = (*(pair for pair in self.nearest if pair.distance < 0), *self.contacts.through)
        for pair in sorted(every, key=lambda pair: pair.distance):
            worst.setdefault(frozenset(pair.parts), pair)
        return tuple(worst.values())


@lru_cache(maxsize=4)
def assembly(loom: LoomDesign) -> LoomAssembly:
    """The parts of a loom against each other; takes seconds."""
    return LoomAssembly(loom, nearest_parts(loom), contacts(loom_tree(loom)))


def assembly_checks(found: LoomAssembly) -> tuple[Check, ...]:
    """Parts through each other, parts of two machines that come too near, and parts that nothing holds."""
    titles = _titles(found.loom)
    through = tuple(dict.fromkeys(part for pair in found.through for part in pair.parts))
    loose = tuple(dict.fromkeys(part for group in found.groups[1:] for part in group.parts))
    return (
        at_most(
            "parts through each other",
            len(found.through),
            0,
            "1",
            _worst(found.through, titles) or "meshes of all parts over both cyclograms",
            cure="change the arrangement so that the parts named have room",
            parts=through,
        ),
        at_most(
            "groups of parts that touch",
            len(found.groups),
            1,
            "1",
            "meshes of all parts at the start of a row, within 0.1 mm; more than one: parts that nothing holds",
            cure="give the parts named supports",
            parts=loose,
        ),
        *_too_near(found, titles),
    )


def _too_near(found: LoomAssembly, titles: Mapping[str, str]) -> tuple[Check, ...]:
    """The least clearance of the parts of each two machines that move against each other, and do not touch."""
    machines, limit = machines_of_bodies(found.loom), found.loom.params.clearance
    least: dict[frozenset[str], Approach] = {}
    for pair in found.nearest:
        both = frozenset(machines[body] for body in pair.bodies)
        if len(both) == 2 and pair.distance > 0:
            least.setdefault(both, pair)
    return tuple(
        at_least(
            f"clearance in space: {titles[pair.parts[0]]} and {titles[pair.parts[1]]}",
            pair.distance,
            limit - DEVIATION,
            "mm",
            f"parameter clearance, assumed by this project, less the meshes' deviation; {_where(pair)}",
            cure="set a larger clearance",
            parts=pair.parts,
        )
        for pair in least.values()
    )


def with_assembly(loom: LoomDesign, report: Report) -> Report:
    """The report of a loom with its parts against each other: results, checks, the nearest pairs, and the verdict."""
    found = assembly(loom)
    verdict = {result.name for result in results_of(LoomVerdict(report))}
    whole = replace(
        report,
        checks=(*report.checks, *assembly_checks(found)),
        results=(*(result for result in report.results if result.name not in verdict), *results_of(found)),
        tables=(*report.tables, _nearest_table(found)),
    )
    return replace(whole, results=(*results_of(LoomVerdict(whole)), *whole.results))


def _nearest_table(found: LoomAssembly) -> Table:
    """The nearest pairs of parts; below 0 they are through each other, by the mean depth of what they share."""
    titles, apart = _titles(found.loom), (pair for pair in found.nearest if pair.distance >= 0)
    rows = tuple(
        (titles[pair.parts[0]], titles[pair.parts[1]], pair.distance, pair.drive, pair.angle)
        for pair in (*found.through, *apart)[: 3 * NEAREST]
    )
    heads = columns("part", "and", "least [mm]", "cyclogram", "at [deg]")
    return Table("loom-nearest-parts", "Nearest parts", heads, rows)


def _titles(loom: LoomDesign) -> dict[str, str]:
    return {part.id: part.title for part, _ in loom_tree(loom).occurrences()}


def _worst(through: tuple[Approach, ...], titles: Mapping[str, str]) -> str:
    """The deepest three in words."""
    deepest = (
        (titles[pair.parts[0]], titles[pair.parts[1]], format_quantity(-pair.distance, "mm", 2), _where(pair))
        for pair in through[:3]
    )
    return "; ".join(f"{first} in {other} by {depth}, {where}" for first, other, depth, where in deepest)


def _where(pair: Approach) -> str:
    return f"at {pair.angle / deg:.1f} deg of a {pair.drive}" if pair.drive else "at all angles"


def _as_json(pair: Approach) -> Json:
    return {
        "parts": list(pair.parts),
        "distance": pair.distance,
        "volume": pair.volume,
        "cyclogram": pair.drive,
        "angle": pair.angle,
    }
