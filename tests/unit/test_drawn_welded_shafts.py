"""Sheets of welded shafts: what is finished after the weld, and about which axis."""

import re

import pytest

from ilmek.machines.catalogue import MACHINES
from ilmek.machines.warp_tension.tree import stand, tree
from ilmek.part.assemblies import assembly_of, items_of, pieces_of_assembly
from ilmek.part.bolting import bolted
from ilmek.part.tree import Tree
from ilmek.viz.drawings.weldment import positions, welded_pieces


@pytest.fixture(scope="module")
def machine() -> Tree:
    own = MACHINES["warp-tension"]
    design = own.designed(own.params.read({}))
    return bolted(Tree((*tree(design).bodies, *stand(design).bodies)))


def test_both_journals_of_a_welded_shaft_run_true_about_their_own_axis(machine: Tree) -> None:
    assembly = assembly_of(machine, "cylinders")
    pieces = pieces_of_assembly(machine, assembly)
    _, tables = positions(machine, items_of(machine, assembly), welded_pieces(machine, assembly, pieces))
    words = [str(text.words) for table in tables for text in table.texts]
    axes = [re.search(r"([A-Z]): total run-out 0\.025 to ([A-Z])-([A-Z])", own) for own in words]
    found = [own.groups() for own in axes if own is not None]
    assert len(found) == 6  # two ends of three cylinders
    for letter, first, last in found:
        assert letter in {first, last}
    assert len({(first, last) for _, first, last in found}) == 3
