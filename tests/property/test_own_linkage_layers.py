"""Random four-bars and six-bars as made: nothing runs through anything over the motion, and the masses are the parts'.

What meets is judged by solids of manifold3d at poses of the drive, without what the search of the layers knows.
"""

import numpy as np
import pytest
from effort import examples
from hypothesis import assume, given
from hypothesis import strategies as st
from own_linkages import meeting_parts, toml_text

from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import parse_mechanism
from ilmek.jobs.mechanism.making import MadeMechanism, made_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.machines.own_linkage.report import made_inertias

FOUR_BAR = [("O", "ground", "crank"), ("A", "crank", "rod"), ("B", "rod", "rocker"), ("C", "ground", "rocker")]
POSES = 15
LOADED = 'gravity = "9.81m/s^2"\nmotions = { O = "60rpm" }\n'

lengths = st.integers(40, 200)
made_lengths = st.tuples(st.integers(25, 150), lengths, lengths, lengths)


def made(text: str) -> MadeMechanism | None:
    """The mechanism as made; None where it does not close, or a link is too short for its pins."""
    try:
        return made_mechanism(run(parse_mechanism(text), MotionRequest({})))
    except MechanismError as error:
        if "too short" not in str(error) and "close" not in str(error):
            raise
        return None


def judged(mechanism: MadeMechanism) -> None:
    """What holds of every mechanism that is made."""
    met = meeting_parts(mechanism.tree, POSES)
    assert not met or not mechanism.built.layering.found
    parts, machine = made_inertias(mechanism.built), mechanism.analysis.run.machine
    for body in machine.open_masses & set(machine.inertias):
        assert machine.inertias[body].mass == pytest.approx(parts[body].mass, rel=1e-9)
        assert machine.inertias[body].moment == pytest.approx(parts[body].moment, rel=1e-9)


@given(sizes=made_lengths, branch=st.sampled_from([-1, 1]), loaded=st.booleans())
@examples(15, 3)
def test_a_random_four_bar_has_layers_in_which_nothing_meets(
    sizes: tuple[int, int, int, int], branch: int, loaded: bool
) -> None:
    crank, rod, rocker, base = sizes
    links = {"crank": crank, "rod": rod, "rocker": rocker}
    text = toml_text({"O": (0, 0), "C": (base, 0)}, links, FOUR_BAR) + f"[branches]\nB = {branch}\n"
    mechanism = made((LOADED if loaded else "") + text)
    assume(mechanism is not None)
    assert mechanism is not None
    judged(mechanism)


@given(
    crank=st.integers(20, 30), rod=st.integers(80, 110), arm=st.integers(50, 90), second=lengths, output=lengths,
    away=st.integers(150, 260), below=st.integers(-60, 60),
)  # fmt: skip
@examples(12, 2)
def test_a_random_six_bar_has_layers_in_which_nothing_meets(  # noqa: PLR0917
    crank: int, rod: int, arm: int, second: int, output: int, away: int, below: int
) -> None:
    """A crank-rocker whose rocker drives a second dyad by a point of its own (Watt)."""
    links = {"crank": crank, "rod": rod, "rocker": 80, "second": second, "output": output}
    pins = [*FOUR_BAR, ("D", "rocker", "second"), ("E", "second", "output"), ("F", "ground", "output")]
    text = toml_text({"O": (0, 0), "C": (90, 0), "F": (away, below)}, links, pins)
    point = f'points.D = {{ radius = "{arm}mm", angle = "-60deg" }}'
    rocker = f'rocker = {{ length = "80mm", between = ["C", "B"], {point} }}'
    mechanism = made(text.replace('rocker.length = "80mm"', rocker) + "[branches]\nB = 1\nE = 1\n")
    assume(mechanism is not None)
    assert mechanism is not None
    judged(mechanism)


def test_crank_rockers_have_at_most_three_layers() -> None:
    """Crank and rocker lie below the rod, in one layer or in two."""
    for seed in range(6):
        base, rod, rocker = sorted(np.random.default_rng(seed).uniform(120, 200, 3).round().tolist())
        crank = min(base + rod - rocker, base) * 0.4  # the shortest, and Grashof's sum is met
        text = toml_text({"O": (0, 0), "C": (base, 0)}, {"crank": crank, "rod": rod, "rocker": rocker}, FOUR_BAR)
        mechanism = made(text + "[branches]\nB = 1\n")
        assert mechanism is not None
        assert mechanism.built.layering.found
        assert mechanism.built.layering.number <= 3
