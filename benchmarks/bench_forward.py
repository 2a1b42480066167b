"""Forward runs: processor time for each second simulated, and the accuracy reached."""

import time

from ilmek.dynamics.forward import ForwardRun, ForwardState, forward
from ilmek.dynamics.inertia import bar
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.reduced import ReducedMechanism, reduce
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.structure import plan

CRANK, COUPLER, ROCKER = 0.0597, 0.2007, 0.2308


def beat_up() -> ReducedMechanism:
    """The beat-up's crank-rocker."""
    bodies = {
        "crank": bar(0, CRANK, mass=0.129),
        "coupler": bar(0, COUPLER, mass=0.434),
        "rocker": bar(0, ROCKER, mass=0.649),
    }
    return reduce(plan(four_bar(0.3, CRANK, COUPLER, ROCKER, branch=+1)), bodies, (Gravity(-9.81j),))


def free(reduced: ReducedMechanism, rtol: float) -> ForwardRun:
    return forward(reduced, ForwardState(0.0, 20.0), 2.0, rtol=rtol)


def spun(reduced: ReducedMechanism, rtol: float) -> ForwardRun:
    return forward(reduced, ForwardState(0.0), 2.0, drive=lambda _time, _position, _speed: 0.5, rtol=rtol)


def run() -> None:
    reduced = beat_up()
    print(f"{'':52s}{'s CPU / s':>10s}{'steps':>8s}{'energy':>10s}{'q off':>10s}")
    for name, job in (("beat-up, free from 20 rad/s", free), ("beat-up, 0.5 N m from rest: 99.6 turns", spun)):
        for rtol in (1e-9, 1e-11):
            taken = []
            for _ in range(4):
                start = time.process_time()
                found = job(reduced, rtol)
                taken.append(time.process_time() - start)
            off = abs(float(found.position[-1] - job(reduced, 1e-13).position[-1]))
            row = f"{min(taken) / 2:10.4f}{len(found.time):8d}{found.energy_error:10.1e}{off:10.1e}"
            print(f"{f'{name}, rtol {rtol:.0e}':52s}{row}")
