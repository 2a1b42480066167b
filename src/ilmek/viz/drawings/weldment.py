"""Where the welded pieces of an assembly stand: a table of coordinates from its lower left rear corner, ISO 129-1.

X runs to the right and Y upwards in the front view of its first sheet, Z towards the eye.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.fits import tolerance_grade
from ilmek.part.assemblies import AssembledPiece, AssemblyItem, AssemblyUnit
from ilmek.part.colliders import collider
from ilmek.part.placement import Placement
from ilmek.part.tolerances import FeatureKind, FitDuty, ToleratedFeature
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.part.welds import arc_partners, welds_of
from ilmek.sentences import Sentence
from ilmek.units import um
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
    tolerances, hot = tolerances_of(tree), arc_partners(tree)
    seats = [
        (piece, feature)
        for piece, _ in welded
        for feature in tolerances.get(piece.part.id, ())
        if piece.part.machined and piece.part.id in hot and feature.kind is not FeatureKind.THREAD
    ]
    ends = _shaft_ends(seats)
    for number, (piece, feature) in enumerate(seats):
        kind, size, duty = named_feature(feature)
        form = "".join(f"{millimetres(limit.value)}; " for limit in feature.geometric)
        if number in ends:
            value = millimetres(tolerance_grade(END_GRADE, feature.nominal))
            letter, common = ends[number]
            form = Sentence("sheet.true-ends", form=form, letter=letter, value=value, common=common)
        yield items[piece.item].name, piece.part.title, kind, size, form.removesuffix("; "), duty


END_GRADE = 7
"""Grade of ISO 286 of the run-out of the journals at both ends of a welded shaft, about their common axis; assumed."""


def _shaft_ends(seats: Sequence[tuple[AssembledPiece, ToleratedFeature]]) -> dict[int, tuple[str, str]]:
    """Datums of the journals of welded shafts by their numbers, and their common axis: none of a single journal."""
    lines: list[list[tuple[int, Placement]]] = []
    for number, (piece, feature) in enumerate(seats):
        if feature.kind is FeatureKind.JOURNAL and feature.duty is FitDuty.BEARING:
            lies = piece.position.after(feature.position)
            on = (own for own in lines if _on_axis(own[0][1], lies))
            line = next(on, None)
            lines.append([(number, lies)]) if line is None else line.append((number, lies))
    letters = iter("ABCDEFGHJKLMNPQRSTUVWXYZ")
    ends = [(line[0][0], line[-1][0]) for line in lines if len(line) > 1]
    named = [(pair, next(letters), next(letters)) for pair in ends]
    return {
        number: (own, f"{first}-{last}")
        for pair, first, last in named
        for number, own in zip(pair, (first, last), strict=True)
    }


def _on_axis(axis: Placement, other: Placement) -> bool:
    return bool(np.abs(np.cross(axis.rotation[:, 2], other.origin - axis.origin)).max() < um)


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
