"""The hinge of a gripper's jaws: a finger's eye on a pin between two lugs of the gripper, all within their thickness.

Axes: x from the axis of the pin to the tip, y from the fixed jaw to the finger, z along the pin, 0 in its middle.
Finger and fixed jaw are half as thick as the gripper t. About the pin the finger is half as wide, and round:

    radius of eye and lugs    r = min(t/4, l/6)      diameter of the pin    r
    from the jaws' root to its axis, of which r/5 is play    6/5 r
"""

import numpy as np

from ilmek.machines.weaver.opener import STEEL
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.report import Contour


@record
class JawHinge:
    """The hinge of jaws of a length, of a gripper of a thickness [m]."""

    length: float
    thick: float

    @property
    def radius(self) -> float:
        """Radius of the eye and of the lugs [m]."""
        return min(self.thick / 4, self.length / 6)

    @property
    def root(self) -> float:
        """From the root of the jaws to the pin's axis [m]."""
        return 1.2 * self.radius

    @property
    def finger(self) -> Sum:
        """The finger, closed."""
        begin, end = self.root, self.length - self.root
        eye = Placed(Prism(self._eye(begin), self.thick / 2), (placement(z=-self.thick / 4),))
        jaw = box(end - begin, self.thick / 2, self.thick)
        return Sum((eye, Placed(jaw, (placement((begin + end) / 2, z=-self.thick / 2),))))

    @property
    def lugs(self) -> Placed:
        """The lugs beside the eye, a member of the gripper."""
        sides = (placement(z=z, about=(0.0, 1.0, 0.0), angle=np.pi) for z in (-self.thick / 4, self.thick / 2))
        return Placed(Prism(self._eye(self.root), self.thick / 4), tuple(sides))

    def pin(self, name: str, title: str) -> Part:
        """The pin, from z = 0."""
        return Part(name, title, "pin or bush", bar(self.radius, self.thick), STEEL)

    def _eye(self, end: float) -> Profile:
        """Round about the pin, straight to where it is on its jaw or gripper."""
        top = 1j * self.radius
        outline = Contour(np.array([-top, end - top, end + top, top]), np.array([0.0, 0.0, 0.0, 1.0]))
        return Profile(outline, (circle(0j, self.radius / 2),))
