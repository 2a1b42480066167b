"""IFToMM's multibody benchmarks A01 (pendulum) and A02 (N four-bars in a row, through their singular poses).

Uniform links of 1 m and 1 kg, fall 9.81 m/s². The uprights of A02 stay parallel, so that it is the pendulum
((N+1)/3 + N) th'' = -g ((N+1)/2 + N) cos th; with all links in one line the joints lose N of their ranks.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ilmek.dynamics.inertia import bar
from ilmek.dynamics.multibody.system import BodyState, System, simulate
from ilmek.linkage.model import GROUND, Body, Pin

FALL = 9.81


def pendulum() -> System:
    """A point of 1 kg on a light rod of 1 m, from (-1, 0) at rest; a moment I instead of none delays it by I / 2."""
    moment = 1e-13
    bob = bar(0, 1, mass=1.0)
    return System(
        (Body(GROUND, {"O": 0}), Body("bob", {"O": -1, "tip": 0})),
        (Pin("O", GROUND, "bob"),),
        {"bob": type(bob)(1.0, 0j, moment)},
        {"bob": BodyState(-1 + 0j, np.pi)},
        gravity=-FALL * 1j,
    )


def row_of_four_bars(count: int) -> System:
    """N + 1 uprights on the ground, 1 m apart, and N couplers; B0 starts at 1 m/s along x."""
    uprights = [f"U{k}" for k in range(count + 1)]
    couplers = [f"C{k}" for k in range(count)]
    ground = Body(GROUND, {f"A{k}": complex(k) for k in range(count + 1)})
    bodies = [ground]
    bodies += [Body(name, {f"A{k}": 0, f"L{k}": 1, f"R{k}": 1}) for k, name in enumerate(uprights)]
    bodies += [Body(name, {f"R{k}": 0, f"L{k + 1}": 1}) for k, name in enumerate(couplers)]
    pins = [Pin(f"A{k}", GROUND, name) for k, name in enumerate(uprights)]
    pins += [Pin(f"R{k}", uprights[k], couplers[k]) for k in range(count)]
    pins += [Pin(f"L{k + 1}", couplers[k], uprights[k + 1]) for k in range(count)]
    poses = {name: BodyState(complex(k), np.pi / 2, 0j, -1.0) for k, name in enumerate(uprights)}
    poses |= {name: BodyState(k + 1j, 0.0, 1 + 0j) for k, name in enumerate(couplers)}
    masses = dict.fromkeys((*uprights, *couplers), bar(0, 1, mass=1.0))
    return System(tuple(bodies), tuple(pins), masses, poses, gravity=-FALL * 1j, name=f"{count} four-bars")


def one_angle(count: int, times: np.ndarray) -> np.ndarray:
    """The uprights' angle by the pendulum's equation."""
    factor = -FALL * ((count + 1) / 2 + count) / ((count + 1) / 3 + count)
    found = solve_ivp(
        lambda _t, y: (y[1], factor * np.cos(y[0])),
        (0, times[-1]),
        (np.pi / 2, -1.0),
        t_eval=times,
        method="DOP853",
        rtol=1e-13,
        atol=1e-13,
    )
    angles: np.ndarray = found.y[0]
    return angles


def test_pendulum_at_the_times_of_a01() -> None:
    run = simulate(pendulum(), np.array([0.0, 1.0, 5.0, 10.0]), rtol=1e-12)
    place = run.position("bob", "tip")
    assert abs(place[1] - (0.9862917511 - 0.1650108531j)) < 1e-9
    assert abs(place[2] - (-0.9423054350 - 0.3347543384j)) < 1e-9
    assert abs(place[3] - (-0.2750874626 - 0.9614192051j)) < 1e-9
    assert np.max(np.abs(run.energy_residual)) < 1e-8
    assert run.gap < 1e-15


def test_two_four_bars_at_the_times_of_a02() -> None:
    run = simulate(row_of_four_bars(2), np.array([0.0, 1.0, 4.0, 10.0]), rtol=1e-10)
    place = run.position("U0", "R0")
    assert abs(place[1] - (-0.1950203019 - 0.9807992057j)) < 1e-6
    assert abs(place[2] - (0.1176161024 + 0.9930591385j)) < 1e-6
    assert abs(place[3] - (0.3284581115 + 0.9445185382j)) < 1e-6
    assert abs(run.velocity("U0", "R0")[3] - (1.4230514702 - 0.4948688455j)) < 1e-6
    assert np.max(np.abs(run.energy_residual)) < 1e-6


@pytest.mark.parametrize("count", [1, 2, 40])
def test_four_bars_in_a_row_keep_their_uprights_parallel_through_singular_poses(count: int) -> None:
    times = np.linspace(0.0, 2.0, 41)
    run = simulate(row_of_four_bars(count), times, rtol=1e-9)
    angles = one_angle(count, times)
    assert np.sum(np.diff(np.sign(np.sin(angles))) != 0) >= 2, "the run goes through singular poses"
    for upright in ("U0", f"U{count}"):
        assert np.max(np.abs(np.exp(1j * run.angle(upright)) - np.exp(1j * angles))) < 1e-6
    assert run.gap < 1e-12
    assert np.max(np.abs(run.energy_residual)) < 1e-7 * (1 + 2 * count) * FALL
