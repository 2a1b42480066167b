"""The made parts of a tree for the workshop: flat ones as plates, all others as solids."""

from dataclasses import replace
from functools import lru_cache
from typing import TypeVar

from ilmek.part.blanks import size_of, sold_as
from ilmek.part.folding import folded_sheet
from ilmek.part.part import Part
from ilmek.part.shapes import Prism
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.plane.contours import area, as_hole, counter_clockwise
from ilmek.report import Plate, WorkPiece
from ilmek.units import in_mm

FLAT = ("laser-cut part", "machined link", "cam plate")
"""Processes by which a contour is cut out of flat stock."""


def plates_of(tree: Tree, whole: Tree | None = None) -> tuple[Plate, ...]:
    """A plate for each flat part that is made, named by the last part of its id, in the order of the bodies.

    whole  the tree in which its parts meet those of others; default: the tree itself
    """
    return tuple(_plate(part, number, whole or tree) for part, number in tree.occurrences() if is_flat(part))


def pieces_of(tree: Tree, whole: Tree | None = None) -> tuple[WorkPiece, ...]:
    """A piece for each other part that is made: what is turned, sawn or welded; whole  as of `plates_of`."""
    return tuple(
        _piece(part, number, whole or tree)
        for part, number in tree.occurrences()
        if part.material is not None and part.shape is not None and not is_flat(part)
    )


def _piece(part: Part, number: int, whole: Tree) -> WorkPiece:
    assert part.material is not None
    assert part.shape is not None
    designation, volume = sold_as(part), part.shape.volume
    return WorkPiece(plate_name(part), part.title, size_of(part), designation, number, part.shape, volume, part, whole)


View = TypeVar("View", Plate, WorkPiece)


def of_tree(made: View, tree: object) -> View:
    """A plate or piece of a part as that is in a tree: its pieces there, its holes for what it meets there."""
    if not isinstance(made.part, Part) or not isinstance(tree, Tree):
        return made
    own_part = made.part
    part, number = _parts(tree).get(own_part.id, (own_part, made.number))
    made = replace(made, number=number, tree=tree)
    if part is own_part or own_part.drawing is not None:
        return made
    own = _plate(part, made.number, tree) if isinstance(made, Plate) else _piece(part, made.number, tree)
    return replace(made, **{name: getattr(own, name) for name in _HOLED[type(made)]})


_HOLED: dict[type, tuple[str, ...]] = {
    Plate: ("outline", "holes", "cutouts", "area", "solid", "part"),
    WorkPiece: ("shape", "volume", "part"),
}
"""What a part with holes has otherwise."""


@lru_cache(maxsize=4)
def _parts(tree: Tree) -> dict[str, tuple[Part, int]]:
    return {part.id: (part, number) for part, number in tree.occurrences()}


def tolerated(made: View) -> View:
    """A plate or piece with what the features of its part must hold."""
    if not isinstance(made.part, Part) or not isinstance(made.tree, Tree):
        return made
    return replace(made, features=tolerances_of(made.tree).get(made.part.id, ()))


def is_flat(part: Part) -> bool:
    """Whether a part is drawn as a plate."""
    if part.drawing is not None:
        return True
    made = part.material is not None and not part.envelope
    return part.process in FLAT and made and isinstance(part.shape, Prism)


def plate_name(part: Part) -> str:
    """Name of a part's plate in its machine: the last part of its id."""
    return part.id.rpartition("/")[2]


def _cutter(part: Part) -> tuple[str, ...]:
    return (f"cutter of {in_mm(2 * part.cam.cutter)}",) if part.cam is not None and part.cam.cutter > 0 else ()


def _plate(part: Part, number: int, whole: Tree) -> Plate:
    assert part.material is not None
    bent = folded_sheet(part.shape)
    flat = part.drawing if bent is None else replace(bent.plate, solid=_piece(part, number, whole), notes=part.notes)
    if flat is not None:
        return replace(
            flat,
            name=plate_name(part),
            title=part.title.capitalize(),
            number=number,
            material=sold_as(part),
            part=part,
            tree=whole,
        )
    shape = part.shape
    assert isinstance(shape, Prism)
    outline = counter_clockwise(shape.section.outline)
    bores = [(cut, as_hole(cut)) for cut in shape.section.holes]
    return Plate(
        name=plate_name(part),
        title=part.title.capitalize(),
        outline=outline.points if shape.section.smooth else outline,
        thickness=shape.length,
        material=sold_as(part),
        holes=tuple(hole for _, hole in bores if hole is not None),
        cutouts=tuple(counter_clockwise(cut) for cut, hole in bores if hole is None),
        area=area(outline),
        number=number,
        paths=part.paths,
        marks=part.marks,
        notes=(*part.notes, *_cutter(part)),
        solid=_piece(part, number, whole) if shape.drilled else None,
        part=part,
        tree=whole,
    )
