"""A skeleton drawn in DXF: lines and polylines as links, common ends as pins, the ground and the input by layers."""

import io
from collections.abc import Iterator
from itertools import pairwise

from ezdxf.entities.circle import Circle
from ezdxf.entities.dxfgfx import DXFGraphic
from ezdxf.entities.line import Line
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.point import Point
from ezdxf.entities.polyline import Polyline
from ezdxf.enums import InsertUnits
from ezdxf.filemanagement import read
from ezdxf.lldxf.const import DXFError
from ezdxf.units import conversion_factor

from ilmek.errors import MechanismError
from ilmek.io.imports.foreign import Foreign, number
from ilmek.io.imports.sketch import LARGEST, Drive, Sketch
from ilmek.linkage.model import GROUND
from ilmek.units import mm

NEAR = 1e-6
"""Ends nearer than this part of the drawing's size are one pin."""


def skeleton_data(text: str) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for a drawing that is damaged or has no links.

    Each LINE and each polyline is a link. A POINT or CIRCLE is a pin of all links that pass through its middle. What
    is on the layer `ground` is fixed, and the link on the layer `input` is driven where it is joined to the ground.
    Lengths are in the drawing's units, in mm where it has none.
    """
    try:
        document = read(io.StringIO(text))
    except (DXFError, OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise MechanismError(f"is no DXF: {error}") from None
    unit = conversion_factor(InsertUnits(document.units), InsertUnits.Millimeters) if document.units else 1
    graphics = list(document.modelspace())
    chains = [(entity, _chain(entity, unit * mm)) for entity in graphics if not isinstance(entity, Circle | Point)]
    pivots = [(entity, _middle(entity, unit * mm)) for entity in graphics if isinstance(entity, Circle | Point)]
    sketch = Sketch("skeleton")
    sketch.left_out += sorted({f"{entity.dxftype()}" for entity, chain in chains if not chain})
    chains = [(entity, chain) for entity, chain in chains if len(chain) > 1]
    if not chains:
        raise MechanismError("has no lines", allowed="lines and polylines as links")
    if len(chains) > LARGEST:
        raise MechanismError(f"has {len(chains)} lines", allowed=f"a skeleton, at most {LARGEST}")
    size = max(abs(vertex - chains[0][1][0]) for _, chain in chains for vertex in chain) or 1.0
    for pivot, middle in pivots:
        point = _point(sketch, middle, NEAR * size)
        if _layer(pivot) == GROUND and point not in sketch.bodies[GROUND]:
            sketch.bodies[GROUND].append(point)
    pins = dict(sketch.points)
    for entity, chain in sorted(chains, key=lambda pair: _layer(pair[0]) != GROUND):
        own = [_point(sketch, vertex, NEAR * size) for vertex in chain]
        sides = list(pairwise(chain))
        own += [point for point, at in pins.items() if any(_distance(at, *side) <= NEAR * size for side in sides)]
        _link(sketch, _layer(entity), list(dict.fromkeys(own)))
    return sketch.foreign()


def _link(sketch: Sketch, layer: str, points: list[str]) -> None:
    if layer == GROUND:
        sketch.bodies[GROUND] += [point for point in points if point not in sketch.bodies[GROUND]]
        return
    body = sketch.body(f"link {len(sketch.bodies)}", points)
    if layer == "input":
        pivots = [point for point in points if point in sketch.bodies[GROUND]]
        sketch.inputs |= dict.fromkeys(pivots[:1], Drive(body))


def _point(sketch: Sketch, position: complex, near: float) -> str:
    """Name of the point in a place."""
    for point, at in sketch.points.items():
        if abs(at - position) <= near:
            return point
    point = f"P{len(sketch.points) + 1}"
    sketch.points[point] = position
    return point


def _distance(at: complex, start: complex, end: complex) -> float:
    along = end - start
    part = ((at - start) * along.conjugate()).real / (abs(along) ** 2 or 1.0)
    return abs(at - start - min(max(part, 0.0), 1.0) * along)


def _chain(entity: DXFGraphic, unit: float) -> list[complex]:
    """Vertices of a line or polyline [m]; none of another entity."""
    return [complex(number(x, "a coordinate"), number(y, "a coordinate")) * unit for x, y in _vertices(entity)]


def _vertices(entity: DXFGraphic) -> Iterator[tuple[float, float]]:
    if isinstance(entity, Line):
        yield from ((end.x, end.y) for end in (entity.dxf.start, entity.dxf.end))
    elif isinstance(entity, LWPolyline):
        yield from ((x, y) for x, y in entity.get_points("xy"))
    elif isinstance(entity, Polyline):
        yield from ((vertex.x, vertex.y) for vertex in entity.points())


def _middle(entity: Circle | Point, unit: float) -> complex:
    at = entity.dxf.center if isinstance(entity, Circle) else entity.dxf.location
    return complex(number(at.x, "a coordinate"), number(at.y, "a coordinate")) * unit


def _layer(entity: DXFGraphic) -> str:
    return str(entity.dxf.layer).lower()
