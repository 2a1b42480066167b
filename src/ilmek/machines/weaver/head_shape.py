"""The knotting head in the side view: its body and its tools, from its cams and grippers.

The knot is tied between the two plates of the opener; the sley waits above them, and pushes it down to the fell.
Tools reach out of the body to the warps. Their boxes contain the rods at every rotation by the screw; sizes that no
machine states are assumed by this project.
"""

from collections.abc import Iterator, Sequence

from ilmek.cams.loaded_plate_cam import LoadedPlateCam
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.magazine import CARRIER, DRUM, Magazine
from ilmek.machines.weaver.motions import CENTRE_ARM, CENTRE_MOTION, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.selector import Selector
from ilmek.records import record
from ilmek.units import mm

CASE = 10 * mm
"""Wall and room around the largest cam of a head [m]."""

RAIL_AXIS = 40 * mm
"""Side of the section of the linear axis that carries the heads [m]; assumed by this project."""

AXLE = 5 * mm
"""From the flange of the colours' motor to the tubes' carrier [m]; assumed by this project."""

GUIDE, PLAY, LAP = 10 * mm, 1 * mm, 4 * mm
"""Thickness of the followers' guide, from a roller to its fork's bar, and lap of its cheeks on that; assumed by this
project."""

APART = 0.5 * mm
"""From the tools' ends to the levers behind them [m]."""

SLEY_HEIGHT, SLEY_TAIL = 15 * mm, 12 * mm
"""Of the sley along the warps, and of its arm within the case [m]."""

LOWER_PLATE, UPPER_PLATE, SLEY_TOOL = "lower plate of the opener", "opener", "sley"


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
    bay    depth behind its face for the ends of tools and followers, before the cams [m]
    guide  from the cam shaft's axis to the guide of the followers [m]
    tools  that reach to the warps                    reach  the least x of any tool at rest [m]
    rail   height of the axis along the row that carries the head, in front of all [m]
    magazine, magazine_size   of the yarn tubes, in front of the body, with its motion from tier to tier [m]
    """

    body: complex
    size: complex
    bay: float
    guide: float
    tools: tuple[HeadTool, ...]
    reach: float
    rail: float
    magazine: complex
    magazine_size: complex

    @property
    def axis(self) -> complex:
        """The axis of the cam shaft [m]."""
        return self.body + self.bay + (self.size - self.bay) / 2

    @property
    def front(self) -> float:
        """The foremost x [m]."""
        return self.magazine.real + self.magazine_size.real

    @property
    def top(self) -> float:
        """Height of its highest point above the fell [m]."""
        return max(self.body.imag + self.size.imag, *((tool.corner + tool.size).imag for tool in self.tools))


@record
class HeadTools:
    """The tools that reach to the warps, the case's face behind them, and the most that they are pulled back [m]."""

    tools: tuple[HeadTool, ...]
    face: float
    back: float = 0.0

    @property
    def bay(self) -> float:
        """Depth of the case that the tools' ends take [m]."""
        return max((tool.corner + tool.size).real for tool in self.tools) + self.back - self.face

    def tool(self, name: str) -> HeadTool:
        """The tool of a name."""
        return next(tool for tool in self.tools if tool.name == name)


def head_tools(params: WeaverParams, grippers: Grippers, drawn: float) -> HeadTools:
    """The tools of a head, and its face, which keeps the standoff from the yarn that they draw, drawn [m]."""
    return _with_arms(params, drawn) if params.with_arms else _with_grippers(params, grippers, drawn)


def _with_grippers(params: WeaverParams, grippers: Grippers, drawn: float) -> HeadTools:
    low = params.opener.front_span + params.clearance
    height = grippers.lift + grippers.finger
    tied = low + height / 2
    front, tip = grippers.warp / 2 + params.standoff, grippers.front + grippers.opening
    face = max(tip + params.pull_back, drawn / 2) + params.standoff
    forward = grippers.opening + grippers.crossing
    tools = (
        HeadTool(
            "side grippers",
            SIDE_MOTION,
            complex(tip, low),
            complex(face - tip + forward, height / 2 + grippers.height + grippers.finger / 2),
            -1 + 0j,
        ),
        *_opener(params, SIDE_MOTION, complex(grippers.opening - front, face + forward), grippers.opening),
        HeadTool(
            "centre gripper",
            CENTRE_MOTION,
            complex(grippers.stroke - grippers.depth, tied + grippers.height - grippers.finger / 2),
            complex(face + grippers.depth, grippers.finger),
            -1 + 0j,
        ),
        _sley(params, complex(front, face + SLEY_TAIL)),
    )
    return HeadTools(tools, face, params.pull_back)


def _with_arms(params: WeaverParams, drawn: float) -> HeadTools:
    """With arms, which swing in a plane across the warps: the side view shows its edge."""
    arms, radius, standoff = params.arms, params.warp / 2, params.standoff
    face = max(params.opening + radius, arms.stroke + radius, drawn / 2) + standoff
    rest, out = arms.rest - radius, params.opening - radius - standoff
    size = complex(face - rest + arms.stroke, arms.breadth)
    corner = complex(rest, params.opener.front_span + (params.opener.height - arms.breadth) / 2)
    tools = (
        *(HeadTool(name, name, corner, size, -1 + 0j) for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM)),
        *_opener(params, OPENER, complex(out, face + params.opening), params.opening),
        _sley(params, complex(radius + standoff, face + SLEY_TAIL)),
    )
    return HeadTools(tools, face)


def _opener(params: WeaverParams, track: str, span: complex, limit: float) -> Iterator[HeadTool]:
    """Both plates of the opener; span: from their points at rest to the far end, as x + i x [m]."""
    own = params.opener
    for name, height in ((LOWER_PLATE, own.front_span - own.plate), (UPPER_PLATE, own.front_span + own.height)):
        size = complex(span.imag - span.real, own.plate)
        yield HeadTool(name, track, complex(span.real, height), size, -1 + 0j, limit)


def _sley(params: WeaverParams, span: complex) -> HeadTool:
    """The sley at rest, above the opener; span: see `_opener`."""
    own = params.opener
    height = max(params.sley_stroke, own.front_span + own.height + own.plate)
    return HeadTool(SLEY_TOOL, SLEY, complex(span.real, height), complex(span.imag - span.real, SLEY_HEIGHT), -1j)


def head_shape(
    reaching: HeadTools, cams: Sequence[LoadedPlateCam], magazine: Magazine, selector: Selector
) -> HeadShape:
    """The head with its tools: the body in front of its face, as deep as tools' ends and its largest cam, the magazine.

    The magazine stands in front of the body, and moves each tier to the height at which the knot is tied. Its motor,
    the selector's, stands below it on the bracket that leads from the body to the rail.
    """
    tools, face = reaching.tools, reaching.face
    tied = (tools[0].corner + tools[0].size / 2).imag
    tall = (2 * magazine.tiers - 1) * magazine.pitch
    wide = max(magazine.width if magazine.kind == DRUM else magazine.pitch, selector.face)
    deep = 2 * max(cam.radius for cam in cams) + 2 * CASE
    largest, radius = deep / 2 - CASE, max(cam.cam.roller_radius for cam in cams)
    guide = largest + 2 * radius + PLAY + LAP
    ends = guide + GUIDE + max(float(cam.motion.s.max()) for cam in cams) + CASE + APART - deep / 2
    top, bay = max((tool.corner + tool.size).imag for tool in tools) + CASE, max(reaching.bay + APART, ends)
    return HeadShape(
        body=complex(face, top - deep),
        size=complex(bay + deep, deep),
        bay=bay,
        guide=guide,
        tools=tools,
        reach=min(tool.corner.real for tool in tools),
        rail=tied - tall / 2 - CARRIER - AXLE - selector.length - RAIL_AXIS / 2,
        magazine=complex(face + bay + deep, tied - tall / 2),
        magazine_size=complex(wide, tall),
    )
