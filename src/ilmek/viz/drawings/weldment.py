"""Where the welded pieces of an assembly stand: a table of coordinates from its lower left rear corner, ISO 129-1.

X runs to the right and Y upwards in the front view of its first sheet, Z towards the eye.
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import Float
from ilmek.part.assemblies import AssembledPiece, AssemblyItem, AssemblyUnit
from ilmek.part.colliders import collider
from ilmek.part.tree import Tree
from ilmek.part.welds import welds_of
from ilmek.sentences import Sentence
from ilmek.viz.drawings.joined import span_words
from ilmek.viz.drawings.paper import BLOCK_HEIGHT, EDGE, LEFT, PAPERS, table
from ilmek.viz.drawings.picture import SheetPicture

HEADER = (Sentence("sheet.list-number"), Sentence("sheet.list-part"), "X", "Y", "Z")

_PAD, _ROW = 6.0, 5.0
"""Distance from the frame and of two tables, height of a row [mm]."""

Ends = Float[np.ndarray, "2 3"]


def welded_pieces(
    tree: Tree, assembly: AssemblyUnit, pieces: Sequence[AssembledPiece]
) -> tuple[tuple[AssembledPiece, Ends], ...]:
    """The pieces of an assembly, not of those in it, that are welded to others of it, and where each begins and ends
    along the axes of the tree from the least corner of all [m].
    """
    own = {body.id for body in assembly.bodies}
    names = {piece.part.id for piece in pieces if piece.body.id in own}
    pairs = [(name, weld.other) for name, welds in welds_of(tree).items() for weld in welds]
    welded = {name for pair in pairs if names.issuperset(pair) for name in pair}
    shown = [piece for piece in pieces if piece.body.id in own and piece.part.id in welded]
    corners = [
        piece.position.points(collider(piece.part.shape).corners) for piece in shown if piece.part.shape is not None
    ]
    if not corners:
        return ()
    ends = np.array([[points.min(axis=0), points.max(axis=0)] for points in corners])
    return tuple(zip(shown, ends - ends[:, 0].min(axis=0), strict=True))


def positions(
    items: Sequence[AssemblyItem], welded: Sequence[tuple[AssembledPiece, Ends]]
) -> tuple[str, list[SheetPicture]]:
    """The first paper on which the tables of the positions have room, and the tables beside each other on it."""
    rows = [
        (items[piece.item].name, piece.part.title, *(span_words(*axis) for axis in np.round(ends, 4).T.tolist()))
        for piece, ends in sorted(welded, key=lambda own: (own[0].item, *own[1].ravel().tolist()))
    ]
    paper, tables = next((name, made) for name in PAPERS if (made := _beside(rows, name)) is not None)
    height = PAPERS[paper][1]
    wide = [each.box[2] - each.box[0] + _PAD for each in tables]
    starts = LEFT + _PAD + np.concatenate([[0.0], np.cumsum(wide)])
    top = height - EDGE - _PAD
    tops = [top - (6.0 if k else 0.0) for k in range(len(tables))]
    return paper, [
        each.moved(complex(left, high)) for each, left, high in zip(tables, starts.tolist(), tops, strict=False)
    ]


def _beside(rows: Sequence[tuple[str, ...]], paper: str) -> list[SheetPicture] | None:
    """The rows in tables as high as a paper; None: it is not wide enough for them."""
    width, height = PAPERS[paper]
    room = int((height - 2 * EDGE - BLOCK_HEIGHT - 2 * _PAD - 6.0) / _ROW) - 1
    title = Sentence("sheet.positions")
    tables = [table(HEADER, rows[k : k + room], "" if k else title) for k in range(0, len(rows), room)]
    wide = sum(each.box[2] - each.box[0] + _PAD for each in tables)
    return tables if LEFT + EDGE + _PAD + wide <= width else None
