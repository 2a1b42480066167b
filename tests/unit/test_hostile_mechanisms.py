"""Mechanisms of others: large groups, long ranges and many steps are refused before the work, or end soon."""

import random
import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from mechanisms import two_motors

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.json_file import json_text
from ilmek.io.mechanism.names import MOST_ENTRIES
from ilmek.io.mechanism_file import mechanism_toml, parse_mechanism
from ilmek.io.table_csv import MOST_NUMBERS, csv_text
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import MOST_BODIES, run
from ilmek.linkage import initial_pose
from ilmek.linkage.constraint_assignment import assigned_constraints
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.progress import Progress

PATIENCE = 20.0
"""Far above the time on any processor [s]: what this guards against takes minutes."""


def network(bodies: int, seed: int, extra: int = 0) -> Mechanism:
    """A crank and an odd number of links in a random network; without `extra` joints it has no degree of freedom."""
    pick = random.Random(seed)
    links = [f"b{number}" for number in range(1, bodies)]
    for _ in range(500):
        ends = [(GROUND, "b0"), ("b0", links[0]), *pairwise(pick.sample(links, len(links)))]
        count = 1 + 3 * len(links) // 2 + extra
        while len(ends) < count:
            room = [link for link in links if sum(link in pair for pair in ends) < 3 + extra]
            first = pick.choice(room)
            second = pick.choice([*(link for link in room if link != first), GROUND, GROUND])
            ends.append((first, second))
        made = _built(ends)
        if extra or not assigned_constraints(made).excess:
            return made
    raise AssertionError("no network found")


def _built(ends: list[tuple[str, str]]) -> Mechanism:
    points: dict[str, dict[str, complex]] = {body: {} for pair in ends for body in pair}
    joints = []
    for number, (first, second) in enumerate(ends):
        name, at = f"j{number}", complex(number % 7, number % 5 + number / 100)
        points[first][name] = points[second][name] = at
        joints.append(Pin(name, first, second))
    bodies = tuple(Body(name, held) for name, held in points.items())
    return Mechanism(bodies, tuple(joints), (Rotation("b0", "j0"),))


def test_groups_of_a_large_network_are_found_soon() -> None:
    mechanism = network(25, 3)
    begin = time.process_time()
    steps = plan(mechanism).steps
    assert sum(len(step.bodies) for step in steps) == 25
    assert time.process_time() - begin < PATIENCE


def test_an_over_constrained_network_is_found_soon() -> None:
    mechanism = network(25, 3, extra=2)
    begin = time.process_time()
    with pytest.raises(MechanismError, match="over-constrained"):
        plan(mechanism, closed_forms=False)
    assert time.process_time() - begin < PATIENCE


def test_a_large_group_is_refused_before_it_is_solved() -> None:
    file = parse_mechanism(mechanism_toml(OwnMachine(network(41, 1))))
    assert max(len(step.bodies) for step in file.plan().steps) > MOST_BODIES
    begin = time.process_time()
    with pytest.raises(MechanismError, match=f"at most {MOST_BODIES} bodies"):
        run(file, MotionRequest({}))
    assert time.process_time() - begin < PATIENCE


def test_a_file_has_at_most_so_many_bodies() -> None:
    bodies = "".join(f"[bodies.b{number}]\npoints = {{}}\n" for number in range(MOST_ENTRIES + 1))
    with pytest.raises(MechanismError, match=f"line 1, bodies: has {MOST_ENTRIES + 1} bodies; at most {MOST_ENTRIES}"):
        parse_mechanism(f"{bodies}[joints]\n[inputs]\n")


def four_bar_file() -> object:
    return parse_mechanism(mechanism_toml(OwnMachine(four_bar(0.3, 0.06, 0.2, 0.23, branch=1))))


def test_a_motion_has_at_most_so_many_numbers() -> None:
    with pytest.raises(
        MechanismError, match=f"--steps {MOST_NUMBERS} gives .* at most {MOST_NUMBERS}: --steps [0-9]+$"
    ):
        run(four_bar_file(), MotionRequest({}, steps=MOST_NUMBERS))


def test_a_motion_that_closes_now_and_then_is_refused() -> None:
    file = parse_mechanism(mechanism_toml(OwnMachine(four_bar(0.3, 0.2, 0.1, 0.11, branch=1))))
    with pytest.raises(MechanismError, match="closes in [0-9]+ ranges"):
        run(file, MotionRequest({}, over="0turn..5000turn", steps=20_000))


def test_inputs_far_from_the_pose_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(initial_pose, "MOST_STEPS", 1)
    motors = two_motors()
    at_start = solve(plan(motors), {"left": 1.2, "right": 1.9}).pose()
    drawn = plan(replace(motors, pose=at_start), closed_forms=False)
    with pytest.raises(MechanismError, match="steps from the mechanism's pose"):
        solve(drawn, {"left": np.array([1.2, 1.5]), "right": np.array([1.9, 2.2])})


def test_tables_report_their_progress() -> None:
    motion, seen = run(four_bar_file(), MotionRequest({}, steps=5000)), []
    progress = Progress(lambda _stage, share: seen.append(share))
    table = motion.motion.table()
    csv_text(table, progress)
    assert len(seen) >= 5
    assert seen == sorted(seen)
    seen.clear()
    json_text(table, progress)
    assert len(seen) >= 5
    assert seen[0] == 0 <= seen[-1] <= 1
    assert csv_text({"a": table["crank [rad]"]}).count("\n") == 5002
