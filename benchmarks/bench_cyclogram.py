"""The solver of cyclograms beside a plain way: SciPy's SLSQP on starts and ends, from where the motions are drawn.

Both lower the largest acceleration at a given period within the same relations, order and exclusions. The plain way
makes the largest of |h| Ca (w/beta)^2 least, with a bound on it as an unknown more, its derivatives by differences.
"""

import math
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS
from ilmek.io.cyclogram_file import read_cyclogram
from ilmek.timing.constraints import exclusion_rows, standing_rows, unknowns
from ilmek.timing.cyclogram import Cyclogram, Moment, Relation, Track, TrackSegment
from ilmek.timing.solver import least_acceleration
from ilmek.timing.track import peak_acceleration
from ilmek.units import deg, turn

RUNS = 5
PRESS = Path(__file__).parents[1] / "examples" / "press.toml"


def chain(tracks: int, seed: int) -> Cyclogram:
    """Tracks that go out and home one after the other, a few degrees between."""
    rng = np.random.default_rng(seed)
    width, made = turn / tracks, []
    for number, stroke in enumerate(rng.uniform(0.02, 0.2, tracks)):
        cuts = width * (number + np.array([0.1, 0.45, 0.5, 0.9]))
        parts = (
            TrackSegment("out", cuts[0], cuts[1], 0.0, stroke, LAWS["modified-sine"]),
            TrackSegment("home", cuts[2], cuts[3], stroke, 0.0, LAWS["cycloidal"]),
        )
        made.append(Track(f"t{number}", "cam", parts))
    gaps = rng.uniform(0.2, 1.0, tracks) * deg
    order = (
        Relation(Moment(f"t{number + 1}", "out"), Moment(f"t{number}", "home", "end"), float(gaps[number]), "order")
        for number in range(tracks - 1)
    )
    return Cyclogram(f"{tracks} tracks", 1.0, tuple(made), tuple(order))


def weights(cyclogram: Cyclogram) -> dict[str, float]:
    """The limits by which the solver weighs, where there are some."""
    limits = {track.name: track.limits.acceleration for track in cyclogram.tracks}
    if not any(map(math.isfinite, limits.values())):
        return dict.fromkeys(limits, 1.0)
    now = {track.name: peak_acceleration(track, cyclogram.period) for track in cyclogram.tracks}
    return {name: limit if math.isfinite(limit) else now[name] for name, limit in limits.items()}


def plain(cyclogram: Cyclogram) -> float:
    """The largest weighted acceleration by a general optimiser."""
    known, by = unknowns(cyclogram), weights(cyclogram)
    rows = standing_rows(known, period_free=False)
    orders = [order for exclusion in cyclogram.exclusions for order in exclusion_rows(known, exclusion)]
    rows += [row for order in orders for row in order[0]]
    parts = [(track, part) for track in cyclogram.tracks for part in track.segments]
    betas = np.array([known.beta(track, part).weights for track, part in parts])
    sizes = np.array([abs(part.stroke) * part.law.acceleration_peak / by[track.name] for track, part in parts])
    sizes *= cyclogram.speed**2
    least = [track.limits.time * cyclogram.speed for track, _ in parts]
    left, constant = np.array([row.form.weights for row in rows]), np.array([row.form.constant for row in rows])
    start = known.current
    start[0] = float(np.max(sizes / (betas @ start) ** 2))

    def room(x: FloatArray) -> FloatArray:
        beta = betas @ x
        return np.concatenate([left @ x + constant, x[0] - sizes / np.maximum(beta, 1e-3) ** 2, beta - least])

    found = minimize(
        lambda x: x[0], start, constraints={"type": "ineq", "fun": room}, method="SLSQP", options={"maxiter": 500}
    )
    return float(found.x[0])


def timed(solve: Callable[[], float]) -> tuple[float, float]:
    """The answer and the median time [s]."""
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        answer = solve()
        times.append(time.perf_counter() - start)
    return answer, statistics.median(times)


def run() -> None:
    print(f"{'':10} {'solver':>9} {'plain':>9} {'times quicker':>14} {'plain over solver':>18}")
    for cyclogram in (read_cyclogram(PRESS), chain(6, 1), chain(20, 2)):
        best, quick = timed(lambda cyclogram=cyclogram: least_acceleration(cyclogram).after)  # type: ignore[misc]
        other, slow = timed(lambda cyclogram=cyclogram: plain(cyclogram))  # type: ignore[misc]
        print(
            f"{cyclogram.name:10} {1e3 * quick:6.1f} ms {1e3 * slow:6.1f} ms {slow / quick:14.2f} {other / best:18.6f}"
        )


if __name__ == "__main__":
    run()
