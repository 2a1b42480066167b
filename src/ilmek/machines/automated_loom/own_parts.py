"""The loom's own parts that are in none of its machines, as bodies: frame, heads' rail, back rest, control.

Axes of the scene: x along the width, 0 in the middle of the cloth, y up from the fell, z to the front.
"""

from collections.abc import Iterable

from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.motors import smallest_motor
from ilmek.elements.tubes import TUBES, Tube
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import LoomFrame, part_id
from ilmek.machines.weaver import head_mass
from ilmek.machines.weaver.head_shape import APART, RAIL_AXIS
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.shapes import box, square_tube, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.timing.track import peak_acceleration, peak_speed

RAIL = "heads' rail"
"""Id of the body that carries the heads."""

CABINET = (0.8, 1.0, 0.3)
"""Width, height and depth of the control's cabinet [m]; assumed by this project."""

_MISSING = Joint(JointKind.MISSING)


def back_rest_tube(loom: LoomDesign) -> Tube:
    """The tube of the back rest: the thickest of the stock of its diameter."""
    outer = 2 * loom.side.back_rest.radius
    return max(TUBES.values(), key=lambda row: (-abs(row.outer - outer), row.wall))


def carried_tree(loom: LoomDesign) -> Tree:
    """What the frame carries beside the machines: back rest, axes and motor of the rail's retreat.

    What carries the back rest is not designed yet.
    """
    section, axis, wide = back_rest_tube(loom), loom.side.back_rest.at, loom.task.width
    roller = Part(
        part_id("back-rest"),
        "back rest",
        "steel tube",
        f"tube {section.name} mm",
        tube(section.outer, section.wall, wide),
        STEEL,
    )
    back = placement(-wide / 2, axis.imag, axis.real).after(ALONG_WIDTH)
    return Tree((RigidBody(part_id("back rest"), (Occurrence(roller, (back,)),), joint=_MISSING), _retreat(loom)))


def _retreat(loom: LoomDesign) -> RigidBody:
    """The axes of the rail's retreat at its ends, and their motor."""
    row = loom.row_cyclogram
    heads = row.track(HEADS)
    moved = loom.heads * head_mass(loom.weaver) * peak_acceleration(heads, row.period)
    torque, turning = moved * PULLEY, peak_speed(heads, row.period) / PULLEY
    axis = Part(
        part_id("retreat-axis"),
        "axis of the rail's retreat",
        "linear axis",
        "belt drive, one at each column",
        box(RAIL_AXIS, RAIL_AXIS, heads.stroke),
        purchase=Bought("belt drive", length=heads.stroke),
        envelope=True,
    )
    drive = smallest_motor(torque, turning)
    motor = catalogue.motor(part_id("retreat-motor"), "motor of the rail's retreat", drive, torque, turning)
    middle = _rail_middle(loom)
    beside = loom.task.width / 2 + RAIL_AXIS / 2
    outside = loom.task.width / 2 + APART + (drive.face if drive else catalogue.SPECIAL_FACE) / 2
    ends = [placement(x, middle.imag, middle.real) for x in (-beside, beside)]
    return RigidBody(
        part_id("retreat"),
        (Occurrence(axis, tuple(ends)), Occurrence(motor, (placement(outside, middle.imag, middle.real),))),
        joint=_MISSING,
    )


def frame_tree(loom: LoomDesign, frame: LoomFrame, retreat: SceneMotion | None = None) -> Tree:
    """Columns, posts, beams and feet as one welded body; the rail that retreats with the heads; the control.

    retreat  motion of the rail to the front; default: it stands
    """
    rail = _member("rail", "rail of the heads", frame.rail, frame.task.width)
    axis = Part(
        part_id("rail-axis"),
        "axes of the heads on their rail",
        "linear axis",
        "with a belt for each head",
        box(RAIL_AXIS, RAIL_AXIS, frame.task.width),
        purchase=Bought("linear axis", length=frame.task.width),
        envelope=True,
    )
    middle = _rail_middle(loom)
    along = placement(-frame.task.width / 2, z=frame.rail.side / 2).after(ALONG_WIDTH)
    before = placement(-frame.task.width / 2, z=-RAIL_AXIS / 2).after(ALONG_WIDTH)
    wide, high, deep = CABINET
    control = Part(
        part_id("control"),
        "control",
        "control",
        shape=box(wide, high, deep),
        purchase=Bought("cabinet"),
        envelope=True,
    )
    beside = loom.task.width / 2 + frame.column.side + wide
    cabinet = placement(beside, loom.side.floor + high / 2, loom.side.column - deep / 2)
    return Tree(
        (
            RigidBody(part_id("frame"), tuple(_welded(loom, frame))),
            RigidBody(
                RAIL,
                (Occurrence(rail, (along,)), Occurrence(axis, (before,))),
                joint=Joint(JointKind.SLIDE, motion=retreat),
                positions=(placement(0.0, middle.imag, middle.real),),
            ),
            RigidBody(part_id("control"), (Occurrence(control, (cabinet,)),)),
        )
    )


def _welded(loom: LoomDesign, frame: LoomFrame) -> Iterable[Occurrence]:
    """Two columns, posts under the rail where it has more than one span, beams across at top and bottom, four feet."""
    side, task, section = loom.side, frame.task, frame.column
    beside, edge = task.width / 2 + section.side / 2, section.side / 2
    yield _placed(
        _member("column", "column of the frame", section, task.height),
        (placement(x, side.floor, side.column).after(UPRIGHT) for x in (-beside, beside)),
    )
    if task.rail_spans > 1:
        front = (side.rail.corner + side.rail.size).real + side.retreat + edge
        middles = ((k / task.rail_spans - 0.5) * task.width for k in range(1, task.rail_spans))
        yield _placed(
            _member("post", "post of the rail", section, task.height / 2),
            (placement(x, side.floor, front).after(UPRIGHT) for x in middles),
        )
    yield _placed(
        _member("beam", "beam across", section, task.width),
        (placement(-task.width / 2, y, side.column).after(ALONG_WIDTH) for y in (side.floor + edge, side.top - edge)),
    )
    yield _placed(
        _member("foot", "foot of the frame", section, task.depth),
        (
            placement(x, side.floor + edge, z)
            for x in (-beside, beside)
            for z in (side.column + edge, side.column - edge - task.depth)
        ),
    )


def _placed(part: Part, positions: Iterable[Placement]) -> Occurrence:
    return Occurrence(part, tuple(positions))


def _member(name: str, title: str, section: HollowSquare, length: float) -> Part:
    """A piece of square hollow section, cut to length and welded."""
    shape = square_tube(section.side, section.wall, length)
    return Part(part_id(name), title, "welded frame", section.name, shape, STEEL)


def _rail_middle(loom: LoomDesign) -> complex:
    """Axis of the heads' rail in the side view [m]."""
    rail = loom.side.rail
    return rail.corner + rail.size / 2
