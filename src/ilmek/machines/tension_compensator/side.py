"""A parity of the compensator from the side, its sheet of warps on x = 0: rods, bar, warps, lever and springs."""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.geometry import Lever
from ilmek.report import Stroke
from ilmek.units import turn

RING = np.exp(1j * np.linspace(0, turn, 73))


@dataclass(frozen=True, slots=True)
class BarSide:
    """The strokes of a parity at a rotation of its lever."""

    warps: Stroke
    rods: tuple[Stroke, Stroke]
    bar: Stroke
    lever: Stroke
    springs: Stroke

    @property
    def strokes(self) -> tuple[Stroke, ...]:
        """All strokes, the lowest first."""
        return (self.warps, *self.rods, self.bar, self.lever, self.springs)


def parity(design: TensionCompensator, angle: float, *, named: bool = False) -> BarSide:
    """The strokes at a rotation of the lever [rad], with or without their names."""
    lever, radius = design.one.lever, design.radius
    path, bar = lever.path, complex(lever.bar(angle))
    upper, lower = (complex(-radius, side * path.half) + radius * RING for side in (1, -1))
    end = lever.pivot + lever.reach * np.exp(-1j * angle)
    return BarSide(
        warps=Stroke(_warp(lever, bar), "yarn", "warps" if named else ""),
        rods=(
            Stroke(upper, "outline", closed=True, filled=True),
            Stroke(lower, "outline", closed=True, filled=True),
        ),
        bar=Stroke(bar + radius * RING, "outline", "bar" if named else "", closed=True, filled=True),
        lever=Stroke(np.array([bar, lever.pivot, end]), "link", "lever" if named else ""),
        springs=Stroke(_coil(complex(lever.anchor), complex(end)), "path"),
    )


def _warp(lever: Lever, bar: complex) -> ComplexArray:
    """The warp from above the upper rod to below the lower one."""
    path, r = lever.path, lever.path.radius
    upper, lower = (float(angle) for angle in path.strands(np.asarray(bar)))
    top, low = complex(-r, path.half), complex(-r, -path.half)
    around = [
        np.array([top + r + 1.5j * path.half * 0.5]),
        top + r * np.exp(-1j * np.linspace(0, upper, 9)),
        bar - r * np.exp(1j * np.linspace(-upper, lower, 17)),
        low + r * np.exp(1j * np.linspace(lower, 0, 9)),
        np.array([low + r - 1.5j * path.half * 0.5]),
    ]
    return np.concatenate(around)


def _coil(start: complex, end: complex) -> ComplexArray:
    """A spring from end to end, as a zigzag."""
    along, across = end - start, 1j * (end - start) / abs(end - start) * 0.012
    shares = np.linspace(0.15, 0.85, 15)
    zigzag = start + along * shares + across * (-1.0) ** np.arange(15)
    return np.concatenate([[start, start + 0.12 * along], zigzag, [start + 0.88 * along, end]])


def moved(stroke: Stroke, by: float) -> Stroke:
    """The stroke, moved to the right [m]."""
    return Stroke(stroke.points + by, stroke.role, stroke.label, stroke.closed, stroke.filled)


def mirrored(stroke: Stroke, by: float) -> Stroke:
    """The stroke, moved to the right [m] and mirrored at x = 0."""
    return Stroke(-np.conj(stroke.points + by), stroke.role, stroke.label, stroke.closed, stroke.filled)
