"""Where the welded pieces of an assembly stand: a table of coordinates from its lower left rear corner, ISO 129-1.

X runs to the right and Y upwards in the front view of its first sheet, Z towards the eye.
"""

from collections.abc import Iterator, Sequence
from itertools import chain

import numpy as np

from ilmek.arrays import Float
from ilmek.part.assemblies import AssembledPiece, AssemblyItem, AssemblyUnit
from ilmek.part.colliders import collider
from ilmek.part.tolerances import FeatureKind
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.part.welds import welds_of
from ilmek.sentences import Sentence
from ilmek.viz.drawings.fits import named_feature
from ilmek.viz.drawings.joined import span_words
from ilmek.viz.drawings.paper import BLOCK_HEIGHT, EDGE, LEFT, PAPERS, table
from ilmek.viz.drawings.picture import SheetPicture, millimetres

HEADER = (Sentence("sheet.list-number"), Sentence("sheet.list-part"), "X", "Y", "Z")
SEATS = (
    *HEADER[:2], *map(Sentence, ("sheet.feature", "sheet.dimension", "sheet.form", "sheet.duty")),
)  # fmt: skip

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
    tree: Tree, items: Sequence[AssemblyItem], welded: Sequence[tuple[AssembledPiece, Ends]]
) -> tuple[str, list[SheetPicture]]:
    """The first paper on which the tables have room, and these beside each other on it: the positions, and the seats
    that are machined when all is welded.
    """
    rows = [
        (items[piece.item].name, piece.part.title, *(span_words(*axis) for axis in np.round(ends, 4).T.tolist()))
        for piece, ends in sorted(welded, key=lambda own: (own[0].item, *own[1].ravel().tolist()))
    ]
    seats = list(dict.fromkeys(_machined(tree, items, welded)))
    paper, tables = next((name, made) for name in PAPERS if (made := _beside(rows, seats, name)) is not None)
    height = PAPERS[paper][1]
    wide = [each.box[2] - each.box[0] + _PAD for each in tables]
    starts = LEFT + _PAD + np.concatenate([[0.0], np.cumsum(wide)])
    top = height - EDGE - _PAD
    tops = [top - (6.0 if k else 0.0) for k in range(len(tables))]
    return paper, [
        each.moved(complex(left, high)) for each, left, high in zip(tables, starts.tolist(), tops, strict=False)
    ]


def _machined(
    tree: Tree, items: Sequence[AssemblyItem], welded: Sequence[tuple[AssembledPiece, Ends]]
) -> Iterator[tuple[str, ...]]:
    """The seats of pieces that an arc welds, but their threads: what, size, form or position [mm], what for."""
    tolerances = tolerances_of(tree)
    arcs = ((name, weld.other) for name, own in welds_of(tree).items() for weld in own if not weld.brazed)
    hot = frozenset(chain.from_iterable(arcs))
    for piece, _ in welded:
        for feature in tolerances.get(piece.part.id, ()) if piece.part.machined and piece.part.id in hot else ():
            if feature.kind is not FeatureKind.THREAD:
                kind, size, duty = named_feature(feature)
                form = ", ".join(millimetres(limit.value) for limit in feature.geometric)
                yield items[piece.item].name, piece.part.title, kind, size, form, duty


def _beside(rows: Sequence[tuple[str, ...]], seats: Sequence[tuple[str, ...]], paper: str) -> list[SheetPicture] | None:
    """The rows of both tables in tables as high as a paper; None: it is not wide enough for them."""
    width, height = PAPERS[paper]
    room = int((height - 2 * EDGE - BLOCK_HEIGHT - 2 * _PAD - 6.0) / _ROW) - 1
    tables = [
        table(header, own[k : k + room], "" if k else Sentence(title))
        for header, own, title in ((HEADER, rows, "sheet.positions"), (SEATS, seats, "sheet.after-welding"))
        for k in range(0, len(own), room)
    ]
    wide = sum(each.box[2] - each.box[0] + _PAD for each in tables)
    return tables if LEFT + EDGE + _PAD + wide <= width else None
