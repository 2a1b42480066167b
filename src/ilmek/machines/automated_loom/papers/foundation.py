"""The foundation plan of a loom: anchors, levelling feet and stands from one datum, the axis of its left front foot."""

from collections.abc import Sequence

import numpy as np

from ilmek.elements.anchor_bolts import ANCHOR
from ilmek.part.insertion_units import StandingPart, standing_parts
from ilmek.part.poses import chains
from ilmek.part.tree import Tree
from ilmek.report import Column, Dot, Drawing, Paper, PaperSection, Stroke, Table
from ilmek.sentences import Sentence
from ilmek.units import in_mm, mm

LOW = 250 * mm
"""Height over the floor below which parts are drawn."""

_NEAR = 0.6
"""Distance of the anchors of one foot, which have one label [m]."""


def foundation(tree: Tree) -> Paper:
    """The plan, and a row for each hole, foot, or part that stands by itself: its number, what is there, how far to the
    right of the datum and behind it. Raises ValueError for a tree without levelling feet.
    """
    pieces, roots = list[StandingPart](), dict[str, str]()
    for links in chains(tree):
        roots[links[-1].name] = links[0].name
        pieces += standing_parts(links)
    floor = min(float(piece.box[0][1]) for piece in pieces)
    feet = [piece for piece in pieces if piece.part.process == "levelling foot"]
    datum = min((_plan(piece) for piece in feet), key=lambda spot: spot.real + spot.imag)
    bolts = [piece for piece in pieces if piece.part.purchase and piece.part.purchase.row == ANCHOR.designation]
    held = {roots[piece.body] for piece in (*feet, *bolts)}
    low = (piece for piece in pieces if piece.box[0][1] < floor + mm and not piece.part.fixing)
    free = [piece for piece in low if roots[piece.body] not in held]
    fixed = sorted((*feet, *bolts, *free), key=lambda piece: (piece.part.id, *_steps(_plan(piece) - datum)))
    heads = (
        Column(Sentence("foundation.number")),
        Column(Sentence("foundation.part")),
        Column(Sentence("foundation.right"), "mm", 5),
        Column(Sentence("foundation.behind"), "mm", 5),
        Column(Sentence("foundation.bolt")),
    )
    rows = tuple(
        (number, piece.part.title, spot.real, spot.imag, piece.part.designation or Sentence("foundation.free"))
        for number, piece in enumerate(fixed, 1)
        for spot in [_plan(piece) - datum]
    )
    title = Sentence("foundation.title")
    how = Sentence(
        "foundation.how", drill=in_mm(ANCHOR.drill), depth=in_mm(ANCHOR.depth), torque=f"{ANCHOR.torque:g} Nm"
    )
    table = Table("foundation", title, heads, rows)
    section = PaperSection(title, (how,), table, boxes=True, figure=_picture(pieces, fixed, datum, floor))
    return Paper("foundation", title, Sentence("foundation.lead"), (section,))


def _plan(piece: StandingPart) -> complex:
    """The middle of where a piece stands: to the right, and to the rear [m]."""
    x, _, z = np.mean(piece.box, axis=0).tolist()
    return complex(x, -z)


def _steps(spot: complex) -> tuple[int, int]:
    return round(spot.imag / mm), round(spot.real / mm)


def _picture(pieces: Sequence[StandingPart], fixed: Sequence[StandingPart], datum: complex, floor: float) -> Drawing:
    """From above, the front below: rooms of what is low, and each hole or foot; the numbers of those near together."""
    boxes = np.array([piece.box for piece in pieces])
    strokes = []
    for low, high in np.unique(boxes[boxes[:, 0, 1] < floor + LOW].round(4), axis=0):
        corners = complex(low[0], -high[2]) - datum, complex(high[0], -low[2]) - datum
        first, last = corners
        outline = np.array([first, complex(last.real, first.imag), last, complex(first.real, last.imag)])
        strokes.append(Stroke(outline, "construction", closed=True))
    dots, before = list[Dot](), complex(np.inf)
    for number, piece in enumerate(fixed, 1):
        spot = _plan(piece) - datum
        label = str(number) if abs(spot - before) > _NEAR else ""
        marked = Sentence("foundation.datum", number=str(number)) if spot == 0 else label
        dots.append(Dot(spot, marked, "point" if spot else "pivot"))
        before = spot
    return Drawing("foundation", Sentence("foundation.picture"), tuple(strokes), tuple(dots), unit="mm")
