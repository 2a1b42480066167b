"""The side view of a hand loom: z to the front, y up from the fell [m]; a vertical frame with two columns.

The warps hang in the plane z = 0 from the upper cylinder to the spacer; the carpet goes on to the lower cylinder, which
winds it. The spacer, which the warps turn, keeps their plane where rod and heddles are while the roll grows; the
traditional loom of the thesis has none. The columns stand behind the cylinders, as far as their reducers need.
"""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.elements.fillet_welds import TwoSeams, throat_for
from ilmek.machines.arrangement.cylinders import RoundPart, rolled, under_the_fell
from ilmek.machines.arrangement.side_view import ABOVE_CYLINDER, ABOVE_FLOOR
from ilmek.machines.automated_loom.brackets import arm_stress, screw_bores
from ilmek.machines.automated_loom.feet import FOOT
from ilmek.machines.automated_loom.frame import ROOM, FrameTask, column_checks
from ilmek.machines.automated_loom.joints import Seam
from ilmek.machines.automated_loom.supports import within
from ilmek.machines.bearing_seats import BRACKET, BearingSeat, least_height
from ilmek.machines.hand_shed import HandShed
from ilmek.machines.warp_tension import WarpTensionDesign
from ilmek.machines.warp_tension.cylinders import Cylinder, cylinders, spacer_tube
from ilmek.machines.warp_tension.tree import HANDLE_SIZE, reach_of, winding_reducer
from ilmek.part import catalogue
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.plane.contours import polygon, slotted
from ilmek.records import record
from ilmek.units import mm

WHEEL_FREE = 30 * mm
"""Least distance of a hand wheel from the floor and from a column beside it [m]; assumed by this project."""

DEPTH = 0.25
"""Feet to the front and to the back, over the height of the columns; assumed by this project."""

EDGE = 5 * mm
"""Bracket beyond its bearing's seat [m]; assumed by this project."""


@record
class CylinderBracket:
    """A bracket of a cylinder: from the middle of the width inner and outer face [m], its plate in the side view.

    height  of the plate [m]      moment  in its plane at the column, and out of it [N m]
    """

    cylinder: Cylinder
    at: complex
    inner: float
    plate: Prism
    height: float
    moment: tuple[float, float]

    @property
    def stress(self) -> float:
        """Greatest stress at the column, or beside the slot [Pa]."""
        at_column = 6 * self.moment[0] / (BRACKET * self.height**2) + 6 * self.moment[1] / (self.height * BRACKET**2)
        return max(at_column, arm_stress(self.seat, self.height / 2))

    def seam(self, column: HollowSquare) -> Seam:
        """Its weld to a column, or to the spacer between."""
        force = TwoSeams(self.height, column.side).force(self.cylinder.reaction, *self.moment)
        name, throat = self.cylinder.name, throat_for(force, *sorted((column.wall, BRACKET)))
        return Seam(f"bracket of the {name} cylinder", f"{name}-bracket", throat, force)

    @property
    def outer(self) -> float:
        """Outer face from the middle of the width [m]."""
        return self.inner + BRACKET

    @property
    def seat(self) -> BearingSeat:
        """The bearing on it."""
        return self.cylinder.seat


@record
class HandLoomLayout:
    """Where the parts of a hand loom are.

    upper, spacer, lower   cylinders          roll  radius of the lower one with the carpet [m]
    column    section of the columns          depth  axis of the columns, z [m]
    brackets  of the cylinders on a side      task  load of the columns
    """

    upper: RoundPart
    spacer: RoundPart
    lower: RoundPart
    roll: float
    floor: float
    top: float
    column: HollowSquare
    depth: float
    brackets: tuple[CylinderBracket, ...]
    task: FrameTask

    @property
    def base(self) -> HollowSquare:
        """Section of feet and floor beam: the columns', or the largest that has room under the roll of carpet."""
        return within(self.column, ABOVE_FLOOR - FOOT - ROOM)

    @property
    def face(self) -> float:
        """Inner face of the columns from the middle of the width [m]."""
        return max(bracket.outer for bracket in self.brackets)

    @property
    def reach(self) -> float:
        """Feet before and behind the columns' axis [m]."""
        return DEPTH * (self.top - self.floor)


def laid_out(
    winding: WarpTensionDesign, shed: HandShed, pile_height: float, safety: tuple[float, float, float]
) -> HandLoomLayout:
    """The layout for the cylinders and the shed.

    pile_height  of the wound carpet [m]    safety  of columns against yield and Euler's load, and their bow [m]
    """
    params, radius = winding.params, winding.outer_radius
    wide = max(radius, spacer_tube(params, radius).outer_radius)
    roll = rolled(radius, params.carpet_length, pile_height, params.cloth.carpet_yarns.warp.diameter)
    spacer, lower = under_the_fell(radius, wide, roll)
    upper = RoundPart(complex(-radius, shed.params.free_length), radius)
    floor = lower.at.imag - max(roll + ABOVE_FLOOR, params.crank + HANDLE_SIZE + WHEEL_FREE)
    under_beam = upper.at.imag + max(radius, cylinders(winding)[0].seat.side / 2) + ABOVE_CYLINDER
    task = FrameTask(
        height=under_beam - floor,
        depth=0.0,
        pull=winding.loads.worst,
        lever=0.0,
        carried=2 * winding.mass,
        stress_safety=safety[0],
        buckling_safety=safety[1],
        bow_limit=safety[2],
    )
    column, task = _column(task, reach_of(winding_reducer(winding)) + ROOM)
    depth = -radius - task.lever
    axes = {"upper": upper.at, "lower": lower.at, "spacer": spacer.at}
    brackets = tuple(_bracket(winding, own, axes[own.name], column, depth, safety[0]) for own in cylinders(winding))
    return HandLoomLayout(upper, spacer, lower, roll, floor, under_beam + column.side, column, depth, brackets, task)


def _column(task: FrameTask, beside: float) -> tuple[HollowSquare, FrameTask]:
    """The lightest section that keeps its checks, else the largest; its load has the lever and height that it gives.

    beside  from the cylinders' axes to a column's face [m]
    """
    loads = [
        (square, replace(task, lever=beside + square.side / 2, height=task.height + square.side))
        for square in ascending()
    ]
    return next((own for own in loads if all(check.ok for check in column_checks(own[1], own[0]))), loads[-1])


def _bracket(  # noqa: PLR0917
    design: WarpTensionDesign, own: Cylinder, at: complex, column: HollowSquare, depth: float, safety: float
) -> CylinderBracket:
    """A plate from behind the column to before the bearing, as high as the bearing's seat and the load need.

    s h² - 6 R o / t² h - 6 R d / t = 0      R force, d its lever off the column, o beside the plate  [beam theory]
    """
    params, seat, lever = design.params, own.seat, abs(at.real - depth)
    half = max(seat.side / 2 + EDGE, catalogue.screwed_radius(winding_reducer(design)))
    moment = own.reaction * lever, own.reaction * (seat.bearing.width + BRACKET) / 2
    high = max(least_height(moment, STEEL.strength / safety), 2 * half)
    back, front = depth - column.side / 2, at.real + half
    level = at.imag + high / 2 * np.array([-1, -1, 1, 1])
    outline: ComplexArray = np.array([back, front, front, back]) + 1j * level
    opened = slotted(polygon(outline), at, 1 + 0j, seat.bore / 2)  # the cylinder comes from the front
    plate = Prism(Profile(opened, screw_bores(seat, np.array([at]))), BRACKET)
    inner = params.span / 2 + params.stub + seat.bearing.width
    return CylinderBracket(own, at, inner, plate, high, moment)
