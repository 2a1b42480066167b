"""The equipment of a loom as bodies, its parts list, and its checks."""

from dataclasses import replace
from functools import lru_cache

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.circuit import GROWING, circuit, circuit_checks, circuit_of
from ilmek.machines.automated_loom.equipment.creel import BRAKE_ID, CONDUIT, PACKAGE, PEG
from ilmek.machines.automated_loom.equipment.creel_parts import creel_trees
from ilmek.machines.automated_loom.equipment.energy_chain import chain_checks, chain_trees
from ilmek.machines.automated_loom.equipment.guard_parts import guards
from ilmek.machines.automated_loom.equipment.guards import guard_checks
from ilmek.machines.automated_loom.equipment.lifting_eyes import lifting_eyes
from ilmek.machines.automated_loom.equipment.sensors import sensor_checks, sensors
from ilmek.machines.automated_loom.equipment.signals import HEAD_ANGLE, YARN_INPUTS, YARN_STOP
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.station import station_checks, station_tree
from ilmek.machines.automated_loom.equipment.yarn_path import yarn_checks
from ilmek.machines.automated_loom.in_space.machines import joined, machine_branches
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.parts import PartsList, parts_of_loom
from ilmek.part.bill import bill
from ilmek.part.tree import Tree
from ilmek.report import BillLine, Check

_NAME = "automated-loom"

OF_A_HEAD = frozenset((HEAD_ANGLE, PEG, PACKAGE, BRAKE_ID, YARN_STOP, YARN_INPUTS, CONDUIT))
"""Parts of the equipment of which each head has as many as all others."""


@lru_cache(maxsize=2)
def equipment(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The trees of the equipment, on bodies of the machines or on the floor."""
    return (*_watched(loom), MachineTree(_NAME, circuit(site_of(loom), without_circuit(loom))))


@lru_cache(maxsize=4)
def _watched(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The equipment without its circuit."""
    return (
        *sensors(loom),
        MachineTree(_NAME, lifting_eyes(loom)),
        MachineTree(_NAME, guards(site_of(loom))),
        *(_of_heads(loom) or (MachineTree(_NAME, station_tree(site_of(loom))),)),
    )


@lru_cache(maxsize=4)
def without_circuit(loom: LoomDesign) -> Tree:
    """All bodies of a loom but those of its circuit."""
    return joined((*machine_branches(loom), *_watched(loom)))


@lru_cache(maxsize=4)
def _of_heads(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """Creel and chains of the heads; none where weavers tie."""
    return (*creel_trees(loom), *chain_trees(loom)) if loom.heads else ()


def more_for_heads(loom: LoomDesign) -> frozenset[str]:
    """Parts of creel and chains, fuses, supplies, terminals: of more heads there are more, or larger ones."""
    devices = circuit_of(site_of(loom), without_circuit(loom)).devices if loom.heads else ()
    growing = (own.part.id for own in devices if own.part.process in GROWING)
    return frozenset((*growing, *(part.id for tree in _of_heads(loom) for part, _ in tree.tree.occurrences())))


def equipment_trees(loom: LoomDesign) -> tuple[Tree, ...]:
    """The trees alone."""
    return tuple(branch.tree for branch in equipment(loom))


def whole_list(loom: LoomDesign) -> PartsList:
    """The parts list of a loom with its equipment. Raises ParameterError for unreadable prices."""
    listed = parts_of_loom(loom)
    return replace(listed, parts=(*listed.parts, *_lines(loom)))


@lru_cache(maxsize=4)
def _lines(loom: LoomDesign) -> tuple[BillLine, ...]:
    """Lines of the equipment: of what is on a head as many as there are heads."""
    branches = equipment(loom)
    own = {part.id for tree in equipment_trees(loom) for part, _ in tree.occurrences()}
    return bill(joined((*machine_branches(loom), *branches)), own)


def equipment_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The checks of guards, sensors, circuit, and of chains and yarn path of heads or of the weavers' station."""
    site = site_of(loom)
    served = (*chain_checks(loom), *yarn_checks(loom)) if loom.heads else station_checks(site)
    return (*guard_checks(site), *sensor_checks(loom), *circuit_checks(site, without_circuit(loom)), *served)
