"""The knotting head in the side view: its body and its tools, from its cams and grippers.

The knot is tied between the two plates of the opener; the sley waits above them, and pushes it down to the fell.
Tools reach out of the body to the warps. Their boxes contain the rods at every rotation by the screw; sizes that no
machine states are assumed by this project.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from ilmek.cams.loaded_plate_cam import LoadedPlateCam
from ilmek.machines.weaver.cyclogram import handler_radius
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.levers import LEVER_AXLE, SOLID, FollowerLever, least_arm
from ilmek.machines.weaver.magazine import CARRIER, DRUM, Magazine
from ilmek.machines.weaver.motions import CENTRE_ARM, CENTRE_MOTION, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.selector import Selector
from ilmek.records import record
from ilmek.units import mm

BEFORE_MAGAZINE = 7 * mm
"""Between the magazine and the rail's carriage, for the carriage's motor [m]; assumed by this project."""

CASE = 10 * mm
"""Wall and room around the largest cam of a head [m]."""

BESIDE_MOTOR, BESIDE_CORNER, FEW = 10 * mm, 19 * mm, 4
"""Room about the motor of the colours, for the sensor of the tubes' index; with few tubes, between which it stands off
the motor's corner [m]; assumed by this project.
"""

RAIL_AXIS = 40 * mm
"""Side of the section of the linear axis that carries the heads [m]; assumed by this project."""

AXLE = 5 * mm
"""From the flange of the colours' motor to the tubes' carrier [m]; assumed by this project."""

GUIDE, PLAY, LAP = 10 * mm, 1 * mm, 4 * mm
"""Thickness of the followers' guide, from a roller to its fork's bar, and lap of its cheeks on that; assumed by this
project."""

SHEET, BAR, PARTITION, APART = 8 * mm, 6 * mm, 6 * mm, 1 * mm
"""Thickness of the face at most, of the carriages' cross bars, of the plate that guides their rods, and the room
between them [m]; assumed by this project."""

COLLARS = 23 * mm
"""Room before a carriage for what moves the jaws of its grippers [m]; assumed by this project."""

SPRING = 36 * mm
"""Room of the centre gripper's spring while it is shortest [m]; assumed by this project."""

HALF_GUIDE = 3.0
"""Half the depth of the followers' guide over the radius of their rollers; assumed by this project."""

DRAWBAR, UNDER = 5 * mm, 12 * mm
"""Half the height of a carriage's drawbar, and from the opener down to its middle [m]; assumed by this project."""

SLEY_BLOCK, SLEY_PIN = 12 * mm, 14 * mm
"""Depth of the sley's block, and from it to the pin of its lever [m]; assumed by this project."""

SLEY_HEIGHT, SLEY_TAIL = 15 * mm, 14 * mm
"""Of the sley along the warps, and of its arm behind the face's front [m]."""

BELL_CRANKS = (SIDE_MOTION, OPENER, CENTRE_MOTION)
"""Tracks whose levers are bell cranks, on one axle."""

OPENER_FOOT = 6 * mm, 7 * mm, 12 * mm
"""Depth of the feet of an opener's plate on its carriage, width and height of two, height of one where the plate is
narrow [m]; assumed by this project.
"""

HANDLER_ARM, RACK_BELOW = (5 * mm, 4 * mm), 6.6
"""Radius of the pile handler's arm and its thickness [m], and how far its rack reaches below its axis, over the radius
of the pinion [1]: teeth for a turn and three more, one over the pinion; assumed by this project."""

RACK = 5.6 * mm
"""Room for the rack and its pinion between the followers and that axle [m]; assumed by this project."""

LOWER_PLATE, UPPER_PLATE, SLEY_TOOL, CENTRE_TOOL = "lower plate of the opener", "opener", "sley", "centre gripper"

ABOVE_CENTRE, OVER_CENTRE = 18 * mm, 33 * mm
"""From the centre gripper up to its carriage's rod, and to the top of the case [m]; assumed by this project."""


@record
class HeadTool:
    """A tool of a head as a box that a track of the knot's cyclogram moves.

    corner     its lower corner next to the warps at position 0 of the track [m]       size  depth + i height [m]
    direction  of its motion for each metre of the track
    """

    name: str
    track: str
    corner: complex
    size: complex
    direction: complex


@record
class HeadShape:
    """A head while it knots.

    body   its lower corner next to the warps [m]     size   depth + i height of the body [m]
    axis   of the cam shaft [m]                       guide  from it up to the guide of the followers [m]
    levers    between followers and tools, by track
    carriage  front of the side grippers' carriage at rest, partition: of the plate behind it [m from the warps]
    tools  that reach to the warps                    reach  the least x of any tool at rest [m]
    belts  upper front corner of the belts of arms over the body; that of the body where there are none [m]
    rail   height of the axis along the row that carries the head, in front of all [m]
    magazine, magazine_size   of the yarn tubes, in front of the body, with its motion from tier to tier [m]
    """

    body: complex
    size: complex
    axis: complex
    guide: float
    levers: Mapping[str, FollowerLever]
    carriage: float
    partition: float
    tools: tuple[HeadTool, ...]
    reach: float
    belts: complex
    rail: float
    magazine: complex
    magazine_size: complex

    @property
    def front(self) -> float:
        """The end of the bracket, before the magazine: the foremost x of all but the carriage's motor [m]."""
        return self.magazine.real + self.magazine_size.real + BEFORE_MAGAZINE

    @property
    def corners(self) -> tuple[complex, ...]:
        """Upper corners in front of body, magazine and belts [m]."""
        return self.body + self.size, self.magazine + self.magazine_size, self.belts

    @property
    def top(self) -> float:
        """Height of its highest point above the fell [m]."""
        return max(self.belts.imag, *((tool.corner + tool.size).imag for tool in self.tools))


@record
class HeadTools:
    """The tools that reach to the warps.

    face  front of the case behind them      carriage  front of their carriage at rest, back: the most that it is
    pulled back [m]      stroke  of the centre gripper [m]
    belts  of arms: their end, and i times their height over the case [m]
    handler, rack  height of the pile handler's axis under the grippers of arms, and of the lower end of its rack [m]
    """

    tools: tuple[HeadTool, ...]
    face: float
    carriage: float
    back: float = 0.0
    stroke: float = 0.0
    belts: complex = 0j
    handler: float = math.nan
    rack: float = math.inf

    @property
    def partition(self) -> float:
        """The plate behind the carriage [m from the warps]."""
        return self.carriage + BAR + self.back + APART

    @property
    def centre_carriage(self) -> float:
        """Front of the centre gripper's carriage at rest, behind the partition and its spring [m from the warps]."""
        return self.partition + PARTITION + self.stroke + SPRING

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
    face = max(tip + grippers.stagger + params.pull_back, drawn / 2) + params.standoff
    carriage = face + SHEET + APART + COLLARS + grippers.opening + grippers.crossing
    above = max(
        low - params.clearance + params.opener.height, tied + grippers.height + grippers.finger / 2 + params.jaw
    )
    tools = (
        HeadTool(
            "side grippers",
            SIDE_MOTION,
            complex(tip, low),
            complex(carriage - tip, height / 2 + grippers.height + grippers.finger / 2),
            -1 + 0j,
        ),
        *_opener(params, SIDE_MOTION, complex(grippers.opening - front, carriage), above),
        HeadTool(
            CENTRE_TOOL,
            CENTRE_MOTION,
            complex(grippers.stroke - grippers.depth, tied + grippers.height - grippers.finger / 2),
            complex(carriage - grippers.stroke + grippers.depth, grippers.finger),
            -1 + 0j,
        ),
        _sley(params, complex(front, face + SLEY_TAIL), above),
    )
    return HeadTools(tools, face, carriage, params.pull_back, grippers.stroke)


def _with_arms(params: WeaverParams, drawn: float) -> HeadTools:
    """With arms, which swing in a plane across the warps: the side view shows its edge."""
    arms, radius, standoff = params.arms, params.warp / 2, params.standoff
    face = max(max(params.opening + radius, arms.stroke + radius, drawn / 2) + standoff, arms.back)
    rest, out = arms.rest - radius, params.opening - radius - standoff
    carriage, above = (
        face + SHEET + APART + OPENER_FOOT[0] + params.opening,
        params.opener.front_span + params.opener.height,
    )
    size = complex(face - rest + arms.stroke, arms.breadth)
    corner = complex(rest, params.opener.front_span + (params.opener.height - arms.breadth) / 2)
    tools = (
        *(HeadTool(name, name, corner, size, -1 + 0j) for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM)),
        *_opener(params, OPENER, complex(out, carriage), above),
        _sley(params, complex(radius + standoff, face + SLEY_TAIL), above),
    )
    grippers = params.opener.front_span + params.opener.height / 2 - arms.grip
    handler = grippers - HANDLER_ARM[0] - handler_radius(params, drawn)
    return HeadTools(
        tools,
        face,
        carriage,
        belts=complex(arms.belts_end, arms.belts_over),
        handler=handler,
        rack=handler - RACK_BELOW * params.pinion,
    )


def _opener(params: WeaverParams, track: str, span: complex, above: float) -> Iterator[HeadTool]:
    """Both plates of the opener.

    span  from their points at rest to the far end, as x + i x      above  the bottom of the upper one [m]
    """
    own = params.opener
    for name, height in ((LOWER_PLATE, own.front_span - own.plate), (UPPER_PLATE, above)):
        size = complex(span.imag - span.real, own.plate)
        yield HeadTool(name, track, complex(span.real, height), size, -1 + 0j)


def _sley(params: WeaverParams, span: complex, above: float) -> HeadTool:
    """The sley at rest, above the opener; span, above: see `_opener`."""
    height = max(params.sley_stroke, above + params.opener.plate)
    return HeadTool(SLEY_TOOL, SLEY, complex(span.real, height), complex(span.imag - span.real, SLEY_HEIGHT), -1j)


def head_shape(
    reaching: HeadTools, cams: Sequence[LoadedPlateCam], magazine: Magazine, selector: Selector, cutter: float
) -> HeadShape:
    """The head with its tools: behind its face the tools' carriages, below them levers, followers and cam shaft.

    So it is as deep as its largest cam, or as the cutter's motor behind the face, of a length [m]. The magazine stands
    in front of the body, and moves each tier to the height at which the knot is tied. Its motor, the selector's, stands
    below it on the bracket that leads from the body to the rail.
    """
    tools, face = reaching.tools, reaching.face
    tied = (tools[0].corner + tools[0].size / 2).imag
    tall = (2 * magazine.tiers - 1) * magazine.pitch
    beside = BESIDE_CORNER if magazine.kind == DRUM and magazine.per_tier <= FEW else BESIDE_MOTOR
    wide = max(magazine.width if magazine.kind == DRUM else magazine.pitch, selector.face + 2 * beside)
    largest, radius = max(cam.radius for cam in cams), max(cam.cam.roller_radius for cam in cams)
    line = max(
        face + CASE + largest,
        reaching.partition + PARTITION + SOLID,
        face + SHEET + cutter + APART + HALF_GUIDE * radius,
    )
    cranks = [cam.lift for cam in cams if cam.name in BELL_CRANKS]
    arm = max(RACK + LEVER_AXLE / 2 + 0.75 * radius, *(least_arm(lift) for lift in cranks))
    levers = {cam.name: lever for cam in cams if (lever := _lever(reaching, cam, line, arm)) is not None}
    lowest = min(reaching.rack, min(lever.pivot.imag - lever.lift / 2 for lever in levers.values()) - SOLID)
    guide = largest + 2 * radius + PLAY + LAP
    axis = complex(line, lowest - GUIDE - guide)
    deep, low = line + largest + CASE - face, axis.imag - largest - CASE
    top = max((tool.corner + tool.size).imag for tool in tools) + CASE
    if reaching.stroke > 0:  # the centre gripper's carriage has its rod over it
        top = max(top, (reaching.tool(CENTRE_TOOL).corner + reaching.tool(CENTRE_TOOL).size / 2).imag + OVER_CENTRE)
    return HeadShape(
        body=complex(face, low),
        size=complex(deep, top - low),
        axis=axis,
        guide=guide,
        levers=levers,
        carriage=reaching.carriage,
        partition=reaching.partition,
        tools=tools,
        reach=min(tool.corner.real for tool in tools),
        belts=reaching.belts + 1j * top if reaching.belts else complex(face + deep, top),
        rail=tied - tall / 2 - CARRIER - AXLE - selector.length - RAIL_AXIS / 2,
        magazine=complex(face + deep, tied - tall / 2),
        magazine_size=complex(wide, tall),
    )


def _lever(reaching: HeadTools, cam: LoadedPlateCam, line: float, arm: float) -> FollowerLever | None:
    """The lever of a cam, None where it has none; line: of its follower from the warps, arm: of all bell cranks [m]."""
    if cam.name in BELL_CRANKS:
        height = reaching.tool(LOWER_PLATE).corner.imag - UNDER
        return FollowerLever(complex(line - arm, height - cam.ratio * arm), arm, cam.ratio, cam.lift)
    if cam.name == SLEY:
        tool = reaching.tool(SLEY_TOOL)
        far = line - (tool.corner + tool.size).real - SLEY_BLOCK - SLEY_PIN
        own, height = far / (1 + cam.ratio), tool.corner.imag + SLEY_HEIGHT / 2 - cam.ratio * cam.lift / 2
        return FollowerLever(complex(line - own, height), own, cam.ratio, cam.lift, straight=True)
    return None
