"""The five cases on which the literature of approximate path synthesis measures itself.

Kunjur and Krishnamurty (1997), Cabrera, Simon and Prado (2002), Acharyya and Mandal (2009), Cabrera, Ortiz, Nadal and
Castillo (2011), Lin and Hsiao, Lin (2010); best values re-evaluated from the printed design vectors. Their lengths have
no unit; here they are metres.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.synthesis.path.task import PathTask


@dataclass(frozen=True, slots=True)
class PathCase:
    """A case: what is asked, the best squared error known, and what others report."""

    name: str
    task: PathTask
    best: float
    peers: str


def _points(text: str) -> np.ndarray:
    return np.array([complex(*map(float, pair.split(","))) for pair in text.split()])


def _bounds(links: float, rest: float, **fixed: tuple[float, float]) -> dict[str, tuple[float, float]]:
    named = dict.fromkeys(("ground", "crank", "coupler", "rocker"), (0.0, links))
    return {**named, **dict.fromkeys(("along", "across", "x", "y"), (-rest, rest)), **fixed}


ZERO = (0.0, 0.0)

LINE = PathCase(
    "1 vertical line",
    PathTask(_points("20,20 20,25 20,30 20,35 20,40 20,45"), bounds=_bounds(60, 60)),
    1e-20,
    "GA 1.212, PSO 0.2986, GA 0.0363, DE 0.01506, MUMSA 2.063e-4, Lin&Hsiao 4.067e-12, HCDJ 8.8e-29",
)
TIMED = PathCase(
    "2 timed, pivot at origin",
    PathTask(
        _points("3,3 2.759,3.363 2.372,3.663 1.890,3.862 1.355,3.943"),
        timing=np.radians([30.0, 45.0, 60.0, 75.0, 90.0]),
        bounds=_bounds(50, 50, x=ZERO, y=ZERO, turn=ZERO, start=ZERO),
    ),
    7.4158e-7,
    "Kunjur 9.53e-4, IOA 4.27e-6, HCDJ 1.924e-6, Cabrera 1.827e-6, MUMSA 1.284e-6",
)
CLOSED = PathCase(
    "3 closed, every 20 deg",
    PathTask(
        _points(
            "0.5,1.1 0.4,1.1 0.3,1.1 0.2,1.0 0.1,0.9 0.05,0.75 0.02,0.6 0,0.5 0,0.4 "
            "0.03,0.3 0.1,0.25 0.15,0.2 0.2,0.3 0.3,0.4 0.4,0.5 0.5,0.7 0.6,0.9 0.6,1.0"
        ),
        timing=np.radians(20.0 * np.arange(18)),
        closed=True,
        bounds=_bounds(50, 50),
    ),
    9.0289e-3,
    "Kunjur 0.0661, IOA 0.0350, Cabrera 0.0337, MUMSA 0.01941, HCDJ 0.01608",
)
SEMICIRCLE = PathCase(
    "4 timed semicircle",
    PathTask(
        _points("0,0 1.9098,5.8779 6.9098,9.5106 13.09,9.5106 18.09,5.8779 20,0"),
        timing=np.radians(np.arange(30.0, 181.0, 30.0)),
        bounds=_bounds(50, 50, start=ZERO),
    ),
    1.2162121,
    "5.547, 5.521, 2.580, 2.491, 1.21622; HCDJ 1.21621",
)
ELLIPSE = PathCase(
    "5 ellipse",
    PathTask(
        _points(
            "20,10 17.66,15.142 11.736,17.878 5,16.928 0.60307,12.736 "
            "0.60307,7.2638 5,3.0718 11.736,2.1215 17.66,4.8577 20,10"
        ),
        closed=True,
        bounds=_bounds(80, 80),
    ),
    4.01992e-4,
    "IOA 0.0223, MUMSA 4.77e-3, HCDJ 4.2014e-4, W.Y. Lin 4.01992e-4",
)

CASES = (LINE, TIMED, CLOSED, SEMICIRCLE, ELLIPSE)

NEAR = 1 + 1e-3
"""How near to the best value a run must come."""


def met(case: PathCase, squared_error: float) -> bool:
    """Whether a run has reached the best value."""
    return math.isfinite(squared_error) and squared_error <= case.best * NEAR


def random_path(seed: int) -> PathTask:
    """A random task: a curve of six Fourier terms, open or closed, in part timed or within limits, or a hand's outline.

    seed  of the random numbers; seed modulo 6 is the kind: 0 to 2 without, 3 with timing, 4 within limits, 5 an outline
    """
    rng, kind = np.random.default_rng(88_000 + seed), seed % 6
    count, closed = int(rng.integers(7, 25)), bool(rng.integers(2))
    along = np.linspace(0, 2 * math.pi if closed else rng.uniform(2, 5), count, endpoint=not closed)
    terms = (-3, -2, -1, 1, 2, 3)
    points = sum((rng.normal() + 1j * rng.normal()) / k**2 * np.exp(1j * k * along) for k in terms) * 0.05
    if kind == 3:
        return PathTask(points, closed=closed, timing=along)
    if kind == 4:
        size = PathTask(points).size
        links = dict.fromkeys(("ground", "crank", "coupler", "rocker"), (0.05 * size, 2.5 * size))
        return PathTask(points, closed=closed, transmission=math.radians(35), bounds=links)
    if kind == 5:
        corners = rng.uniform(0.4, 1, 6) * np.exp(1j * np.sort(rng.uniform(0, 2 * math.pi, 6))) * 0.05
        return PathTask(np.interp(np.arange(18) / 3, np.arange(7), np.append(corners, corners[0])), closed=True)
    return PathTask(points, closed=closed)
