"""The knotting head in the side view: its body and its tools, from its cams and grippers.

The knot is tied at a height above the fell that leaves the grippers room over the last row; the sley pushes it down.
Tools reach out of the body to the warps. Their boxes contain the rods at every rotation by the screw; sizes that no
machine states are assumed by this project.
"""

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.motions import CENTRE_ARM, CENTRE_MOTION, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.records import record
from ilmek.units import mm

CASE = 10 * mm
"""Wall and room around the largest cam of a head [m]."""

SLEY_HEIGHT, SLEY_DEPTH = 15 * mm, 10 * mm
"""Of the sley, along the warps and to the front [m]."""

OPENER_HEIGHT = 3 * mm
"""Of the opener, along the warps [m]."""

ARM_THICKNESS = 12 * mm
"""Of two links one behind the other, their blades within, along the warps [m]."""

LAST_ROW = 2 * mm
"""Height of the last knots above the fell before the beat [m]."""


@record
class HeadTool:
    """A tool of a head as a box that a track of the knot's cyclogram moves.

    corner     its lower corner next to the warps at position 0 of the track [m]       size  depth + i height [m]
    direction  of its motion for each metre of the track         limit     the largest position that moves it [m]
    """

    name: str
    track: str
    corner: complex
    size: complex
    direction: complex
    limit: float = float("inf")


@record
class HeadShape:
    """A head while it knots.

    body   its lower corner next to the warps [m]     size   depth + i height of the body [m]
    tools  that reach to the warps                    reach  the least x of any tool at rest [m]
    """

    body: complex
    size: complex
    tools: tuple[HeadTool, ...]
    reach: float

    @property
    def top(self) -> float:
        """Height of its highest point above the fell [m]."""
        return max(self.body.imag + self.size.imag, *((tool.corner + tool.size).imag for tool in self.tools))


def head_shape(weaver: Weaver, clearance: float) -> HeadShape:
    """The shape of a head; its tools keep a clearance [m] from the last row and from each other."""
    grippers, params = weaver.grippers, weaver.params
    if params.with_arms:
        return _with_arms(weaver, clearance)
    tied = LAST_ROW + clearance + (grippers.lift + grippers.finger) / 2
    low = tied - (grippers.lift + grippers.finger) / 2
    high = tied + grippers.height + grippers.finger / 2
    front, tip = grippers.warp / 2 + clearance, grippers.front + grippers.opening
    rest = tip + params.pull_back
    face = max(rest, weaver.drawn / 2) + clearance
    deep = 2 * max(cam.radius for cam in weaver.cams) + 2 * CASE
    opener = max(params.opener.front_span - OPENER_HEIGHT / 2, high + clearance)
    sley = max(params.sley_stroke, high + clearance)
    top = max(sley + SLEY_HEIGHT, opener + OPENER_HEIGHT) + CASE
    forward = grippers.opening + grippers.crossing
    tools = (
        HeadTool("side grippers", SIDE_MOTION, complex(tip, low), complex(face - tip + forward, high - low), -1 + 0j),
        HeadTool(
            "opener",
            SIDE_MOTION,
            complex(grippers.opening - front, opener),
            complex(face - grippers.opening + front + forward, OPENER_HEIGHT),
            -1 + 0j,
            grippers.opening,
        ),
        HeadTool(
            "centre gripper",
            CENTRE_MOTION,
            complex(grippers.stroke - grippers.depth, tied + grippers.height - grippers.finger / 2),
            complex(face + grippers.depth, grippers.finger),
            -1 + 0j,
        ),
        HeadTool("sley", SLEY, complex(front, sley), complex(face - front, SLEY_HEIGHT), -1j),
    )
    return HeadShape(
        complex(face, top - deep), complex(deep, deep), tools, min(tool.corner.real for tool in tools if tool.track)
    )


def _with_arms(weaver: Weaver, clearance: float) -> HeadShape:
    """The shape of a head with arms: they swing in a plane across the warps, of which the side view shows the edge."""
    params = weaver.params
    radius, travel = params.warp / 2, weaver.cyclogram.track(LEFT_ARM).stroke
    tied = LAST_ROW + clearance + ARM_THICKNESS / 2
    front = max(params.opening, weaver.cyclogram.track(CENTRE_ARM).stroke, travel) + radius
    face = max(front, weaver.drawn / 2) + clearance
    deep = 2 * max(cam.radius for cam in weaver.cams) + 2 * CASE
    low, high = tied - ARM_THICKNESS / 2, tied + ARM_THICKNESS / 2
    opener = max(params.opener.front_span - OPENER_HEIGHT / 2, high + clearance)
    sley = max(params.sley_stroke, high + clearance)
    top = max(sley + SLEY_HEIGHT, opener + OPENER_HEIGHT) + CASE
    rest, out = params.arms.rest - radius, params.opening - radius - clearance
    arms = (
        HeadTool(name, name, complex(rest, low), complex(face - rest + travel, ARM_THICKNESS), -1 + 0j)
        for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM)
    )
    tools = (
        *arms,
        HeadTool("opener", OPENER, complex(out, opener), complex(face - out + params.opening, OPENER_HEIGHT), -1 + 0j),
        HeadTool("sley", SLEY, complex(radius + clearance, sley), complex(face - radius - clearance, SLEY_HEIGHT), -1j),
    )
    least = min(tool.corner.real for tool in tools)
    return HeadShape(complex(face, top - deep), complex(deep, deep), tools, least)
