"""The knotting head in the side view: its body and its tools, from its cams and grippers.

The knot is tied between the two plates of the opener; the sley waits above them, and pushes it down to the fell.
Tools reach out of the body to the warps. Their boxes contain the rods at every rotation by the screw; sizes that no
machine states are assumed by this project.
"""

from collections.abc import Iterator

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.magazine import DRUM
from ilmek.machines.weaver.motions import CENTRE_ARM, CENTRE_MOTION, LEFT_ARM, OPENER, RIGHT_ARM, SIDE_MOTION, SLEY
from ilmek.records import record
from ilmek.units import mm

CASE = 10 * mm
"""Wall and room around the largest cam of a head [m]."""

SLEY_HEIGHT, SLEY_DEPTH = 15 * mm, 10 * mm
"""Of the sley, along the warps and to the front [m]."""


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
    magazine, magazine_size   of the yarn tubes, in front of the body, with its motion from tier to tier [m]
    """

    body: complex
    size: complex
    tools: tuple[HeadTool, ...]
    reach: float
    magazine: complex
    magazine_size: complex

    @property
    def front(self) -> float:
        """The foremost x [m]."""
        return self.magazine.real + self.magazine_size.real

    @property
    def top(self) -> float:
        """Height of its highest point above the fell [m]."""
        return max(self.body.imag + self.size.imag, *((tool.corner + tool.size).imag for tool in self.tools))


def head_shape(weaver: Weaver, clearance: float) -> HeadShape:
    """The shape of a head; its body keeps a clearance [m] from the yarn that its tools draw."""
    grippers, params = weaver.grippers, weaver.params
    if params.with_arms:
        return _with_arms(weaver, clearance)
    low = params.opener.front_span + params.clearance
    height = grippers.lift + grippers.finger
    tied = low + height / 2
    front, tip = grippers.warp / 2 + clearance, grippers.front + grippers.opening
    face = max(tip + params.pull_back, weaver.drawn / 2) + clearance
    forward = grippers.opening + grippers.crossing
    tools = (
        HeadTool(
            "side grippers",
            SIDE_MOTION,
            complex(tip, low),
            complex(face - tip + forward, height / 2 + grippers.height + grippers.finger / 2),
            -1 + 0j,
        ),
        *_opener(weaver, SIDE_MOTION, complex(grippers.opening - front, face + forward), grippers.opening),
        HeadTool(
            "centre gripper",
            CENTRE_MOTION,
            complex(grippers.stroke - grippers.depth, tied + grippers.height - grippers.finger / 2),
            complex(face + grippers.depth, grippers.finger),
            -1 + 0j,
        ),
        _sley(weaver, complex(front, face)),
    )
    return _around(weaver, tools, face)


def _opener(weaver: Weaver, track: str, span: complex, limit: float) -> Iterator[HeadTool]:
    """Both plates of the opener; span: from their points at rest to the far end, as x + i x [m]."""
    own = weaver.params.opener
    for name, height in (
        ("lower plate of the opener", own.front_span - own.plate),
        ("opener", own.front_span + own.height),
    ):
        size = complex(span.imag - span.real, own.plate)
        yield HeadTool(name, track, complex(span.real, height), size, -1 + 0j, limit)


def _sley(weaver: Weaver, span: complex) -> HeadTool:
    """The sley at rest, above the opener; span: see `_opener`."""
    own = weaver.params.opener
    height = max(weaver.params.sley_stroke, own.front_span + own.height + own.plate)
    return HeadTool("sley", SLEY, complex(span.real, height), complex(span.imag - span.real, SLEY_HEIGHT), -1j)


def _around(weaver: Weaver, tools: tuple[HeadTool, ...], face: float) -> HeadShape:
    """The head with its tools: the body in front of its face [m], as deep as its largest cam, and the magazine.

    The magazine stands in front of the body, and moves each tier to the height at which the knot is tied.
    """
    magazine, tied = weaver.magazine, (tools[0].corner + tools[0].size / 2).imag
    tall = (2 * magazine.tiers - 1) * magazine.pitch
    wide = magazine.width if magazine.kind == DRUM else magazine.pitch
    deep = 2 * max(cam.radius for cam in weaver.cams) + 2 * CASE
    top = max((tool.corner + tool.size).imag for tool in tools) + CASE
    return HeadShape(
        body=complex(face, top - deep),
        size=complex(deep, deep),
        tools=tools,
        reach=min(tool.corner.real for tool in tools),
        magazine=complex(face + deep, tied - tall / 2),
        magazine_size=complex(wide, tall),
    )


def _with_arms(weaver: Weaver, clearance: float) -> HeadShape:
    """The shape of a head with arms: they swing in a plane across the warps, of which the side view shows the edge."""
    params = weaver.params
    radius, tracks = params.warp / 2, [weaver.cyclogram.track(name) for name in (LEFT_ARM, RIGHT_ARM, CENTRE_ARM)]
    travel = max(track.stroke for track in tracks)
    face = max(params.opening + radius, travel + radius, weaver.drawn / 2) + clearance
    rest, out = params.arms.rest - radius, params.opening - radius - clearance
    size = complex(face - rest + travel, params.arms.breadth)
    corner = complex(rest, params.opener.front_span + (params.opener.height - params.arms.breadth) / 2)
    tools = (
        *(HeadTool(track.name, track.name, corner, size, -1 + 0j) for track in tracks),
        *_opener(weaver, OPENER, complex(out, face + params.opening), params.opening),
        _sley(weaver, complex(radius + clearance, face)),
    )
    return _around(weaver, tools, face)
