"""A value that does not exist is a failed check: dead centres inside the range of the drive."""

import math
from dataclasses import replace

import pytest
from click.testing import CliRunner

from ilmek.cli import main
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.io.mechanism_file import MechanismFile, mechanism_toml
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide
from ilmek.report import Check

NAME = "dead centres in its range"
CRANK_IS_ROD = slider_crank(0.04, 0.04, branch=+1)


def slotted_lever(distance: float) -> Mechanism:
    """A lever on B with a slot for the block on the crank's pin; at `distance` of the crank's length it is met."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "B": -distance}),
            Body("crank", {"A0": 0, "A": 0.1}),
            Body("block", {"A": 0, "slot": 0}),
            Body("lever", {"B": 0, "slot": 0}),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "lever"),
            Pin("B", GROUND, "lever"),
        ),
        inputs=(Rotation("crank", "A0"),),
        branches={"slot": +1},
    )


def crossed_slides() -> Mechanism:
    """A pin in the slots of a crank and of the ground, parallel at 90 deg and 270 deg of the crank."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"A0": 0, "line": 0.1}),
            Body("crank", {"A0": 0, "slot": 0}),
            Body("one", {"slot": 0, "C": 0}),
            Body("two", {"line": 0, "C": 0}),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Slide("slot", "one", "crank"),
            Pin("C", "one", "two"),
            Slide("line", "two", GROUND, math.pi / 2),
        ),
        inputs=(Rotation("crank", "A0"),),
    )


def check(mechanism: Mechanism, over: str = "", steps: int = 360) -> Check:
    machine = OwnMachine(mechanism, {mechanism.moving[-1]: Inertia(1.0, 0j, 0.01)})
    found = analysis(run(MechanismFile(machine), MotionRequest({}, over, steps=steps)))
    return next(one for one in found.checks if one.name == NAME)


@pytest.mark.parametrize("steps", [360, 7])
@pytest.mark.parametrize(
    ("mechanism", "values"),
    [
        (CRANK_IS_ROD, ("90 deg", "270 deg")),
        (four_bar(0.3, 0.1, 0.3, 0.1, branch=+1), ("180 deg",)),
        (slotted_lever(0.1), ("180 deg",)),
    ],
)
def test_where_two_assemblies_meet_velocities_do_not_exist_whatever_the_steps(
    mechanism: Mechanism, values: tuple[str, ...], steps: int
) -> None:
    failed = check(mechanism, steps=steps)
    assert not failed.ok
    assert all(value in failed.source for value in values)
    assert failed.value >= len(values)
    assert failed.cure


def test_parallel_lines_are_a_dead_centre() -> None:
    assert not check(crossed_slides(), "0deg..180deg").ok
    assert check(crossed_slides(), "-80deg..80deg").ok


@pytest.mark.parametrize(
    "mechanism",
    [
        slider_crank(0.04, 0.0401, branch=+1),
        four_bar(0.3, 0.1, 0.28, 0.15, branch=+1),
        slotted_lever(0.11),
        slotted_lever(0.09),
    ],
)
def test_near_a_dead_centre_they_exist(mechanism: Mechanism) -> None:
    assert check(mechanism).ok
    assert check(mechanism).value == 0


def test_beside_it_the_range_is_kept() -> None:
    assert check(CRANK_IS_ROD, "0deg..89deg").ok
    assert check(CRANK_IS_ROD, "91deg..269deg").ok
    assert check(CRANK_IS_ROD, "0deg..90deg").value == 1


def test_the_end_of_the_range_of_closing_counts_only_where_it_is_required() -> None:
    """|A B0| = b + c where b + c is the root of g^2 + a^2 + g a: a limit at 120 deg, a sample of the default range."""
    limit = four_bar(0.3, 0.2, math.sqrt(0.19) - 0.17, 0.17, branch=+1)
    assert check(limit).ok
    assert not check(limit, "0deg..120deg").ok


def test_the_command_ends_with_3_and_no_warning(tmp_path) -> None:
    file = tmp_path / "machine.toml"
    machine = OwnMachine(replace(CRANK_IS_ROD, name="al"), {"slider": Inertia(1.0, 0j, 0.0)})
    file.write_text(mechanism_toml(machine))
    shown = CliRunner().invoke(main, ["mechanism", str(file)])
    assert shown.exit_code == 3
    assert "Warning" not in shown.output
    assert "FAIL" in shown.output
