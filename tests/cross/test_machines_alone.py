"""Each machine of the catalogue alone is one machine: all of it touches, nothing is through another, meshes are closed.

Evidence: the GLB files as they are written, with their screws, judged by fcl and manifold3d over a turn of each drive;
the machine's own measure of contacts says the same at rest.
"""

import pytest
from default_machines import default_design
from glb_judge import GlbJudge

from ilmek.jobs.machine_space import machine_file
from ilmek.machines.catalogue import MACHINES
from ilmek.part.contacts import contacts, open_parts
from ilmek.part.tree import Tree
from ilmek.report import Report

POSES = 3
NAMES = tuple(name for name, machine in MACHINES.items() if machine.tree is not None)


def tree_of(name: str) -> Tree:
    tree = MACHINES[name].tree
    assert tree is not None
    return tree(default_design(name))


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", NAMES)
def test_the_file_of_a_machine_is_one_machine_in_all_poses(name: str) -> None:
    tree = tree_of(name)
    content = machine_file("--glb", tree, Report(name, name, {}, (), ()))
    assert isinstance(content, bytes)
    judge, own = GlbJudge(content), contacts(tree)
    assert [sorted(group) for group in judge.groups()[1:]] == []
    through = [judge.overlaps()] + [
        judge.overlaps(motion, pose / POSES) for motion in judge.animations for pose in range(POSES)
    ]
    assert [pairs for pairs in through if pairs] == []
    assert judge.open_meshes() == set(open_parts(tree)) == set()
    assert (len(own.groups), own.through) == (1, ())
