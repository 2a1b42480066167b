"""A beam on two or more supports with transverse loads in two planes.

A transverse load is a complex number: its real part is in one plane (for example vertical, the weight), its imaginary
part in the other (for example horizontal, the pull of the warps). So are shear, moment, slope and deflection; both
planes are solved together. The supports are rigid in both. Positions x [m] are measured from the beam's left end.

>>> simple = Beam(1.2, (0.0, 1.2), (LineLoad(0.0, 1.2, 7500.0),))
>>> simple.weight
9000.0
"""

from dataclasses import dataclass
from typing import TypeAlias

from ilmek.errors import ParameterError
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class PointLoad:
    """A force [N] at a position [m], positive in the direction of positive deflection."""

    at: float
    force: complex


@dataclass(frozen=True, slots=True)
class LineLoad:
    """A load per length [N/m] from `start` to `end` [m], constant or linear from `first` to `last`."""

    start: float
    end: float
    first: complex
    last: complex | None = None

    @property
    def gradient(self) -> complex:
        """Change of the load along the beam [N/m²]."""
        return 0.0 if self.last is None else (self.last - self.first) / (self.end - self.start)

    def value(self, x: float) -> complex:
        """Load per length [N/m] at a position x [m] between its ends."""
        return self.first + self.gradient * (x - self.start)

    @property
    def total(self) -> complex:
        """Resultant force [N]."""
        return (self.end - self.start) * (self.first + (self.first if self.last is None else self.last)) / 2


@dataclass(frozen=True, slots=True)
class Couple:
    """A couple [N m] at a position [m], positive in the direction of positive slope."""

    at: float
    moment: complex


Load: TypeAlias = PointLoad | LineLoad | Couple


@dataclass(frozen=True, slots=True)
class Beam:
    """A beam of constant section.

    length   [m]      supports  positions of its hinged supports [m], ascending      loads  transverse
    clamped  the ends of the beam, 0 or length, with a fixed slope too; they must be supports
    Raises ParameterError for supports or loads off the beam, and for an insufficiently supported beam.
    """

    length: float
    supports: tuple[float, ...]
    loads: tuple[Load, ...] = ()
    clamped: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if not self.length > 0:
            raise ParameterError(f"a beam {format_quantity(self.length, 'mm')} long", allowed="more than 0")
        if any(after <= before for before, after in zip(self.supports, self.supports[1:], strict=False)):
            raise ParameterError(
                f"supports at {self._positions(self.supports)}",
                allowed="ascending positions",
                do="sort them, each once",
            )
        self._check_on_beam()
        if not set(self.clamped) <= {0.0, self.length} & set(self.supports):
            raise ParameterError(
                f"a beam clamped at {self._positions(self.clamped)}",
                allowed=f"0 mm or {format_quantity(self.length, 'mm')}, where a support is",
                do="add a support at the end, or two supports close together elsewhere",
            )
        if len(self.supports) + len(self.clamped) < 2:
            raise ParameterError(
                f"{len(self.supports)} supports", allowed="two or more, or one clamped", do="add a support or clamp it"
            )

    def _check_on_beam(self) -> None:
        spans = [(at, at) for at in self.supports]
        for load in self.loads:
            spans.append((load.start, load.end) if isinstance(load, LineLoad) else (load.at, load.at))
            if isinstance(load, LineLoad) and not load.start < load.end:
                raise ParameterError(f"a line load from {self._positions(spans[-1])}", allowed="a start before its end")
        for off in (at for span in spans for at in span if not 0 <= at <= self.length):
            raise ParameterError(
                f"a support or load at {format_quantity(off, 'mm')}",
                allowed=f"0 to {format_quantity(self.length, 'mm')}, the beam's length",
                do="move it onto the beam or lengthen the beam",
            )

    @property
    def weight(self) -> complex:
        """Sum of all forces of the loads [N]."""
        forces = (load.force if isinstance(load, PointLoad) else load.total for load in self.transverse)
        return sum(forces, 0.0)

    @property
    def transverse(self) -> tuple[PointLoad | LineLoad, ...]:
        """The loads except couples."""
        return tuple(load for load in self.loads if not isinstance(load, Couple))

    @staticmethod
    def _positions(positions: tuple[float, ...]) -> str:
        return ", ".join(format_quantity(at, "mm") for at in positions)
