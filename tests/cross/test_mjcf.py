"""Machines written for MuJoCo, and judged by it: joints, loops, inertia, contacts, torques.

Evidence: MuJoCo reads the file without a warning, closes the loops by its own Jacobian, finds the contacts of its own
convex hulls, and computes the torques by its own inverse dynamics.
"""

from functools import cache

import numpy as np
import pytest

from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.automated_loom import design as loom_design
from ilmek.machines.automated_loom.in_space.scene import loom_tree, periods_of
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.catalogue import find_machine
from ilmek.machines.tufting.design import Tufting
from ilmek.part.drive_balance import drive_balance
from ilmek.part.poses import chains, poses
from ilmek.part.tree import Tree
from ilmek.units import mm, turn

pytest.importorskip("mujoco", reason="mujoco is not installed")

import mujoco
from mujoco_judge import Judge
from planted_faults import pushed, without

from ilmek.io.mjcf import mjcf_text

_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""The tree's y is up, in MuJoCo z is."""

_MACHINES = {
    # machine and settings: degrees of freedom by counting its drives
    ("function-four-bar",): 1,
    ("knotting-four-bar",): 1,
    ("tufting", "bars=2"): 1,
    ("beat-up",): 2,  # crank, and the slide along the row
    ("hammer", "drive=linkage"): 1,  # two crank-rockers on one shaft, and the comb on both
    ("knotting-dyad",): 8,  # two servos an arm, the centre gripper's motor, and the solenoid of each of three jaws
    ("cam",): 2,  # the follower has a servo of its own
    ("tension-compensator",): 2,
}


@cache
def _machine(name: str, *settings: str) -> tuple[object, Tree]:
    machine = find_machine(name)
    design = machine.design(machine.params.read(dict(setting.split("=") for setting in settings)))
    assert machine.tree is not None
    return design, machine.tree(design)


@cache
def _loom() -> tuple[Tree, Judge]:
    loom = loom_design(AutomatedLoomParams(aim="price"))
    tree = loom_tree(loom)
    return tree, Judge(mjcf_text(tree, "loom", periods_of(loom)))


@pytest.mark.parametrize("case", _MACHINES, ids=" ".join)
def test_a_machine_has_the_degrees_of_freedom_and_servos_of_its_drives(
    case: tuple[str, ...], capfd: pytest.CaptureFixture[str]
) -> None:
    _, tree = _machine(*case)
    judge = Judge(mjcf_text(tree, case[0], {}))
    assert judge.degrees_of_freedom(transmissions=True) == _MACHINES[case]
    assert judge.degrees_of_freedom() == judge.model.nu
    assert capfd.readouterr() == ("", "")
    assert judge.model.body_mass.sum() == pytest.approx(tree.mass, rel=1e-3, abs=1e-5)


_THROUGH = {
    # what runs through each other today, by MuJoCo and by the volumes of meshes
    "knotting-four-bar": {("crank", "rocker")},  # in one plane: 184 mm³
    "knotting-dyad": {
        *(("centre-gripper", "link-2"), ("centre-gripper", "link-2-*"), ("link-2", "link-2-*")),  # 4 mm³
        *(("elbow-shaft", "link-1"), ("elbow-shaft-*", "link-1-*")),  # a shaft in its sleeve, whose hull is full
    },
}
_MOVING = ("function-four-bar", "knotting-four-bar", "tufting", "knotting-dyad", "cam")


@pytest.mark.parametrize("case", [case for case in _MACHINES if case[0] in _MOVING], ids=" ".join)
def test_bodies_follow_the_poses_of_the_project_and_contact_nothing(case: tuple[str, ...]) -> None:
    _, tree = _machine(*case)
    judge = Judge(mjcf_text(tree, case[0], {}))
    ((_, table), *_) = judge.tables.values()
    for angle in table[:: len(table) // 7, 0]:
        touched = {tuple(body.rpartition("/")[2] for body in pair) for pair in judge.contacts("turn", float(angle))}
        assert touched <= _THROUGH.get(case[0], set())
        assert _farthest(tree, judge, "turn", float(angle)) <= 0.1 * mm


def _farthest(tree: Tree, judge: Judge, drive: str, angle: float) -> float:
    """How far a point within 0.3 m of its body's origin is at most from where the project has it [m]."""
    judge.place()
    counts, numbers, farthest = tree.counts(), dict[str, int](), 0.0
    for chain in chains(tree):
        body = chain[-1].name
        numbers[body] = numbers.get(body, 0) + 1
        name = body if counts[body] == 1 else f"{body} {numbers[body]}"
        own, other = poses(chain, drive, np.array([angle])), judge.data.body(name)
        away = float(np.linalg.norm(other.xpos - _UP @ own.origin[0]))
        turned = float(np.abs(other.xmat.reshape(3, 3) - _UP @ own.rotation[0]).max())
        farthest = max(farthest, away + 0.3 * turned)
    return farthest


def test_the_loom_follows_its_cyclograms_and_touches_nothing_but_its_joints() -> None:
    """Both side grippers meet in the knot: found here, 6 mm³; the comparison of meshes counts from 50 mm³ on.

    The ends of the jaws' wires lie in the springs that draw them, which are filled here, as hulls.
    """
    tree, judge = _loom()
    assert judge.degrees_of_freedom() == judge.model.nu
    assert (
        judge.degrees_of_freedom(transmissions=True) == drive_balance(tree).axes + 1
    )  # the sprung bar beside the motors
    mujoco.mj_resetDataKeyframe(judge.model, judge.data, 0)
    assert _farthest(tree, judge, "row", 0.0) <= 0.1 * mm
    touched: set[tuple[str, str]] = set()
    for drive in judge.drives:
        (angles, *_) = sorted((table[:, 0] for own, table in judge.tables.values() if own == drive), key=len)
        for angle in angles[:: max(len(angles) // 8, 1)].tolist():
            touched |= set(judge.contacts(drive, angle))
            assert _farthest(tree, judge, drive, angle) <= 0.1 * mm
    wires = {(f"weaver/{side} side gripper's collar", "weaver/warp opener") for side in ("left", "right")}
    assert touched <= {("weaver/left side gripper", "weaver/right side gripper"), *wires}
    assert judge.model.body_mass.sum() == pytest.approx(tree.mass, rel=1e-6)


def test_a_spring_less_leaves_a_degree_of_freedom_more() -> None:
    tree, judge = _loom()
    removed = without(tree, "weaver/sley-spring")
    left = Judge(mjcf_text(removed, "loom", {}))
    assert left.degrees_of_freedom(transmissions=True) == judge.degrees_of_freedom(transmissions=True) + 1


def test_a_rail_that_is_moved_into_the_carriage_on_it_contacts_it() -> None:
    tree, _ = _loom()
    weft = Tree(tuple(body for body in tree.bodies if body.id in {"weft/guide", "weft/carriage of the shuttle"}))
    moved = pushed(weft, "weft/rail", np.array([0.0, 1.0 * mm, 0.0]))
    assert not Judge(mjcf_text(weft, "weft", {})).contacts("row", 1.0)
    depths = Judge(mjcf_text(moved, "weft", {})).contacts("row", 1.0)
    assert depths.keys() == {("weft/carriage of the shuttle", "weft/guide")}
    assert 0.2 * mm < max(depths.values()) < 1.0 * mm  # each is 0.25 mm smaller than it is


def test_the_torque_of_the_crank_of_a_beat_up_is_that_of_the_design() -> None:
    design, tree = _machine("beat-up")
    assert isinstance(design, BeatUp)
    judge = Judge(mjcf_text(tree, "beat-up", {}))
    judge.model.opt.gravity[:] = 0.0  # the paper leaves the weight out, and so do the parameters
    angles = design.beta + np.linspace(0.0, turn, 13)
    state, efforts = design.state_at(angles), []
    for angle in angles.tolist():
        judge.turn("beat-up/crank", angle - design.beta, design.params.speed)
        efforts.append(judge.effort("beat-up/crank"))
    assert np.abs(state.torque).max() > 1.0
    assert np.abs(np.array(efforts) - state.torque).max() <= 0.05 * np.abs(state.torque).max()


def test_the_torque_of_the_main_shaft_of_a_tufting_machine_is_that_of_the_design() -> None:
    """With weight and inertia of links and needle; the friction of the backing left out."""
    design, tree = _machine("tufting", "link_mass=made", "friction_force=0N")
    assert isinstance(design, Tufting)
    judge = Judge(mjcf_text(tree, "tufting", {}))
    angles, torque = np.asarray(design.state.angle), np.asarray(design.state.main_torque)
    chosen = np.linspace(0, len(angles) - 1, 13).astype(int)
    efforts = []
    for angle in angles[chosen].tolist():
        judge.turn("tufting/main-shaft", angle, design.params.speed)
        efforts.append(judge.effort("tufting/main-shaft"))
    assert np.abs(torque).max() > 0.1
    assert np.abs(np.array(efforts) - torque[chosen]).max() <= 0.05 * np.abs(torque).max()
