"""Tasks of three and four poses with limits that a planted four-bar fulfils with little slack."""

import math
from typing import NamedTuple

import numpy as np

from ilmek.synthesis.candidate import judge
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.filters import defects
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask
from ilmek.units import mm


class PlantedTask(NamedTuple):
    """A planted four-bar, drawn at the first pose, and the settings of `motion-four-bar`, as on the command line."""

    drawn: FourBar
    settings: dict[str, str]


def planted_motion(seed: int, poses: int) -> PlantedTask:
    """A task whose limits have 5 to 10 % of slack; which limits are given changes with the seed."""
    random = np.random.default_rng([poses, seed])
    while True:
        drawn, cranks = _drawn(random, poses)
        if drawn is None:
            continue
        settings = _task(random, drawn, cranks)
        if settings:
            return PlantedTask(drawn, settings)


def _drawn(random: np.random.Generator, poses: int) -> tuple[FourBar | None, np.ndarray]:
    """A random four-bar about 0.3 m large, and parameters of its circuit at which it takes the poses."""
    a0, b0, a, b, p = 0.1 * random.normal(size=10).view(complex)
    try:
        loops = circuit_loops(FourBar(a0, b0, a, b, p))
    except ArithmeticError:
        return None, np.zeros(0)
    if not loops:
        return None, np.zeros(0)
    loop = loops[random.integers(len(loops))]
    span = random.uniform(0.8, 4.5) if loop.branch else random.uniform(0.8, 2.6)
    start = random.uniform(0, 2 * math.pi) if loop.branch else random.uniform(0.1, math.pi - 0.1 - span)
    u = start + span * np.linspace(0, 1, poses) + random.uniform(-0.15, 0.15, poses) * span / poses
    if not loop.branch and (u.min() < 0.1 or u.max() > math.pi - 0.1):
        return None, u
    at = loop.at(u)
    first = FourBar(a0, b0, complex(at.a[0]), complex(at.b[0]), complex(at.tracer[0]))
    return first, np.stack([at.tracer, at.coupler])


def _task(random: np.random.Generator, drawn: FourBar, poses: np.ndarray) -> dict[str, str]:
    """Poses and limits; {} where the four-bar is no good one."""
    points, angles = poses[0], np.unwrap(np.angle(poses[1]))
    # The task is that of the text, which has ten digits.
    one = judge(drawn, PrecisionTask(points=points, coupler=angles))
    extent = float(np.max(np.abs(points[:, None] - points)))
    good = one.least_transmission > math.radians(15) and one.link_ratio < 8 and extent > 0.15 * one.size
    if not good or defects(one) or np.ptp(angles) < 0.05:
        return {}

    def slack() -> float:
        return float(random.uniform(0.05, 0.10))

    settings = {
        "poses": " ".join(
            f"({point.real / mm:.10f}mm,{point.imag / mm:.10f}mm,{math.degrees(angle):.10f}deg)"
            for point, angle in zip(points, angles, strict=True)
        ),
        "size_max": f"{one.size * (1 + slack()) / mm:.6f}mm",
        "link_ratio_max": f"{one.link_ratio * (1 + slack()):.6f}",
        "transmission_min": f"{math.degrees(one.least_transmission) * (1 - slack()):.6f}deg",
        "full_turn": "yes" if one.crank_turns else "no",
    }
    kind = random.integers(4)
    if kind == 1:
        settings |= {name: _rectangle(pivot, slack() * one.size) for name, pivot in _pivots(drawn)}
    elif kind == 2:
        settings |= {name: _triangle(random, pivot, slack() * one.size) for name, pivot in _pivots(drawn)}
    elif kind == 3:
        ends = (drawn.a0, drawn.b0)
        for axis, values in (("x", [one.real for one in ends]), ("y", [one.imag for one in ends])):
            low, high = min(values) - slack() * one.size, max(values) + slack() * one.size
            settings[f"pivot_{axis}"] = f"{low / mm:.6f}mm..{high / mm:.6f}mm"
    return settings


def _pivots(drawn: FourBar) -> list[tuple[str, complex]]:
    return [("crank_region", drawn.a0), ("rocker_region", drawn.b0)]


def _rectangle(pivot: complex, reach: float) -> str:
    corners = pivot - reach * (1 + 1j), pivot + reach * (1 + 1j)
    return " ".join(f"({one.real / mm:.6f}mm,{one.imag / mm:.6f}mm)" for one in corners)


def _triangle(random: np.random.Generator, pivot: complex, reach: float) -> str:
    turned = np.exp(1j * (random.uniform(0, 2) + 2 * math.pi * np.arange(3) / 3))
    corners = pivot + reach * 1.5 * turned
    return " ".join(f"({one.real / mm:.6f}mm,{one.imag / mm:.6f}mm)" for one in corners)
