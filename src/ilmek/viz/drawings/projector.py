"""What views of solids need of a CAD kernel, without the kernel."""

from typing import Protocol

from ilmek.arrays import ComplexArray

Axis = tuple[float, float, float]


class Projector(Protocol):
    """Hidden-line removal."""

    def __call__(self, shape: object, eye: Axis, right: Axis) -> tuple[list[ComplexArray], list[ComplexArray]]:
        """Visible and hidden lines of a shape on a plane [m]: directions towards the eye, and to the right on it."""
